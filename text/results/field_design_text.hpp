// SPDX-License-Identifier: Apache-2.0
// What a field-oriented drive comes to, for the terminal and for programs.
#pragma once
#include <string>

#include "sixstep/analysis/verify/field_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// The verdict first, then every step in numbers.
std::string field_design_text(const analysis::FieldStudy& study, bool colour);

/// "good", "usable, 1 warning", or "NOT USABLE" and the reason.
std::string field_design_verdict(const analysis::FieldStudy& study);

/// In full precision, the loops as design_json() has them. Values that are infinite or do not exist are null.
std::string field_design_json(const analysis::FieldStudy& study);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Prints the design of a field-oriented drive: for the terminal and as JSON.
#pragma once
#include <string>

#include "sixstep/analysis/verify/field_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// The verdict first, then every step in numbers.
std::string field_design_text(const analysis::FieldStudy& study, bool colour);

/// The verdict: "good", "usable, 1 warning", or "NOT USABLE" with the reason.
std::string field_design_verdict(const analysis::FieldStudy& study);

/// JSON in full precision, loops as in design_json(). Values that are infinite or do not exist are null.
std::string field_design_json(const analysis::FieldStudy& study);

}  // namespace text

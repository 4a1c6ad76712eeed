// SPDX-License-Identifier: Apache-2.0
// Writes a design as JSON in full precision.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"
#include "text/rooms.hpp"

namespace text {

/// Gains, derivations, margins, Bode and step data of each loop, limits, simulated and designed values, worst
/// variations, warnings. Values that are infinite or do not exist are null.
std::string design_json(const analysis::DesignStudy& study);

}  // namespace text

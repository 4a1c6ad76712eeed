// SPDX-License-Identifier: Apache-2.0
// The numbers that the thesis prints on its way to the gains, for who reads it beside the tool. They carry
// its rounding, and a slip: its gains belong to the poles it prints, and those to w0 = 5504 rad/s, not 5111.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

/// What the thesis prints for a symbol of PolePlacement::steps; empty for another motor, period or spec, and
/// for what it does not print. Loops: "current", "speed".
std::optional<double> thesis_figure(std::string_view loop, const PolePlacement& design,
                                    std::string_view symbol);

}  // namespace sixstep::design

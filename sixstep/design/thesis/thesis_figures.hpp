// SPDX-License-Identifier: Apache-2.0
// Intermediate numbers that the thesis prints, for comparison with the tool. They have its rounding, and an error:
// its gains belong to the poles that it prints, and those to w0 = 5504 rad/s, not 5111.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

/// Printed value for a symbol of PolePlacement::steps; empty for another motor, period or spec, and for values that
/// the thesis does not print. Loops: "current", "speed".
std::optional<double> thesis_figure(std::string_view loop, const PolePlacement& design,
                                    std::string_view symbol);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Intermediate numbers that the thesis prints, for comparison with sixstep's results. They have the thesis's
// rounding, and one error: its gains belong to its printed poles, but these poles belong to w0 = 5504 rad/s,
// not to the printed 5111.
#pragma once
#include <optional>
#include <string_view>

#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

/// The printed value for a symbol of PolePlacement::steps. Empty for another motor, period or spec, and for
/// values that the thesis does not print. `loop`: "current" or "speed".
std::optional<double> thesis_figure(std::string_view loop, const PolePlacement& design,
                                    std::string_view symbol);

}  // namespace sixstep::design

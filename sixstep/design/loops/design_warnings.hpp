// SPDX-License-Identifier: Apache-2.0
// What a designer should be told of a drive, in words. What helps is found by trying (analysis/verify/advice.hpp), and stands here
// only where it is nothing that could be tried: what the sheet lacks, what a run shows.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Rules of the trade that decide: 45 degrees of phase and a peak of sensitivity of 2 with the delay of a
/// real chip (Astrom, Hagglund: 1.2 to 2), crossovers of nested loops apart by 4, ripple below a fifth of the
/// nominal current. A step of the measured speed makes less than half of the torque limit: the other half is for the load.
inline constexpr double least_phase_deg = 45.0, greatest_sensitivity = 2.0, least_separation = 4.0,
                        greatest_ripple = 0.2, greatest_speed_step = 0.5;

/// Whether the speed's own steps reach the torque limit, or the end of the bus: what is cut off there is missing from the mean, and the
/// drive holds another speed than is asked for.
bool is_grainy(const DriveDesign& design);

std::vector<Warning> warnings_of(const DriveDesign& design);

}  // namespace sixstep::design

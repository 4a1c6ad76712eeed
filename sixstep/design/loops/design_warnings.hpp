// SPDX-License-Identifier: Apache-2.0
// Warnings to the designer of a drive, in words. Cures that can be tried are found by trials
// (analysis/verify/advice.hpp); cures are here only where no trial is possible: data that the sheet lacks, effects
// that only a run shows.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Thresholds of the warnings, from practice: 45 degrees of phase and a peak of sensitivity of 2 with the delay of a
/// real chip (Astrom, Hagglund: 1.2 to 2), crossovers of nested loops apart by a factor of 4, ripple below a fifth of
/// the nominal current. With less than 20 degrees of phase a loop is not usable: it amplifies some disturbance at least
/// 1/(2 sin 10 deg) = 2.9 times, and its steps swing. A step of the measured speed causes less than half of the torque limit: the other half is for
/// the load. A limit above three nominal currents is more than the usual 2 to 3.
inline constexpr double least_phase_deg = 45.0, unusable_phase_deg = 20.0, greatest_sensitivity = 2.0,
                        least_separation = 4.0, greatest_ripple = 0.2, greatest_speed_step = 0.5,
                        greatest_overload = 3.0;

/// True in speed mode if a step of the measured speed commands more than greatest_speed_step of the torque limit, or
/// more voltage than the bus has left. A clipped part is missing from the mean, so that the drive holds a wrong speed.
bool is_grainy(const DriveDesign& design);

std::vector<Warning> warnings_of(const DriveDesign& design);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Warnings to the designer of a drive, as text. Trials find most cures (analysis/verify/advice.hpp). This
// file contains only cures that cannot be tried: data that the sheet lacks, and effects that only a run
// shows.
#pragma once
#include <vector>

#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Thresholds of the warnings, from practice:
///   least_phase_deg, greatest_sensitivity  with the delay of a real chip (Astrom, Hagglund: sensitivity 1.2
///                                          to 2)
///   unusable_phase_deg   with a smaller phase margin a loop is not usable: it amplifies some disturbance at
///                        least 1/(2 sin 10 deg) = 2.9 times, and its step responses swing
///   least_separation     ratio of the crossovers of nested loops
///   greatest_ripple      relative to the nominal current
///   greatest_speed_step  torque that a step of the measured speed causes, relative to the torque limit; the
///                        rest of the limit is for the load
///   greatest_overload    current limit divided by the nominal current; 2 to 3 is usual
inline constexpr double least_phase_deg = 45.0, unusable_phase_deg = 20.0, greatest_sensitivity = 2.0,
                        least_separation = 4.0, greatest_ripple = 0.2, greatest_speed_step = 0.5,
                        greatest_overload = 3.0;

/// True in speed mode if a step of the measured speed commands more than greatest_speed_step of the torque
/// limit, or more voltage than remains of the bus. The limits then clip the command, its mean is wrong, and
/// the drive settles at a wrong speed.
bool is_grainy(const DriveDesign& design);

std::vector<Warning> warnings_of(const DriveDesign& design);

}  // namespace sixstep::design

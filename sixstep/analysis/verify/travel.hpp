// SPDX-License-Identifier: Apache-2.0
// Computes the time that a drive needs at the limits of torque and bus.
#pragma once
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::analysis {

/// Longest time of a start at the limits, s, computed with the torque that the bus allows at the end of the
/// start; 0 if it allows none.
double start_time(const design::DriveDesign& design, double to_rad_s, double load_Nm);

/// Time from one speed to another at the limits of torque and bus, s, computed in a hundred steps. If the bus
/// allows no more torque before the end, five time constants J R/K_t^2 are added, with which the speed then
/// approaches its limit.
double travel_time(const design::DriveDesign& design, double from_rad_s, double to_rad_s, double load_Nm);

}  // namespace sixstep::analysis

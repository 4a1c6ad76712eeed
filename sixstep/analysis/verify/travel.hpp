// SPDX-License-Identifier: Apache-2.0
// Computes the duration of speed changes at the limits of torque and bus.
#pragma once
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::analysis {

/// Longest duration of a start at the limits, s, with the torque that the bus allows at the end of the start;
/// 0 if the bus allows no torque at this speed.
double start_time(const design::DriveDesign& design, double to_rad_s, double load_Nm);

/// Time from one speed to another at the limits of torque and bus, s, computed in a hundred steps. If the bus
/// allows no more torque before the end, the speed approaches its limit with the time constant J R/K_t^2;
/// five of these time constants are added.
double travel_time(const design::DriveDesign& design, double from_rad_s, double to_rad_s, double load_Nm);

}  // namespace sixstep::analysis

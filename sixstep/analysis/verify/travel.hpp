// SPDX-License-Identifier: Apache-2.0
// How long a drive at the limits of torque and bus is on its way.
#pragma once
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::analysis {

/// What a start at the limits takes at most: torque that the bus leaves at the end of it.
double start_time(const design::DriveDesign& design, double to_rad_s, double load_Nm);

/// The time from one speed to another at the limits of torque and bus, by a hundred parts. Where the bus allows no more, five of the
/// times in which the speed creeps up to what it does allow.
double travel_time(const design::DriveDesign& design, double from_rad_s, double to_rad_s, double load_Nm);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Finds specs without a possible design: values out of range, and demands that contradict each other. The
// problems name options.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// Upper bound of a drive's lowest speed, rad/s (operating_limits.hpp); 0 if it is not known.
double most_lowest_speed_rad_s(const MotorModel& motor, const DesignSpec& spec);

base::Problems check_spec(const MotorModel& motor, const DesignSpec& spec);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// What cannot be designed: values out of range and wishes that contradict each other, named as options.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

/// The most that may be a drive's lowest speed (operating_limits.hpp); 0 where that is not known.
double most_lowest_speed_rad_s(const MotorModel& motor, const DesignSpec& spec);

base::Problems check_spec(const MotorModel& motor, const DesignSpec& spec);

}  // namespace sixstep::design

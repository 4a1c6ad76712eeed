// SPDX-License-Identifier: Apache-2.0
// What cannot be designed: values out of range and wishes that contradict each other, named as options.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

base::Problems check_wish(const MotorModel& motor, const DesignWish& wish);

}  // namespace sixstep::design

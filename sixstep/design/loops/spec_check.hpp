// SPDX-License-Identifier: Apache-2.0
// What cannot be designed: values out of range and wishes that contradict each other, named as options.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_design.hpp"

namespace sixstep::design {

base::Problems check_spec(const MotorModel& motor, const DesignSpec& spec);

}  // namespace sixstep::design

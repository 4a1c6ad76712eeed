// SPDX-License-Identifier: Apache-2.0
// Words and units of a motor in messages: rotary or linear.
#pragma once
#include "sixstep/base/linear.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace sixstep::design {

constexpr base::Motion motion(MotorKind kind) { return {kind == MotorKind::linear}; }
inline base::Motion motion_of(const Sheet& sheet) { return motion(sheet.kind); }
inline base::Motion motion_of(const MotorModel& motor) { return motion(motor.kind); }

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// When a chopped pulse really begins.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// By which it begins later than the timer says, s: with complementary chopping the leg's lower switch turns off first, and the upper one
/// on a dead time later. In the other ways of chopping the leg has no switch to wait for.
inline double pulse_late_s(const Scenario& s) {
  return s.pwm.chopping == control::Chopping::complementary ? s.bridge.dead_time_s : 0.0;
}

}  // namespace sixstep::study

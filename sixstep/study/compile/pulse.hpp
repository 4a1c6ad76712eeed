// SPDX-License-Identifier: Apache-2.0
// The delay between the timer's edge and the real start of a chopped pulse.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Time by which the pulse begins after the timer's edge, s. With complementary chopping the leg's lower
/// switch turns off first, and the upper switch turns on a dead time later. With other chopping only one
/// switch of the leg is used, so that no dead time is needed.
inline double pulse_late_s(const Scenario& s) {
  return s.pwm.chopping == control::Chopping::complementary ? s.bridge.dead_time_s : 0.0;
}

}  // namespace sixstep::study

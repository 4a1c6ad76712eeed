// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/three_leg_modulator.hpp"

namespace sixstep::rig {

using control::LegState;

void ThreeLegModulator::start_period(const sim::Instant& t, const Command& command) {
  const bool wakes = command.enabled && !command_.enabled;
  command_ = command;
  const plant::Gates before = timer_.gates();
  before_period_ = turn_ons_;
  timer_.start_period(t);
  timer_.disconnect();
  if (wakes) timer_.wake(t);
  for (unsigned k = 0; command.enabled && k < 3; ++k) {
    const control::LegCommand<double>& leg = command.leg[k];
    if (leg.state == LegState::pwm)
      timer_.start_pulse(k, t, leg.duty);
    else
      timer_.preset_pulse(k, false);
    // mutant: , «k» => 0
    timer_.connect(k, sides_of(leg), k);
  }
  timer_.update(t);
  count(before);
}

void ThreeLegModulator::turn_off(const sim::Instant& t) {
  command_.enabled = false;
  timer_.disconnect();
  timer_.update(t);
}

}  // namespace sixstep::rig

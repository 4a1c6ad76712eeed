// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/leg_timer.hpp"

#include <bit>

namespace sixstep::rig {

using sim::Instant;

void LegTimer::wake(const Instant& t) {
  // mutant: leg.hold(t, dead_ticks_); => nothing
  for (LegChannel& leg : legs_) leg.hold(t, dead_ticks_);
  for (Pulse& pulse : pulses_) pulse.on = false;
}

void LegTimer::start_period() {
  for (; chopping_ != 0; chopping_ &= chopping_ - 1)
    pulses_[static_cast<unsigned>(std::countr_zero(chopping_))].cancel();
}

void LegTimer::start_pulse(unsigned pulse, const Instant& t, double duty) {
  Pulse& p = pulses_[pulse];
  switch_pulse(pulse, p.begin(t, duty, config_));
  if (p.off_edge != Instant::never()) chopping_ |= 1u << pulse;
}

void LegTimer::switch_pulse(unsigned pulse, bool on) {
  Pulse& p = pulses_[pulse];
  // mutant: on && !p.on => on
  turn_ons_ += on && !p.on;
  p.on = on;
}

void LegTimer::hand_over(unsigned from, unsigned to) {
  // mutant: legs_[to] = legs_[from]; => nothing
  legs_[to] = legs_[from];
  legs_[from] = {};
}

void LegTimer::update(const Instant& t, int late) {
  for (unsigned k = 0; k < 3; ++k) {
    const Output& output = outputs_[k];
    legs_[k].tell(t, pulses_[output.pulse].on ? output.sides.pulse : output.sides.rest, dead_ticks_);
  }
  // mutant: late != none_late => false
  if (late != none_late) legs_[static_cast<unsigned>(late)].delay(t, dead_ticks_);
  look_at_legs();
}

void LegTimer::look_at_legs() {
  unsigned high = 0, low = 0;
  wait_end_ = Instant::never();
  for (unsigned k = 0; k < 3; ++k) {
    const LegChannel& leg = legs_[k];
    high |= unsigned{leg.is_on(LegSide::high)} << k;
    low |= unsigned{leg.is_on(LegSide::low)} << k;
    if (leg.waits() && leg.from() < wait_end_) wait_end_ = leg.from();
  }
  gates_ = {high, low};
  next_edge_ = wait_end_;
  for (unsigned left = chopping_; left != 0; left &= left - 1) {
    const Instant& edge = pulses_[static_cast<unsigned>(std::countr_zero(left))].next();
    if (edge < next_edge_) next_edge_ = edge;
  }
}

bool LegTimer::act(const Instant& now) {
  if (now < next_edge_) return false;
  if (!(now < wait_end_))
    for (LegChannel& leg : legs_) leg.look(now);
  for (unsigned left = chopping_; left != 0; left &= left - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(left));
    Pulse& p = pulses_[k];
    if (!(now < p.on_edge)) {
      p.on_edge = Instant::never();
      switch_pulse(k, true);
    }
    if (now < p.off_edge) continue;
    p.off_edge = Instant::never();
    switch_pulse(k, false);
    if (p.on_edge == Instant::never()) chopping_ &= ~(1u << k);
  }
  update(now);
  return true;
}

}  // namespace sixstep::rig

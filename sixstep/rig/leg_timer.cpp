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

void LegTimer::start_period(const Instant& t) {
  period_begun_ = t;
  before_period_ = turn_ons_;
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
  turn_ons_ += pulse == 0 && on && !p.on;
  p.on = on;
}

void LegTimer::hand_over(unsigned from, unsigned to) {
  // mutant: legs_[to] = legs_[from]; => nothing
  legs_[to] = legs_[from];
  legs_[from] = {};
  for (std::uint8_t* bits : {&told_, &waiting_}) {
    const unsigned others = *bits & ~(of_leg << from | of_leg << to), handed = *bits >> from & of_leg;
    *bits = static_cast<std::uint8_t>(others | handed << to);
  }
}

LegTimer::Switches LegTimer::asked() const {
  unsigned switches = 0;
  for (unsigned p = 0; p < 3; ++p) switches |= pulses_[p].on ? outputs_[p].in_pulse : outputs_[p].in_rest;
  return static_cast<Switches>(switches);
}

void LegTimer::set_dead_time(double ticks) {
  dead_ticks_ = config_.in_counts(ticks);
  if (waits_ || !(dead_ticks_ > 0)) return;
  waits_ = true;  // from now on changes wait for the dead time; earlier changes do not
  for (unsigned k = 0; k < 3; ++k) legs_[k] = LegChannel(side_of(told_, k));
}

void LegTimer::update(const Instant& t, int late) {
  const Switches wanted = asked();
  if (!waits_) {
    told_ = wanted;
    set_gates(wanted);
    next_edge_ = first_edge();
    return;
  }
  const unsigned changed = unsigned{wanted} ^ told_;
  // mutant: changed >> 3 => 0u
  unsigned touched = (changed | changed >> 3) & 0b111;
  told_ = wanted;
  for (unsigned left = touched; left != 0; left &= left - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(left));
    legs_[k].tell(t, side_of(wanted, k), dead_ticks_);
  }
  // mutant: late != none_late => false
  if (late != none_late) {
    legs_[static_cast<unsigned>(late)].delay(t, dead_ticks_);
    touched |= 1u << late;
  }
  if ((touched | waiting_) != 0) look_at_legs();
  set_gates(told_ & ~(waiting_ * of_leg));
  next_edge_ = first_edge();
}

/// Updates the mask of the waiting legs, and the earliest end of a wait.
void LegTimer::look_at_legs() {
  static constexpr Instant never = Instant::never();
  const Instant* end = &never;
  unsigned waiting = 0;
  for (unsigned k = 0; k < 3; ++k) {
    if (!legs_[k].waits()) continue;
    waiting |= 1u << k;
    if (legs_[k].from() < *end) end = &legs_[k].from();
  }
  waiting_ = static_cast<std::uint8_t>(waiting);
  wait_end_ = *end;
}

/// Earliest edge of pulses and waits. Returns a reference, because a copy of a value that was just written
/// would stall the processor until both halves are in memory.
const Instant& LegTimer::first_edge() const {
  const Instant* first = &wait_end_;
  for (unsigned left = chopping_; left != 0; left &= left - 1) {
    const Instant& edge = pulses_[static_cast<unsigned>(std::countr_zero(left))].next();
    if (edge < *first) first = &edge;
  }
  return *first;
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

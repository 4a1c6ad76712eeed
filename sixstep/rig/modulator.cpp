// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/modulator.hpp"

#include <bit>
#include <cmath>

namespace sixstep::rig {

using control::Chopping;
using control::Watch;
using sim::Instant;

namespace {

unsigned index(control::Leg leg) { return static_cast<unsigned>(leg); }

}  // namespace

double Modulator::in_counts(double ticks) const {
  if (!(config_.timer_ticks > 0)) return ticks;
  return std::floor(ticks / config_.timer_ticks + 0.5) * config_.timer_ticks;
}

/// Where the pair moves on, the PWM state moves from leg to leg as it is (model.md 3): the leg that leaves
/// the pair gives its channel, waits and all, to the one that enters. A change of sign moves nothing, each
/// leg keeps its own.
Modulator::Entered Modulator::hand_over(control::Pair to) {
  const auto legs_of = [](control::Pair pair) { return 1u << index(pair.source) | 1u << index(pair.sink); };
  const unsigned before = legs_of(command_.pair), after = legs_of(to);
  const unsigned entering = after & ~before, leaving = before & ~after;
  if (entering == 0 || leaving == 0) return nullptr;
  LegChannel& left = legs_[static_cast<unsigned>(std::countr_zero(leaving))];
  LegChannel& entered = legs_[static_cast<unsigned>(std::countr_zero(entering))];
  entered = left;
  left = {};
  return &entered;
}

Modulator::Entered Modulator::take(const Instant& t, const BoardCommand& command) {
  const bool wakes = command.enabled && !command_.enabled;
  const Entered entered = hand_over(command.pair);
  // Field by field, as it was written: a copy in wider pieces would wait until the fields have left for
  // memory.
  command_.enabled = command.enabled;
  command_.pair = command.pair;
  command_.duty = command.duty;
  command_.chopping = command.chopping;
  command_.watch = command.watch;
  command_.on_below_A = command.on_below_A;
  command_.off_above_A = command.off_above_A;
  if (!wakes) return entered;
  // The first command is a change of every leg: nobody knows what it did before.
  for (LegChannel& leg : legs_) leg.hold(t, dead_ticks_);
  source_on_ = false;
  sink_on_ = true;
  if (command.watch != Watch::none) switch_source(true);  // hysteresis starts on (model.md 4)
  return entered;
}

void Modulator::start_period(const Instant& t, const BoardCommand& command) {
  const Entered entered = take(t, command);
  on_edge_ = Instant::never();
  off_edge_ = Instant::never();
  if (command.enabled && command.watch == Watch::none) {
    const auto period = static_cast<double>(config_.period_ticks);
    const double on_time = command.duty * period;
    const bool whole = command.duty >= 1.0, chops = !whole && command.duty > 0.0;
    switch_source(whole || (chops && !config_.centre_aligned));
    if (chops && config_.centre_aligned) on_edge_ = t.plus_ticks(in_counts((period - on_time) / 2));
    if (chops) off_edge_ = t.plus_ticks(in_counts(config_.centre_aligned ? (period + on_time) / 2 : on_time));
  }
  tell_legs(t, entered);
}

void Modulator::commutate(const Instant& t, control::Pair pair) {
  const Entered entered = hand_over(pair);
  command_.pair = pair;
  tell_legs(t, entered);
}

void Modulator::turn_off(const Instant& t) {
  command_.enabled = false;
  tell_legs(t, nullptr);
}

void Modulator::switch_source(bool on) {
  turn_ons_ += on && !source_on_;
  source_on_ = on;
}

/// Six-step's three leg commands (model.md 3). What a leg that has just entered the pair would turn on at
/// this instant waits too where dead time at commutation is asked for.
void Modulator::tell_legs(const Instant& t, Entered entered) {
  std::array<LegSide, 3> sides{};
  if (command_.enabled) {
    const bool hard = command_.chopping == Chopping::hard;
    const bool returns = !hard || (command_.watch == Watch::phase ? sink_on_ : source_on_);
    const LegSide off = command_.chopping == Chopping::complementary ? LegSide::low : LegSide::none;
    sides[index(command_.pair.source)] = source_on_ ? LegSide::high : off;
    sides[index(command_.pair.sink)] = returns ? LegSide::low : LegSide::none;
  }
  for (unsigned k = 0; k < 3; ++k) legs_[k].tell(t, sides[k], dead_ticks_);
  if (entered != nullptr && config_.dead_time_at_commutation) entered->delay(t, dead_ticks_);
  look_at_legs();
}

void Modulator::look_at_legs() {
  unsigned high = 0, low = 0;
  wait_end_ = Instant::never();
  for (unsigned k = 0; k < 3; ++k) {
    const LegChannel& leg = legs_[k];
    high |= unsigned{leg.is_on(LegSide::high)} << k;
    low |= unsigned{leg.is_on(LegSide::low)} << k;
    if (leg.waits() && leg.from() < wait_end_) wait_end_ = leg.from();
  }
  // A pair of one leg asks for both its switches: what no channel does, the plant is to refuse.
  if (command_.enabled && command_.pair.source == command_.pair.sink) high |= low;
  gates_ = {high, low};
}

Instant Modulator::next_edge() const {
  const Instant& edge = on_edge_ < off_edge_ ? on_edge_ : off_edge_;
  return wait_end_ < edge ? wait_end_ : edge;
}

bool Modulator::act(const Instant& now) {
  bool acted = false;
  const auto due = [&](Instant& edge) {
    if (now < edge) return false;
    edge = Instant::never();
    return acted = true;
  };
  if (due(wait_end_))
    for (LegChannel& leg : legs_) leg.look(now);
  if (due(on_edge_)) switch_source(true);
  if (due(off_edge_)) switch_source(false);
  if (acted) tell_legs(now, nullptr);
  return acted;
}

ArmedComparator Modulator::comparator(int which) const {
  const bool second = which == 1;
  if (!command_.enabled || command_.watch == Watch::none) return {};
  if (second && !(command_.watch == Watch::phase && command_.chopping == Chopping::hard)) return {};
  const bool on = second ? sink_on_ : source_on_;
  return {true, on, on ? command_.off_above_A : command_.on_below_A};
}

plant::PerLeg<double> Modulator::comparator_weights(int which) const {
  plant::PerLeg<double> weight{};
  const double share = command_.watch == Watch::motor ? 0.5 : 1.0;
  if (command_.watch == Watch::motor || which == 0) weight[index(command_.pair.source)] = share;
  if (command_.watch == Watch::motor || which == 1) weight[index(command_.pair.sink)] = -share;
  return weight;
}

void Modulator::comparator_tripped(const Instant& now, int which) {
  if (which == 1) {
    sink_on_ = !sink_on_;
    turn_ons_ += sink_on_;
  } else {
    switch_source(!source_on_);
  }
  tell_legs(now, nullptr);
}

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/rig/modulator.hpp"

#include <cmath>

namespace sixstep::rig {

using control::Chopping;
using control::Watch;
using sim::Instant;

namespace {

int index(control::Leg leg) { return static_cast<int>(leg); }

}  // namespace

Instant Modulator::edge_at(const Instant& t, double ticks) const {
  if (config_.timer_ticks > 0) ticks = std::floor(ticks / config_.timer_ticks + 0.5) * config_.timer_ticks;
  return t.plus_ticks(ticks);
}

void Modulator::take(const Instant& t, const BoardCommand& command) {
  const bool goes_on = command_.enabled && command.enabled;
  const bool leg_changed = goes_on && !(command.pair.source == command_.pair.source);
  const bool was_low = command_.chopping == Chopping::complementary && !source_on_;
  const bool goes_low = command.chopping == Chopping::complementary && !source_on_;
  low_was_on_ = leg_changed || (goes_on && was_low && !goes_low);
  // Soft or hard chopping may have turned the upper switch off a moment ago: the lower one waits.
  if (goes_on && !leg_changed && goes_low && !was_low && t < edge_at(upper_off_, config_.dead_ticks))
    wait_dead_time(upper_off_);
  const bool wakes = command.enabled && !command_.enabled;
  // Field by field, as it was written: a copy in wider pieces would wait until the fields have left for
  // memory.
  command_.enabled = command.enabled;
  command_.pair = command.pair;
  command_.duty = command.duty;
  command_.chopping = command.chopping;
  command_.watch = command.watch;
  command_.on_below_A = command.on_below_A;
  command_.off_above_A = command.off_above_A;
  if (!wakes) {
    // A hysteresis that changes direction keeps its state, but the new source leg was the sink a moment ago.
    if (command.watch != Watch::none && leg_changed && source_on_) command_source(t, true, true);
    return;
  }
  // The first turn-on waits for the dead time too: nobody knows what the leg did before.
  source_on_ = false;
  sink_on_ = true;
  if (config_.dead_ticks > 0 && command.chopping == Chopping::complementary) wait_dead_time(t);
  if (command.watch != Watch::none) command_source(t, true, true);  // hysteresis starts on (MODEL 4)
}

void Modulator::start_period(const Instant& t, const BoardCommand& command) {
  take(t, command);
  on_edge_ = Instant::never();
  off_edge_ = Instant::never();
  if (!command.enabled || command.watch != Watch::none) return;
  const auto period = static_cast<double>(config_.period_ticks);
  const double on_time = command.duty * period;
  if (command.duty >= 1.0) {
    command_source(t, true, low_was_on_);
  } else if (!(command.duty > 0.0)) {
    command_source(t, false, low_was_on_);
  } else if (config_.centre_aligned) {
    command_source(t, false, low_was_on_);
    // An on-edge that comes within the dead time waits for its end.
    if (low_was_on_ && config_.dead_ticks > 0) wait_dead_time(t);
    on_edge_ = edge_at(t, (period - on_time) / 2);
    off_edge_ = edge_at(t, (period + on_time) / 2);
  } else {
    command_source(t, true, low_was_on_);
    off_edge_ = edge_at(t, on_time);
  }
}

/// Turn-on and turn-off of the source leg's upper switch. Dead time delays a turn-on after the other switch
/// of the leg was told to turn off: in complementary chopping at each edge, else only where the leg was the
/// sink a moment ago or chopped complementarily.
void Modulator::command_source(const Instant& t, bool on, bool low_was_on) {
  const bool waits = config_.dead_ticks > 0;
  const bool complementary = command_.chopping == Chopping::complementary;
  if (source_on_ == on && !(on && low_was_on && waits)) return;
  if (on && !source_on_) ++turn_ons_;
  source_on_ = on;
  if (!on) upper_off_ = t;
  if (waits && (complementary || (on && low_was_on))) wait_dead_time(t);
}

void Modulator::wait_dead_time(const Instant& t) {
  dead_ = true;
  dead_end_ = edge_at(t, config_.dead_ticks);
}

void Modulator::commutate(const Instant& t, control::Pair pair) {
  const plant::Gates before = gates();
  command_.pair = pair;
  if (!config_.dead_time_at_commutation || !(config_.dead_ticks > 0)) return;
  const plant::Gates after = wanted_gates();
  blanked_ = {after.high & ~before.high, after.low & ~before.low};
  const bool any = blanked_.high.any() || blanked_.low.any();
  blank_end_ = any ? edge_at(t, config_.dead_ticks) : Instant::never();
}

Instant Modulator::next_edge() const {
  const Instant* next = on_edge_ < off_edge_ ? &on_edge_ : &off_edge_;
  next = dead_end_ < *next ? &dead_end_ : next;
  return blank_end_ < *next ? blank_end_ : *next;
}

bool Modulator::act(const Instant& now) {
  bool acted = false;
  const auto due = [&](Instant& edge) {
    if (now < edge) return false;
    edge = Instant::never();
    return acted = true;
  };
  if (due(dead_end_)) dead_ = false;
  if (due(blank_end_)) blanked_ = {};
  if (due(on_edge_)) command_source(now, true, false);
  if (due(off_edge_)) command_source(now, false, false);
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
    command_source(now, !source_on_, false);
  }
}

plant::Gates Modulator::wanted_gates() const {
  plant::Gates gates{};
  if (!command_.enabled) return gates;
  const int source = index(command_.pair.source), sink = index(command_.pair.sink);
  gates.high[source] = source_on_ && !dead_;
  gates.low[source] = command_.chopping == Chopping::complementary && !source_on_ && !dead_;
  const bool both_comparators = command_.watch == Watch::phase;
  gates.low[sink] = gates.low[sink] || command_.chopping != Chopping::hard ||
                    (both_comparators ? sink_on_ : source_on_ && !dead_);
  return gates;
}

plant::Gates Modulator::gates() const {
  plant::Gates gates = wanted_gates();
  if (blank_end_ == Instant::never()) return gates;
  gates.high &= ~blanked_.high;
  gates.low &= ~blanked_.low;
  return gates;
}

}  // namespace sixstep::rig

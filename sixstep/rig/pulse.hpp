// SPDX-License-Identifier: Apache-2.0
// One compare unit of the timer: begin and end of a pulse in a PWM period (model.md 3).
#pragma once
#include <cmath>
#include <cstdint>

#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

struct ModulatorConfig {
  std::int64_t period_ticks = 30'000'000;
  bool centre_aligned = false;
  double dead_ticks = 0.0;
  bool dead_time_at_commutation = false;
  double timer_ticks = 0.0;          ///< ps per count of the timer; 0: edges are exact
  double minimum_pulse_ticks = 0.0;  ///< ps; shorter pulses and gaps are removed; 0: no minimum

  /// Rounds a time, ps, to counts of the timer.
  double in_counts(double ticks) const {
    if (!(timer_ticks > 0)) return ticks;
    // mutant: ticks / timer_ticks + 0.5 => ticks / timer_ticks
    return std::floor(ticks / timer_ticks + 0.5) * timer_ticks;
  }
};

struct Pulse {
  bool on = false;
  sim::Instant on_edge = sim::Instant::never(), off_edge = sim::Instant::never();

  const sim::Instant& next() const { return on_edge < off_edge ? on_edge : off_edge; }
  // The two members are set separately. A copy of the first would stall the processor until both halves are
  // in memory.
  void cancel() {
    on_edge = sim::Instant::never();
    off_edge = sim::Instant::never();
  }
  /// Sets the edges of a period that begins at t; returns true if the pulse is on at t. With a duty of 1
  /// there is no gap, with a duty of 0 no pulse. A pulse that is too short for the gate drivers is omitted,
  /// and a gap that is too short is closed.
  bool begin(const sim::Instant& t, double duty, const ModulatorConfig& c) {
    const auto period = static_cast<double>(c.period_ticks);
    const double on_time = duty * period;
    // mutant: period - on_time < c.minimum_pulse_ticks => false
    const bool whole = duty >= 1.0 || period - on_time < c.minimum_pulse_ticks;
    // mutant: on_time < c.minimum_pulse_ticks => false
    const bool chops = !whole && duty > 0.0 && !(on_time < c.minimum_pulse_ticks);
    cancel();
    if (chops && c.centre_aligned) on_edge = t.plus_ticks(c.in_counts((period - on_time) / 2));
    if (chops) off_edge = t.plus_ticks(c.in_counts(c.centre_aligned ? (period + on_time) / 2 : on_time));
    return whole || (chops && !c.centre_aligned);
  }
};

}  // namespace sixstep::rig

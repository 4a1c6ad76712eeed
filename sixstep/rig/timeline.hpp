// SPDX-License-Identifier: Apache-2.0
// The timeline: all actions of a scenario on a run, as one sorted list of typed actions at known instants.
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

enum class ActionKind : std::uint8_t {
  setpoint,
  load_torque,
  hall_stuck,
  run_request,
  clear_request,
  shaft_locked,
  source_voltage,
  source_sinks,
  hall_whole,
  retune,
  dead_time,
  wire_break,
  switch_open,
  switch_short,
  shaft_speed,
  wire_phases,
  wire_probes,
  invert_lines,
  current_offset,
  current_gain,
  hall_glitch,
  encoder_misses,
  track_sticks,
  track_whole,
  winding_breaks,
  encoder_line_sticks,
  encoder_line_whole,
  false_index,
  excitation,
  divider_breaks
};

/// Motion of a setpoint from its action on: after t seconds its value is
///   value + rate t + curvature t^2/2 + amplitude sin(2 pi (frequency_Hz t + phase_turns)).
/// A control tick evaluates it; between two ticks the chip keeps that value.
struct Waveform {
  double rate = 0.0;       ///< per s
  double curvature = 0.0;  ///< per s^2
  double amplitude = 0.0;
  double frequency_Hz = 0.0;
  double phase_turns = 0.0;

  bool moves() const { return rate != 0.0 || curvature != 0.0 || amplitude != 0.0; }
  /// Turns are counted, so that only their fraction enters the sine.
  double after(double value, double t_s) const {
    // mutant: curvature / 2 * t_s => 0.0
    const double straight = value + (rate + curvature / 2 * t_s) * t_s;
    if (amplitude == 0.0) return straight;
    const double turns = frequency_Hz * t_s + phase_turns;
    // mutant: std::floor(turns) => 0.0
    return straight + amplitude * base::sin(2 * base::pi * (turns - std::floor(turns)));
  }
};

struct Action {
  sim::Instant at;
  ActionKind kind = ActionKind::setpoint;
  double value = 0.0;  ///< setpoint in the mode's unit; N m; Hall line 1 to 3, stuck low where negative;
                       ///< V; a request to run, a clamp on the shaft, a sinking source: 1 or 0; which of
                       ///< the rig's tunings; ps; the phase, 0 to 2; a WireOrder; Hall lines as bits;
                       ///< A; a part of the current; T1 to T6 as 1 to 6; rad/s;
                       ///< the probe 1 to 3 whose line turns over; edges of an encoder;
                       ///< 1 + the bit of a Gray code, stuck low where negative; a resolver's winding 1 or 2,
  ///< 0 both whole; A, B, Z as 1 to 3, stuck low where negative; a part of the excitation;
  ///< the leg, 0 to 2, whose divider breaks
  Waveform waveform{};  ///< motion of a setpoint; for a load torque and a shaft's speed only the rate
};

/// Sorted by time, stable where times are equal.
using Timeline = std::vector<Action>;

}  // namespace sixstep::rig

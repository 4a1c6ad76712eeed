// SPDX-License-Identifier: Apache-2.0
// The timeline: all actions of a scenario, sorted by time.
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// Kinds of actions. The comments are the meaning and unit of Action::value.
enum class ActionKind : std::uint8_t {
  setpoint,             ///< the new setpoint, in the mode's unit
  load_torque,          ///< N m
  hall_stuck,           ///< Hall line 1 to 3; negative: stuck low
  run_request,          ///< 1: run, 0: stop
  clear_request,        ///< not used
  shaft_locked,         ///< 1: a clamp holds the shaft, 0: the shaft is free
  source_voltage,       ///< V
  source_sinks,         ///< 1: the source can absorb current, 0: it cannot
  hall_whole,           ///< Hall line 1 to 3
  retune,               ///< index of the rig's tunings
  dead_time,            ///< ps
  wire_break,           ///< phase 0 to 2
  switch_open,          ///< T1 to T6 as 1 to 6
  switch_short,         ///< T1 to T6 as 1 to 6
  shaft_speed,          ///< rad/s
  wire_phases,          ///< a WireOrder
  wire_probes,          ///< a WireOrder
  invert_lines,         ///< mask of Hall lines, as bits of a code
  current_offset,       ///< A
  current_gain,         ///< relative error of the gain
  hall_glitch,          ///< probe 1 to 3 whose line is inverted
  encoder_misses,       ///< number of edges
  track_sticks,         ///< 1 + the bit of a Gray code; negative: stuck low
  track_whole,          ///< 1 + the bit of a Gray code
  winding_breaks,       ///< a resolver's winding 1 or 2; 0: both are intact
  encoder_line_sticks,  ///< A, B, Z as 1 to 3; negative: stuck low
  encoder_line_whole,   ///< A, B, Z as 1 to 3
  false_index,          ///< not used
  excitation,           ///< amplitude relative to the intact excitation
  divider_breaks        ///< leg 0 to 2
};

/// Setpoint as a function of the time t since its action, in s:
///   value + rate t + curvature t^2/2 + amplitude sin(2 pi (frequency_Hz t + phase_turns)).
/// A control tick evaluates the waveform; between two ticks the setpoint keeps the value of the last tick.
struct Waveform {
  double rate = 0.0;       ///< per s
  double curvature = 0.0;  ///< per s^2
  double amplitude = 0.0;
  double frequency_Hz = 0.0;
  double phase_turns = 0.0;

  bool moves() const { return rate != 0.0 || curvature != 0.0 || amplitude != 0.0; }
  /// Value after t_s seconds, in the unit of `value`. Whole turns are removed before the sine, for accuracy
  /// at large t_s.
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
  double value = 0.0;   ///< meaning and unit depend on `kind`
  Waveform waveform{};  ///< for a setpoint; for load_torque and shaft_speed only `rate` is used
};

/// Actions sorted by time. Actions at the same time have the order of the scenario.
using Timeline = std::vector<Action>;

}  // namespace sixstep::rig

// SPDX-License-Identifier: Apache-2.0
// Finds the back-EMF's zero crossing in the floating leg, from the three terminal voltages.
//
//   2 u_f - u_s - u_k = 2 e_f (trapezoid), 3 e_f (sine)      if both driven legs s, k are connected and the
//                                                            floating leg f carries no current (model.md 2)
//
// The voltages of star point and bus cancel in this sum. With the driven legs at both rails, by switches or
// diodes, u_s + u_k is the bus; in a freewheel through two lower switches or diodes it is about zero. The
// crossing is in the middle of a sector. The back-EMF falls in sectors 0, 2, 4 and rises in 1, 3, 5, in both
// directions of rotation. y is this sum, with its sign reversed in sectors 1, 3, 5: y > 0 before the
// crossing, y < 0 after it.
//
// After a commutation the floating leg's old current decays through a diode, and the terminal is at a rail.
// There are three cases.
//   driving motor    At this rail y has the sign after the crossing. Until the current has ended, y is
//                    ignored (blanking). The duration of the blanking is measured.
//   braking motor    At the opposite rail y has the sign before the crossing: no blanking is needed.
//   small duty       In soft chopping a negative e_f drives a current through the leg's lower diode, and the
//                    on-time is too short to end this current. The leg is at the lower rail, which
//                    corresponds to the sign of e_f.
// The crossing is the zero of the straight line between the last sample with y > 0 and the first sample with
// y <= 0. If the last sample with y > 0 was at the rail, its value is unknown. The crossing is then halfway
// between the two samples.
//
// All numbers are integers: counts of the converter, the same for terminals and bus, and counts of the timer.
// Every arithmetic of the drive uses the same integers; this file therefore has no Scalar.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"

namespace sixstep::control {

/// Part of the PWM period in which the samples are taken. In soft chopping the samples of both parts show the
/// star point, but in the freewheel only the positive half of the back-EMF. In hard chopping the samples show
/// the star point in the on-time, and in the freewheel as long as current flows.
enum class NeutralSeen : std::uint8_t { on_time, freewheel };

/// Voltages of terminals and bus at one instant, measured through equal dividers.
struct TerminalSample {
  std::uint16_t u[3]{};   ///< a, b, c, counts
  std::uint16_t bus = 0;  ///< counts
  std::uint32_t at = 0;   ///< the timer's reading
};

/// Default: no crossing is found.
struct ZeroCrossingConfig {
  NeutralSeen seen = NeutralSeen::on_time;
  std::uint16_t rail_counts = 0;        ///< a terminal within this distance from a rail counts as clamped by
                                        ///< a diode or a switch
  std::int32_t threshold = 0x7fffffff;  ///< counts of |y| above which y counts as a voltage, not as noise
  std::int32_t below = 0x7fffffff;      ///< threshold for negative voltages; less in a freewheel, where a
                                        ///< diode clamps u_f
  std::uint32_t margin_ticks = 0;       ///< blanking after the freewheel's end
  std::uint32_t settle_ticks = 0;       ///< ticks from the commutation until filters have settled
  bool operator==(const ZeroCrossingConfig&) const = default;
};

struct ZeroCrossingState {
  std::uint8_t sector = no_sector;
  bool freewheels = false;      ///< true: the leg's old current may still flow
  bool hidden = false;          ///< true: a sample of this sector has shown the old current
  bool armed = false;           ///< true: y was above the threshold in this sector
  bool done = false;            ///< true: the crossing of this sector has been found, or had passed
  std::uint8_t unlike = 0;      ///< consecutive samples that contradict the command
  std::uint32_t began = 0;      ///< time of the commutation
  std::uint32_t earliest = 0;   ///< ticks since `began` before which no crossing is possible
  std::uint32_t blank = 0;      ///< ticks since `began` up to which samples are ignored
  std::uint32_t freewheel = 0;  ///< ticks of the last freewheel, with the resolution of the samples
  bool held = false;            ///< true: at the last sample a diode clamped the terminal
  std::uint32_t at = 0;         ///< time of the last y
  std::int32_t y = 0;           ///< value of y at the last evaluated sample
};

enum class Crossing : std::uint8_t {
  none,
  seen,          ///< a crossing at the time `at`
  passed_before  ///< a crossing between the commutation and `at` that could not be detected
};

struct CrossingReading {
  Crossing crossing = Crossing::none;
  std::uint32_t at = 0;
  bool visible = false;  ///< true: the sample shows the star point
  bool free = false;     ///< true: the sample also shows the back-EMF y, because no diode clamps the terminal
  std::int32_t y = 0;    ///< valid if `visible`, also during the blanking
};

/// The leg, 0..2, that floats in a sector.
constexpr std::uint8_t floating_leg(std::uint8_t sector) { return static_cast<std::uint8_t>(2 - sector % 3); }

/// Twice the voltage of `leg` minus the voltages of the two other legs, counts: y or -y.
constexpr std::int32_t above_neutral(const TerminalSample& s, std::uint8_t leg) {
  const std::int32_t u = s.u[leg];
  return u + u + u - static_cast<std::int32_t>(s.u[0]) - static_cast<std::int32_t>(s.u[1]) -
         static_cast<std::int32_t>(s.u[2]);
}

/// Begins a sector. `earliest_ticks`: time from now before which no crossing is possible.
constexpr void zero_crossing_begin(ZeroCrossingState& state, std::uint8_t sector,
                                   std::uint32_t earliest_ticks, std::uint32_t now) {
  state.sector = sector;
  state.freewheels = true;
  state.hidden = false;
  state.armed = false;
  state.done = false;
  state.began = now;
  state.earliest = earliest_ticks;
  state.blank = 0;
  state.y = 0;
}

namespace detail {

/// True if the two driven legs have voltages at which the sample shows the star point.
constexpr bool neutral_visible(const ZeroCrossingConfig& config, const TerminalSample& s, std::uint8_t leg) {
  const std::int32_t first = s.u[(leg + 1) % 3], second = s.u[(leg + 2) % 3], bus = s.bus;
  const std::int32_t apart = first > second ? first - second : second - first;
  const bool at_both_rails = apart + apart > bus;
  if (config.seen == NeutralSeen::on_time) return at_both_rails;
  const std::int32_t rail = config.rail_counts;
  return at_both_rails || (first <= rail && second <= rail) || (first + rail >= bus && second + rail >= bus);
}

constexpr bool at_rail(const ZeroCrossingConfig& config, const TerminalSample& s, std::uint8_t leg,
                       bool low) {
  const std::int32_t u = s.u[leg], rail = config.rail_counts, bus = s.bus;
  return low ? u <= rail : u + rail >= bus;
}

/// Time of the zero of the straight line from (from, y > 0) to (to, y <= 0).
constexpr std::uint32_t crossed_at(std::uint32_t from, std::int32_t y_from, std::uint32_t to,
                                   std::int32_t y_to) {
  std::uint32_t before = static_cast<std::uint32_t>(y_from);
  std::uint32_t sum = before + static_cast<std::uint32_t>(-y_to);
  const std::uint32_t ticks = to - from;
  while (before > (ticks == 0 ? 0xffffffffu
                              : 0xffffffffu / ticks)) {  // drops bits of both numbers until the product fits
    before >>= 1;
    sum >>= 1;
  }
  return sum == 0 ? to : from + ticks * before / sum;
}

constexpr CrossingReading look(const ZeroCrossingConfig& config, ZeroCrossingState& state, std::uint32_t now,
                               std::int32_t y, bool held) {
  CrossingReading reading{Crossing::none, now, true, !held, y};
  const bool falls = state.sector % 2 == 0;
  const bool early = static_cast<std::uint32_t>(now - state.began) < state.earliest;
  // `below` is for a negative terminal voltage, whose magnitude is smaller in a freewheel.
  const std::int32_t before = falls ? config.threshold : config.below,
                     after = falls ? config.below : config.threshold;
  if (y > before) state.armed = true;
  if (!early && state.armed && y <= 0) {
    reading.crossing = Crossing::seen;
    if (state.y > 0) reading.at = crossed_at(state.at, state.held ? -y : state.y, now, y);
  } else if (!early && !state.armed && y < -after) {
    reading.crossing = Crossing::passed_before;
  }
  state.done = reading.crossing != Crossing::none;
  state.y = y;
  state.held = held;
  state.at = now;
  return reading;
}

/// One sample. Calls look(y, held) under three conditions: the star point is visible, no old current hides
/// the back-EMF, and no crossing has been found in this sector yet.
template <class Look>
constexpr CrossingReading looked_at(const ZeroCrossingConfig& config, ZeroCrossingState& state,
                                    const TerminalSample& s, bool on, Look&& look) {
  if (state.sector > 5) return {};
  const std::uint8_t leg = floating_leg(state.sector);
  const bool visible = neutral_visible(config, s, leg);
  if (visible || !on)
    state.unlike = 0;
  else if (state.unlike < 255)
    ++state.unlike;
  if (!visible) return {};
  const std::int32_t sum = above_neutral(s, leg);
  const bool falls = state.sector % 2 == 0;
  const std::int32_t y = falls ? sum : -sum;
  const std::uint32_t since = s.at - state.began;
  if (since < config.settle_ticks) return {Crossing::none, s.at, true, false, y};
  if (state.freewheels) {
    state.freewheel = since;
    if (at_rail(config, s, leg, falls)) {
      state.hidden = true;
      return {Crossing::none, s.at, true, false, y};
    }
    state.freewheels = false;
    state.blank = since + config.margin_ticks;
  }
  if (since < state.blank) return {Crossing::none, s.at, true, false, y};
  const bool held = at_rail(config, s, leg, !falls);
  if (state.done) return {Crossing::none, s.at, true, !held && !at_rail(config, s, leg, falls), y};
  return look(y, held);
}

}  // namespace detail

/// One sample. `on`: the pair's switches are on at the sample; the driven legs must then be at the rails.
constexpr CrossingReading zero_crossing_step(const ZeroCrossingConfig& config, ZeroCrossingState& state,
                                             const TerminalSample& s, bool on) {
  return detail::looked_at(config, state, s, on, [&](std::int32_t y, bool held) {
    return detail::look(config, state, s.at, y, held);
  });
}

}  // namespace sixstep::control

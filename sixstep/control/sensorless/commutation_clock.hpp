// SPDX-License-Identifier: Apache-2.0
// Computes the time of the next commutation from the times of the zero crossings (zero_crossing.hpp):
//
//   T = mean of the last k intervals between crossings; if the last interval differs from the mean by more
//       than a quarter, only the last interval
//   t = crossing + T (1/2 - advance) - lead,     not before the crossing
//
// For a crossing that was not found, the expected time is stored. When the next crossing is found, the stored
// time changes to the middle between the times before and after it. A wrong guess therefore has little effect
// on T.
//
// A crossing is in the middle of its sector, and the commutation follows 30 degrees later. The advance is an
// angle. The lead is a time: it compensates a phase's L/R and the delay of filters and converters. Times are
// readings of a free-running 32-bit counter, finer than the control tick; a compare match of this counter
// commutates.
#pragma once
#include <cstdint>

#include "sixstep/control/hall_speed.hpp"

namespace sixstep::control {

struct CommutationClockConfig {
  std::uint8_t crossings = 2;    ///< k, number of intervals in the mean, 1..6
  std::uint16_t advance = 0;     ///< angle in 1/65536 of a sector (60 degrees): 32768 is 30 degrees
  std::uint32_t lead_ticks = 0;  ///< ticks of the timer
  bool operator==(const CommutationClockConfig&) const = default;
};

struct CommutationClockState {
  HallSpeedState crossings{};  ///< times of the crossings, stored like times of Hall edges
  std::uint32_t next = 0;      ///< time of the next commutation
  bool scheduled = false;      ///< true: `next` is valid
  bool guessed = false;        ///< true: the last crossing was not found, and its time is a guess
};

/// True if counter reading `a` is before `b`. The difference of the two readings must be less than half of
/// the counter's range.
constexpr bool comes_before(std::uint32_t a, std::uint32_t b) {
  return a != b && static_cast<std::uint32_t>(b - a) < 0x80000000u;
}

/// Adds a crossing that was found.
constexpr void commutation_clock_crossing(CommutationClockState& state, std::uint32_t at,
                                          std::int8_t direction) {
  HallSpeedState& c = state.crossings;
  if (state.guessed && c.known > 1) c.times[0] = c.times[1] + static_cast<std::uint32_t>(at - c.times[1]) / 2;
  state.guessed = false;
  hall_speed_edge(c, at, direction);
}

/// Adds a guess for a crossing that was not found: one sector of T ticks after the last crossing, but at most
/// now.
constexpr void commutation_clock_guess(CommutationClockState& state, std::uint32_t T, std::int8_t direction,
                                       std::uint32_t now) {
  const std::uint32_t due = state.crossings.times[0] + T;
  hall_speed_edge(state.crossings, comes_before(now, due) ? now : due, direction);
  state.guessed = true;
}

/// The last interval between two crossings in one direction, ticks; 0: no interval yet.
constexpr std::uint32_t last_interval(const CommutationClockState& state) {
  return state.crossings.known < 2
             ? 0
             : static_cast<std::uint32_t>(state.crossings.times[0] - state.crossings.times[1]);
}

/// T in ticks; 0: not available yet.
constexpr std::uint32_t sector_ticks(const CommutationClockConfig& config,
                                     const CommutationClockState& state) {
  const std::uint8_t k = hall_speed_edges(config.crossings, state.crossings.known);
  if (k == 0) return 0;
  const std::uint32_t last = last_interval(state);
  const std::uint32_t mean =
      static_cast<std::uint32_t>(state.crossings.times[0] - state.crossings.times[k]) / k;
  return alike(last, mean) ? mean : last;
}

/// Ticks from a crossing to its commutation, for sectors of T ticks.
constexpr std::uint32_t delay_ticks(const CommutationClockConfig& config, std::uint32_t T) {
  const std::uint32_t ahead = (T >> 16) * config.advance + (((T & 0xffffu) * config.advance) >> 16);
  const std::uint32_t early = ahead + config.lead_ticks;
  return T / 2 > early ? T / 2 - early : 0;
}

constexpr void schedule_commutation(CommutationClockState& state, std::uint32_t at) {
  state.next = at;
  state.scheduled = true;
}

}  // namespace sixstep::control

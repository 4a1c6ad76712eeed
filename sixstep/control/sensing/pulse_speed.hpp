// SPDX-License-Identifier: Apache-2.0
// Measures the speed of an incremental encoder by counts and time (the M/T method: T. Ohmae, T. Matsuda, K.
// Kamiyama, M. Tachikawa, "A microprocessor-controlled high-accuracy wide-range speed regulator for motor
// drives", IEEE Trans. Ind. Electron. IE-29, 1982).
//
//   w = M (2 pi/4N) timer_Hz/T     M counts in the time T, from the last edge before a control tick to the
//                                  last edge before a later control tick
//   |w| <= (2 pi/4N) timer_Hz/(ticks since the last edge minus one)     until the next edge occurs
//
// N is the number of lines. M is exact, because it counts from edge to edge, and T is exact to one tick of
// the timer. The relative error of w is therefore 1/T at every speed, plus the placement errors of the lines
// (which cancel if M is a multiple of 4). The age of a measured speed is half of T plus the time since the
// last edge. An edge is at the same angle in both directions; the method therefore measures a reversal
// correctly. The first edge and a time-out restart the measurement with speed 0.
//
// Suppose that the timer misses a fraction e of the edges, with M edges per control tick. Averaged over the
// times T, the speed is then too low by exactly the fraction e, because the sum of w T equals the counts. A
// loop, however, weights each reading by one tick. For the loop the relative error is
//
//   missed before another edge    factor 1 - 1/M in this tick, in M - 1 of M cases
//   missed as a tick's last edge  the bound, c/since with `since` from c to 2 c (c: ticks of a count): on
//                                 average too low by 1 - ln 2; and the factor M/(M + 1) in the next tick
//   in total                      e (2 - ln 2 - 1/(M (M + 1))): 0.81 e at M = 1, 1.14 e at 2, 1.31 e for many
//
// The bound has the same effect for a missed edge as for a shaft that slows down, because the two cases
// cannot be distinguished before the next edge. Without the bound the measured speed of a stopping shaft
// would not fall until the time-out. A bound that tolerates one missed edge would act twice as late.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

/// Default: the speed is always 0. In 16-bit formats T must be below 2^16 times (speed divided by its base).
/// A longer T with M > 1 saturates.
template <class Scalar>
struct PulseSpeedConfig {
  TickRatio<Scalar> count_rad_s_ticks{};  ///< 2 pi/(4 N) timer_Hz: product of speed and ticks of one count
  std::uint32_t timeout_ticks = 0;        ///< ticks without an edge after which the rotor counts as at rest;
                                          ///< below 2^31
  bool operator==(const PulseSpeedConfig&) const = default;
};

struct PulseSpeedState {
  std::uint32_t count = 0;       ///< counted edges; the count wraps, and an index does not change it
  std::uint32_t place = 0;       ///< count at the last edge: the border between two counts
  std::uint32_t time = 0;        ///< time of the last edge
  std::uint32_t from_place = 0;  ///< value of `place` at the last edge that a control tick used
  std::uint32_t from_time = 0;
  std::int32_t moved = 0;   ///< M, number of counts in the last measurement
  std::uint32_t ticks = 0;  ///< T, timer ticks of the last measurement; 0: the speed is unknown
  bool fresh = false;       ///< true: an edge has occurred since the last control tick
  bool begun = false;       ///< true: from_place and from_time are valid
};

/// Adds the `moved` counts since the last call. The last count was in `direction` (+1, -1) at counter reading
/// `time`. Call it at each edge with moved = direction, or once per tick from a counter and its capture
/// register.
constexpr void pulse_edge(PulseSpeedState& state, std::int32_t moved, std::int8_t direction,
                          std::uint32_t time) {
  state.count += static_cast<std::uint32_t>(moved);
  state.place = state.count + (direction < 0 ? 1u : 0u);
  state.time = time;
  state.fresh = true;
}

namespace detail {

constexpr void take_pulses(PulseSpeedState& state) {
  if (!state.fresh) return;
  if (state.begun) {
    state.moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(state.place - state.from_place));
    const std::uint32_t ticks = static_cast<std::uint32_t>(state.time - state.from_time);
    state.ticks = ticks == 0 ? 1 : ticks;
  }
  state.from_place = state.place;
  state.from_time = state.time;
  state.begun = true;
  state.fresh = false;
}

}  // namespace detail

/// Speed at counter reading `now`, mechanical rad/s. Call it once per control tick.
template <class Scalar>
constexpr Scalar pulse_speed(const PulseSpeedConfig<Scalar>& config, PulseSpeedState& state,
                             std::uint32_t now) {
  using T = ScalarTraits<Scalar>;
  detail::take_pulses(state);
  if (!state.begun) return Scalar{};
  const std::uint32_t since = static_cast<std::uint32_t>(now - state.time);
  if (since > config.timeout_ticks) {
    state.begun = false;
    state.ticks = 0;
    return Scalar{};
  }
  if (state.ticks == 0 || state.moved == 0) return Scalar{};
  const std::uint32_t counts = detail::absolute(state.moved);
  Scalar w = T::per_ticks(AngleTraits<Scalar>::counted(config.count_rad_s_ticks, counts), state.ticks);
  // Only after the mean time of a count can the bound be below the measured speed. One tick is subtracted,
  // because the edge may have occurred up to one timer tick after the captured reading.
  if (since - 1 > state.ticks / counts && since > 1) {
    const Scalar bound = T::per_ticks(config.count_rad_s_ticks, since - 1);
    if (bound < w) w = bound;
  }
  return state.moved < 0 ? -w : w;
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Speed of an incremental encoder by counts and time (the M/T method: T. Ohmae, T. Matsuda, K. Kamiyama,
// M. Tachikawa, "A microprocessor-controlled high-accuracy wide-range speed regulator for motor drives", IEEE
// Trans. Ind. Electron. IE-29, 1982).
//
//   w = M (2 pi/4N) timer_Hz/T             M counts between the last edges that two control ticks saw, T apart
//   |w| <= (2 pi/4N) timer_Hz/(ticks since the last edge less one)     the next edge has not come yet
//
// Both ends are edges, so M is exact, and T is known to a tick of the timer: w to 1/T of itself at every speed,
// apart from what the lines' own places are off (they cancel where M is a multiple of 4). A speed is half of T
// and the time since the last edge old. An edge passed back is at the same place as when it was passed before:
// a reversal counts as what it is. The first edge and a time-out begin anew, with speed 0.
//
// Edges that the timer misses, a share e of them, M to a control tick: over its own windows the speed is lowered by exactly e,
// since w T sums up to the counts. A loop weighs each reading by a tick instead, and there
//
//   missed before another one     1 - 1/M in that tick, M - 1 times of M
//   missed as a tick's last one   the bound, c/since with since from c to 2 c, 1 - ln 2 too low in the mean, and in the tick
//                                 behind it M/(M + 1)
//   together                      e (2 - ln 2 - 1/(M (M + 1))): 0.81 e at M = 1, 1.14 e at 2, 1.31 e at many
//
// The bound takes it for a shaft that slows down, and no one can tell the two apart before the next edge comes: without it a
// shaft that stops would keep its speed up to the time-out, and a bound that grants a missed edge is twice as late.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

/// The default measures no speed. In 16-bit formats T below 2^16 times the speed's part of its base: a longer
/// one, of M > 1, saturates.
template <class Scalar>
struct PulseSpeedConfig {
  TickRatio<Scalar> count_rad_s_ticks{};  ///< 2 pi/(4 N) timer_Hz: speed times ticks of one count
  std::uint32_t timeout_ticks = 0;        ///< no edge for so long is standstill; below 2^31
  bool operator==(const PulseSpeedConfig&) const = default;
};

struct PulseSpeedState {
  std::uint32_t count = 0;       ///< wraps; knows nothing of the index
  std::uint32_t place = 0;       ///< of the last edge, in counts: a border between two of them
  std::uint32_t time = 0;        ///< of the last edge
  std::uint32_t from_place = 0;  ///< of the last one that a control tick saw
  std::uint32_t from_time = 0;
  std::int32_t moved = 0;   ///< M
  std::uint32_t ticks = 0;  ///< T; 0: no speed is known
  bool fresh = false;       ///< an edge since the last control tick
  bool begun = false;       ///< `from` holds
};

/// Counts passed since the last call, the last of them in `direction` (+1, -1) at counter reading `time`: at
/// each edge with moved = direction, or once per tick from a counter and its capture register.
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

/// Speed at counter reading `now`, mechanical rad/s. Once per control tick.
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
  // Only past the mean count's end: before it the bound is above the speed. The edge may be younger by a tick.
  if (since - 1 > state.ticks / counts && since > 1) {
    const Scalar bound = T::per_ticks(config.count_rad_s_ticks, since - 1);
    if (bound < w) w = bound;
  }
  return state.moved < 0 ? -w : w;
}

}  // namespace sixstep::control

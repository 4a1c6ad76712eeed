// SPDX-License-Identifier: Apache-2.0
// Computes a trapezoidal profile: a position setpoint within limits of speed and acceleration that stops
// exactly on its target, in discrete time and without a square root. The velocity v is the distance per tick,
// the acceleration a the change of v per tick. Let v = (m + r) a, with an integer m and 0 <= r < 1. Braking
// by a in each tick until rest needs the distance
//
//   v + (v - a) + .. + r a = (m + 1)(v - m a/2)
//
// From the fastest v, the profile can still stop within the distance R. This v has the largest m with a m (m
// + 1)/2 <= R: v = (R + a m (m + 1)/2)/(m + 1). Each tick sets this v, but changes v by at most a and limits
// v to the speed limit. The profile accelerates, moves at constant speed and brakes. Its last step ends on
// the target. It is at least as fast as the continuous profile with the same limits. If the target is nearer
// than the stopping distance, the profile passes it and returns.
//
// In fixed point v and a are whole raw steps per tick: use enough bits (32), or a slower tick.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the position never changes.
template <class Scalar>
struct ProfileConfig {
  Scalar speed{};         ///< largest |v|, distance per tick
  Scalar acceleration{};  ///< largest change of v per tick
};

template <class Scalar>
struct ProfileState {
  Scalar position{};
  Scalar velocity{};  ///< v, distance in the last tick
};

namespace detail {

/// Largest m with a m (m + 1)/2 <= R, by bisection in at most 31 rounds. The search ends at the m of the
/// speed limit. Because m a <= fastest + a, the integer product fits into W.
template <class W>
constexpr std::int32_t braking_ticks(W R, W a, W fastest) {
  constexpr std::int32_t most = std::int32_t{1} << 30;
  std::int32_t low = 0;
  std::int32_t high = static_cast<std::int32_t>(between(fastest / a, W{}, static_cast<W>(most - 1))) + 1;
  const auto distance = [a](std::int32_t m) {
    return static_cast<W>(static_cast<W>(m) * a * static_cast<W>(m + 1) / static_cast<W>(2));
  };
  while (high - low > 1) {
    const std::int32_t middle = low + (high - low) / 2;
    (distance(middle) <= R ? low : high) = middle;
  }
  return distance(high) <= R ? high : low;
}

}  // namespace detail

template <class Scalar>
constexpr Scalar profile_step(const ProfileConfig<Scalar>& config, ProfileState<Scalar>& state,
                              Scalar target) {
  using T = ScalarTraits<Scalar>;
  using W = Wide<Scalar>;
  const W a = T::wide(config.acceleration), limit = T::wide(config.speed);
  if (!(a > W{}) || !(limit > W{})) return state.position;
  const W way = T::wide(target) - T::wide(state.position);
  const bool back = way < W{};
  const W R = back ? -way : way;
  const W last = back ? -T::wide(state.velocity) : T::wide(state.velocity);  // positive towards the target
  const std::int32_t m = detail::braking_ticks(R, a, limit);
  W v = (R + static_cast<W>(m) * a * static_cast<W>(m + 1) / static_cast<W>(2)) / static_cast<W>(m + 1);
  if (v > R) v = R;
  if (v > limit) v = limit;
  if (v > last + a) v = last + a;
  if (v < last - a) v = last - a;
  state.velocity = T::narrow(back ? -v : v);
  state.position = v == R ? target : T::narrow(T::wide(state.position) + (back ? -v : v));
  return state.position;
}

}  // namespace sixstep::control

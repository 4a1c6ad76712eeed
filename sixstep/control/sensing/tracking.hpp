// SPDX-License-Identifier: Apache-2.0
// Tracking loop of type 2: follows an angle and computes its speed, without a lag at constant speed. It is
// used for a resolver, and for any angle that has steps or noise.
//
//   e[n]     = measured[n] - angle[n]                      the shorter rotation, or from a phase detector
//   w[n+1]   = w[n] + K_i e[n]
//   angle[n+1] = angle[n] + w[n+1] + K_p e[n]              the angle predicted for the next tick
//
//   characteristic polynomial   z^2 + (K_p + K_i - 2) z + 1 - K_p
//   stable (Jury)               0 < K_p < 2,  K_i > 0,  2 K_p + K_i < 4
//   constant acceleration a     error a T^2/K_i = a/K_a,  K_a = K_i/T^2
//
// T is the time of a tick. design/loops/tracking_loop.hpp computes K_p and K_i from bandwidth and damping.
// All numbers are integers: every core computes the same bits. The rounding error is one unit of 2^-32 turn
// for the angle, and 2^-48 turn per tick for the speed.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

/// Default: the angle is always 0.
struct TrackingConfig {
  FixedGain<std::int32_t> K_p{};  ///< angle per angle and tick
  FixedGain<std::int32_t> K_i{};  ///< speed per angle and tick
  bool operator==(const TrackingConfig&) const = default;
};

struct TrackingState {
  BinaryAngle angle = 0;   ///< angle predicted for the next tick
  std::int64_t speed = 0;  ///< 2^-48 turn per tick
  std::int32_t error = 0;  ///< error of the last tick, for display
};

namespace detail {

/// gain times a signed angle; the result has `more` additional fraction bits.
constexpr std::int64_t angle_times(std::int32_t angle, const FixedGain<std::int32_t>& gain, int more) {
  const auto p = product<std::int32_t>(angle, gain.mantissa);
  const int down = gain.right - more;
  return down >= 0 ? with_sign(magnitude_down(p.size, down), p.negative)
                   : magnitude_up<std::int64_t>(p.size, p.negative, -down);
}

}  // namespace detail

/// Speed in units of 2^-32 turn per tick. Above half a turn per tick the direction of rotation is ambiguous.
constexpr std::int32_t tracking_speed(const TrackingState& state) {
  return detail::saturated<std::int32_t>(detail::shifted_down(state.speed, 16));
}

constexpr void tracking_step(const TrackingConfig& config, TrackingState& state, std::int32_t error) {
  constexpr std::int64_t most = std::int64_t{1} << 47;  // half a turn per tick
  const std::int64_t speed = detail::sum_saturated(state.speed, detail::angle_times(error, config.K_i, 16));
  state.speed = between(speed, -most, most);
  const std::int64_t step = detail::shifted_down(state.speed, 16) + detail::angle_times(error, config.K_p, 0);
  state.angle = static_cast<BinaryAngle>(state.angle + static_cast<std::uint32_t>(step));
  state.error = error;
}

/// One tick with a measured angle. `state.angle` before the call is the prediction for this angle.
constexpr void tracking_follow(const TrackingConfig& config, TrackingState& state, BinaryAngle measured) {
  tracking_step(config, state, way_between(state.angle, measured));
}

/// Speed as a signal. `per_unit` is 2 pi/(2^32 T) divided by the base of speeds; in fixed point: in raw
/// digits.
template <class Scalar>
constexpr Scalar tracked_speed(const TrackingState& state, Gain<Scalar> per_unit) {
  return AngleTraits<Scalar>::scaled(tracking_speed(state), per_unit);
}

}  // namespace sixstep::control

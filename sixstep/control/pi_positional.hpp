// SPDX-License-Identifier: Apache-2.0
// PI in positional form with back-calculation (Astrom and Hagglund, PID Controllers, 3.5):
//
//   v[n] = K e[n] + I[n] + feed_forward,   u[n] = v[n] within the limit
//   I[n+1] = I[n] + K_i e[n] + K_b (u[n] - v[n])
//
// Beside the velocity form: after saturation it loses no proportional kick, and K_b sets how fast the
// integral follows the limit: 0 not at all (it winds up), 1 at once. Free of saturation both forms have one
// transfer function: d1 = K, d0 = K_i - K.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Defaults give no output at all.
template <class Scalar>
struct PiPositionalConfig {
  Gain<Scalar> K{};    ///< output per input
  Gain<Scalar> K_i{};  ///< output per input and sample
  Gain<Scalar> K_b{};  ///< 0..1 per sample; K_i/K is usual
  Scalar limit{};      ///< |u| never exceeds it
};

template <class Scalar>
struct PiPositionalState {
  Accumulator<Scalar> integral{};
};

/// Between any two ends instead of the limit's: for a bound that moves.
template <class Scalar>
constexpr Scalar pi_positional_step(const PiPositionalConfig<Scalar>& config,
                                    PiPositionalState<Scalar>& state, Scalar error, Scalar feed_forward,
                                    Scalar low, Scalar high) {
  using T = ScalarTraits<Scalar>;
  const Accumulator<Scalar> v =
      T::accumulated(error, config.K) + state.integral + T::accumulator(feed_forward);
  const Accumulator<Scalar> u = between(v, T::accumulator(low), T::accumulator(high));
  state.integral =
      state.integral + T::accumulated(error, config.K_i) + T::accumulated(T::wide_of(u - v), config.K_b);
  return T::signal(u);
}

template <class Scalar>
constexpr Scalar pi_positional_step(const PiPositionalConfig<Scalar>& config,
                                    PiPositionalState<Scalar>& state, Scalar error,
                                    Scalar feed_forward = Scalar{}) {
  return pi_positional_step(config, state, error, feed_forward, -config.limit, config.limit);
}

}  // namespace sixstep::control

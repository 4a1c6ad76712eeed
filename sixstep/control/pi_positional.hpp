// SPDX-License-Identifier: Apache-2.0
// PI in positional form with back-calculation (Astrom and Hagglund, PID Controllers, 3.5):
//
//   v[n] = K e[n] + I[n] + feed_forward,   u[n] = v[n] within the limit
//   I[n+1] = I[n] + K_i e[n] + K_b (u[n] - v[n])
//
// v: output before the limit, I: integral, e: error, K, K_i, K_b: gains. At the limit v is replaced by its
// sum, because K e may exceed the format:
//
//   I[n+1] = I[n] + (K_i - K_b K) e[n] + K_b (u[n] - feed_forward - I[n])
//
// K e may therefore saturate (at 16 times the signal's range): u is then at its limit, and the integral does
// not depend on K e. The integral stays below limit + |feed_forward| + |K_i/K_b - K| |e|. design/scaling
// proves that this bound does not exceed the format.
//
// Unlike the velocity form, this form keeps the whole proportional part after saturation. K_b determines how
// fast the integral follows the limit. With 0 it does not follow and winds up; with 1 it follows within one
// sample. Without saturation both forms have the same transfer function, with d1 = K and d0 = K_i - K.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output is 0.
template <class Scalar>
struct PiPositionalConfig {
  Gain<Scalar> K{};    ///< output per input
  Gain<Scalar> K_i{};  ///< output per input and sample
  Gain<Scalar> K_b{};  ///< 0..1 per sample; K_i/K is usual
  Scalar limit{};      ///< largest |u|
  Gain<Scalar> K_c{};  ///< K_i - K_b K: gain from e to the integral at the limit; 0 is usual
  bool operator==(const PiPositionalConfig&) const = default;
};

/// K_c = K_i - K_b K; 0 if the difference is only a rounding error.
constexpr double gain_beyond_limit(double K, double K_i, double K_b) {
  const double K_c = K_i - K_b * K, least = 1e-9 * (K_i < 0 ? -K_i : K_i);
  return K_c < least && K_c > -least ? 0.0 : K_c;
}

template <class Scalar>
struct PiPositionalState {
  Accumulator<Scalar> integral{};
};

/// One tick with the output clamped to low..high instead of +-limit, for limits that change. The feed-forward
/// may exceed the range of a signal.
template <class Scalar>
constexpr Scalar pi_positional_step(const PiPositionalConfig<Scalar>& config,
                                    PiPositionalState<Scalar>& state, Scalar error,
                                    Accumulator<Scalar> feed_forward, Scalar low, Scalar high) {
  using T = ScalarTraits<Scalar>;
  const Accumulator<Scalar> v = T::accumulated(error, config.K) + (state.integral + feed_forward);
  const Accumulator<Scalar> u = between(v, T::accumulator(low), T::accumulator(high));
  if (u == v)
    state.integral = state.integral + T::accumulated(error, config.K_i);
  else
    state.integral = state.integral + T::accumulated(error, config.K_c) +
                     T::share(u - feed_forward - state.integral, config.K_b);
  return T::signal(u);
}

template <class Scalar>
constexpr Scalar pi_positional_step(const PiPositionalConfig<Scalar>& config,
                                    PiPositionalState<Scalar>& state, Scalar error,
                                    Scalar feed_forward = Scalar{}) {
  return pi_positional_step(config, state, error, ScalarTraits<Scalar>::accumulator(feed_forward),
                            -config.limit, config.limit);
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Computes the filtered derivative part of a PID, for use with a PI. It differentiates the measurement,
// because a step of the setpoint would cause a pulse of the output. K_d s/(T_f s + 1) as a backward
// difference:
//
//   y[n] = y[n-1] + g (x[n] - x[n-1]) - b y[n-1],   g = K_d/(T_f + T_s),  b = T_s/(T_f + T_s)
//
// x: measurement, y: derivative part, K_d: gain, T_f: time constant of the filter, T_s: control period.
//
// On a ramp of r per second y settles at K_d r. Subtract y from the output of the PI. y is a running sum and
// may exceed the PI's output: |y| is at most g times the largest step of x, and at most g/b times the largest
// change per sample. design/scaling proves that y does not overflow.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output is 0.
template <class Scalar>
struct DerivativeConfig {
  Gain<Scalar> g{};  ///< output per input: K_d/(T_f + T_s)
  Gain<Scalar> b{};  ///< T_s/(T_f + T_s), 1 without a filter
  bool operator==(const DerivativeConfig&) const = default;
};

template <class Scalar>
struct DerivativeState {
  Accumulator<Scalar> y{};
  Scalar x{};
  bool started = false;  ///< false before the first sample, which has no predecessor
};

template <class Scalar>
constexpr Accumulator<Scalar> derivative_step(const DerivativeConfig<Scalar>& config,
                                              DerivativeState<Scalar>& state, Scalar x) {
  using T = ScalarTraits<Scalar>;
  if (!state.started) state.x = x;
  state.started = true;
  const Wide<Scalar> change = T::wide(x) - T::wide(state.x);
  state.y = state.y + T::accumulated(change, config.g) - T::share(state.y, config.b);
  state.x = x;
  return state.y;
}

}  // namespace sixstep::control

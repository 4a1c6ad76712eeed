// SPDX-License-Identifier: Apache-2.0
// Slew limiter: the output changes by at most one step per tick and stops exactly on the setpoint.
//
//   y[n] = y[n-1] + clamp(x[n] - y[n-1], step)
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output never changes.
template <class Scalar>
struct SlewConfig {
  Accumulator<Scalar> step{};  ///< largest change per tick; in fixed point it may be less than the signal's
                               ///< last bit
  bool operator==(const SlewConfig&) const = default;
};

template <class Scalar>
struct SlewState {
  Accumulator<Scalar> y{};
};

template <class Scalar>
constexpr Scalar slew_step(const SlewConfig<Scalar>& config, SlewState<Scalar>& state, Scalar target) {
  const Accumulator<Scalar> x = ScalarTraits<Scalar>::accumulator(target);
  if (x - state.y > config.step)
    state.y = state.y + config.step;
  else if (x - state.y < -config.step)
    state.y = state.y - config.step;
  else
    state.y = x;  // not y + (x - y), which may exceed x by rounding
  return ScalarTraits<Scalar>::signal(state.y);
}

}  // namespace sixstep::control

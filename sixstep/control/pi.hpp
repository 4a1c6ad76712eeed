// SPDX-License-Identifier: Apache-2.0
// Discrete PI in the velocity form of the thesis (6.8): F_R(z) = (d1 z + d0)/(z - 1).
#pragma once

namespace sixstep::control {

template <class Scalar>
constexpr Scalar clamped(Scalar x, Scalar limit) {
  return x > limit ? limit : x < -limit ? -limit : x;
}

/// Defaults give no output at all: a forgotten gain is safe.
template <class Scalar>
struct PiConfig {
  Scalar d1{};     ///< output per input: the proportional gain K
  Scalar d0{};     ///< K_i = d1 + d0 per sample
  Scalar limit{};  ///< |u| never exceeds it
};

template <class Scalar>
struct PiState {
  Scalar u{};  ///< last output, clamped
  Scalar e{};  ///< last error
};

/// u[n] = u[n-1] + d1 e[n] + d0 e[n-1], clamped; the clamped u is the state, so the integral cannot wind up.
template <class Scalar>
constexpr Scalar pi_step(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error) {
  state.u = clamped(state.u + config.d1 * error + config.d0 * state.e, config.limit);
  state.e = error;
  return state.u;
}

}  // namespace sixstep::control

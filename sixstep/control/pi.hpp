// SPDX-License-Identifier: Apache-2.0
// Discrete PI controller in velocity form, with the transfer function (d1 z + d0)/(z - 1).
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output is 0, so that a forgotten gain causes no motion.
template <class Scalar>
struct PiConfig {
  Gain<Scalar> d1{};  ///< output per input: the proportional gain K
  Gain<Scalar> d0{};  ///< d0 = K_i - d1, K_i the integral gain per sample
  Scalar limit{};     ///< largest |u|
  bool operator==(const PiConfig&) const = default;
};

template <class Scalar>
struct PiState {
  Scalar u{};  ///< last output, clamped
  Scalar e{};  ///< last error
};

/// u[n] = u[n-1] + d1 e[n] + d0 e[n-1], clamped to low..high. The clamped u is the state, so that the
/// integral cannot wind up. If a feed-forward term is added to u, subtract it from `low` and `high`: the sum
/// then stays within the limit.
template <class Scalar>
constexpr Scalar pi_step(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error, Scalar low,
                         Scalar high) {
  state.u = between(state.u + config.d1 * error + config.d0 * state.e, low, high);
  state.e = error;
  return state.u;
}

/// One tick without the integral part and without the limit: u[n] = u[n-1] + d1 (e[n] - e[n-1]). It is for a
/// loop whose output is not applied.
template <class Scalar>
constexpr Scalar pi_wait(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error) {
  state.u = state.u + config.d1 * (error - state.e);
  state.e = error;
  return state.u;
}

/// In fixed point the configuration stores K_i instead of d0. d1 and d0 nearly cancel, and their rounded
/// difference would contain few digits of K_i. The law is the same: u[n] = u[n-1] + d1 (e[n] - e[n-1]) + K_i
/// e[n-1].
template <class Storage, int FractionBits>
struct PiConfig<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;
  Gain<Scalar> d1{};
  Gain<Scalar> K_i{};
  Scalar limit{};
};

/// The sum u has guard bits for increments below a signal's last bit. In Q15 the least increment is 2^-13 of
/// the last bit: an error of 1 bit is integrated if K_i >= 2^-13 (2^-29 in 32 bits). design/scaling checks
/// this.
template <class Storage, int FractionBits>
struct PiState<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;
  Accumulator<Scalar> u{};
  Scalar e{};
};

/// The fixed-point version. An increment saturates at 16 times the signal's range, which is far beyond any
/// limit.
template <class Storage, int FractionBits>
constexpr Fixed<Storage, FractionBits> pi_step(const PiConfig<Fixed<Storage, FractionBits>>& config,
                                               PiState<Fixed<Storage, FractionBits>>& state,
                                               Fixed<Storage, FractionBits> error,
                                               Fixed<Storage, FractionBits> low,
                                               Fixed<Storage, FractionBits> high) {
  using T = ScalarTraits<Fixed<Storage, FractionBits>>;
  const auto jump = static_cast<typename T::Wide>(T::wide(error) - T::wide(state.e));
  const auto increment = T::accumulated(jump, config.d1) + T::accumulated(state.e, config.K_i);
  state.u = between(state.u + increment, T::accumulator(low), T::accumulator(high));
  state.e = error;
  return T::signal(state.u);
}

template <class Storage, int FractionBits>
constexpr Fixed<Storage, FractionBits> pi_wait(const PiConfig<Fixed<Storage, FractionBits>>& config,
                                               PiState<Fixed<Storage, FractionBits>>& state,
                                               Fixed<Storage, FractionBits> error) {
  using T = ScalarTraits<Fixed<Storage, FractionBits>>;
  const auto jump = static_cast<typename T::Wide>(T::wide(error) - T::wide(state.e));
  state.u = state.u + T::accumulated(jump, config.d1);
  state.e = error;
  return T::signal(state.u);
}

template <class Scalar>
constexpr Scalar pi_step(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error) {
  return pi_step(config, state, error, -config.limit, config.limit);
}

}  // namespace sixstep::control

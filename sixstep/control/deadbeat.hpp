// SPDX-License-Identifier: Apache-2.0
// Deadbeat current control with compensation of the delay: it computes the voltage with which the current
// reaches its reference one period later. The driven pair is a winding of R and L with the back-EMF e. If the
// voltage u is constant during a time t (zero-order hold), its current changes from i to
//
//   i(t) = a(t) i + b(t) (u - e),   a(t) = exp(-R t/L),   b(t) = (1 - a(t))/R
//
// The voltage computed from a sample begins a time `wait` later. Until then the last voltage acts:
//
//   i_w    = a(wait) i + b(wait) (u[n-1] - e)        current when the new voltage begins
//   u[n]   = (i* - a(T) i_w)/b(T) + e                the current is i* one period T later
//
// e is K_t w plus a correction, with torque constant K_t and speed w. At each sample the correction changes
// by g/b(T) times (predicted - measured current). g is the gain of the correction. If the model lacks a
// constant voltage (drop, dead time, error of R), a fraction (1 - g)^n of this voltage remains after n
// samples.
//
// Without a limit the current follows i*[n] one period after the new voltage begins. If the inductance is m
// times the model's inductance, the loop has its poles at 1 - 1/m. Without a wait, the loop is stable for m
// above 1/2.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Response of the winding after a time t: i(t) = decay i + A_per_V (u - e). Default: both factors are 0. For
/// t = 0, decay is 1 and A_per_V is 0.
template <class Scalar>
struct HeldWinding {
  Gain<Scalar> decay{};
  Gain<Scalar> A_per_V{};
  bool operator==(const HeldWinding&) const = default;
};

/// Default: the output is 0.
template <class Scalar>
struct DeadbeatConfig {
  HeldWinding<Scalar> wait{};         ///< from a sample until the voltage computed from it begins
  HeldWinding<Scalar> rest{};         ///< from the begin of the computed voltage to the next sample
  Gain<Scalar> decay{};               ///< a(T), decay over a period
  Gain<Scalar> V_per_A{};             ///< 1/b(T), voltage per ampere of change in a period
  Gain<Scalar> correction_V_per_A{};  ///< g/b(T)
  Gain<Scalar> K_t_V_s{};             ///< V of the back-EMF between the driven terminals per mechanical rad/s
  Scalar limit{};                     ///< V: bound of |u| and |e|
  bool operator==(const DeadbeatConfig&) const = default;
};

template <class Scalar>
struct DeadbeatState {
  Scalar u{};          ///< last output, V, after the limit
  Scalar predicted{};  ///< predicted current at the next sample, A
  Scalar missed{};     ///< part of e in addition to K_t w, V
};

template <class Scalar>
constexpr Scalar held_current(const HeldWinding<Scalar>& over, Scalar current, Scalar voltage) {
  using T = ScalarTraits<Scalar>;
  return T::product(current, over.decay) + T::product(voltage, over.A_per_V);
}

/// One tick: returns the voltage between the driven terminals, V. The prediction uses the voltage after the
/// limit.
template <class Scalar>
constexpr Scalar deadbeat_step(const DeadbeatConfig<Scalar>& config, DeadbeatState<Scalar>& state,
                               Scalar reference, Scalar current, Scalar speed_rad_s) {
  using T = ScalarTraits<Scalar>;
  state.missed =
      clamped(state.missed + T::product(state.predicted - current, config.correction_V_per_A), config.limit);
  const Scalar turning = clamped(T::product(speed_rad_s, config.K_t_V_s), config.limit);
  const Scalar e = clamped(turning + state.missed, config.limit);
  const Scalar ahead = held_current(config.wait, current, state.u - e);
  const Scalar push = T::product(reference - T::product(ahead, config.decay), config.V_per_A);
  state.u = clamped(push + e, config.limit);
  state.predicted = held_current(config.rest, ahead, state.u - e);
  return state.u;
}

}  // namespace sixstep::control

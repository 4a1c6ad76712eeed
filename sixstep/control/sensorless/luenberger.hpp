// SPDX-License-Identifier: Apache-2.0
// A Luenberger observer that estimates the back-EMF of the free phase, from the phase's voltage without the
// star point (floating_voltage.hpp) and its current:
//
//   L di/dt = w - R i - e,   de/dt = 0                                              the model, (1) of model.md
//   i_p = a i^ + b (w - e^),   a = exp(-R T/L),   b = (1 - a)/R                      exact for w, e constant in a period
//   eps = i - i_p,   i^ = i_p + l eps,   e^ = e^ - h eps
//   (1 - l) a = p1 p2,   h b = (1 - p1)(1 - p2)                                      two poles p1, p2 in z
//
// i^, e^ are the estimates of current and back-EMF, a, b, l, h constants of LuenbergerConfig. w is the mean
// voltage of the period that ends with the sample of i. With both poles at p, the estimate of a back-EMF that
// grows as a ramp is 2 p/(1 - p) periods late. The mean w adds half a period, because it is valid for the
// middle of the period. This total delay is the same at every speed; observer.hpp subtracts it. In a phase
// without current w = e. R and L then only determine how an error of the estimate decays: by the factor p in
// each period.
//
// D. G. Luenberger, Observing the state of a linear system, IEEE Trans. Military Electronics 8 (1964) 74.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the estimate is 0.
template <class Scalar>
struct LuenbergerConfig {
  Gain<Scalar> decay{};    ///< a, decay of the current over a period
  Gain<Scalar> drive{};    ///< b, change of the current per volt over a period
  Gain<Scalar> current{};  ///< l, correction of i^ per ampere of error
  Gain<Scalar> emf{};      ///< h, correction of e^ per ampere of error, V per A
  bool operator==(const LuenbergerConfig&) const = default;
};

template <class Scalar>
struct LuenbergerState {
  Scalar i_A{};               ///< i^, estimate of the current
  Accumulator<Scalar> e_V{};  ///< e^, estimate of the back-EMF
};

/// Advances by a period with the mean voltage w_V, and the current i_A at the period's end. Returns the
/// estimate of e, V.
template <class Scalar>
constexpr Scalar luenberger_step(const LuenbergerConfig<Scalar>& config, LuenbergerState<Scalar>& state,
                                 Scalar w_V, Scalar i_A) {
  using T = ScalarTraits<Scalar>;
  const Scalar predicted =
      T::product(state.i_A, config.decay) + T::product(w_V - T::signal(state.e_V), config.drive);
  const Scalar error = i_A - predicted;
  state.i_A = predicted + T::product(error, config.current);
  state.e_V = state.e_V - T::accumulated(error, config.emf);
  return T::signal(state.e_V);
}

/// Begins a sector, in which the next leg floats. The signs are again chosen so that the back-EMF falls: the
/// new estimate is minus the last estimate.
template <class Scalar>
constexpr void luenberger_begin(LuenbergerState<Scalar>& state) {
  state.e_V = -state.e_V;
}

/// Sets the estimate when the leg's old current has just ended and the terminal shows the back-EMF.
template <class Scalar>
constexpr void luenberger_set(LuenbergerState<Scalar>& state, Scalar e_V, Scalar i_A) {
  state.i_A = i_A;
  state.e_V = ScalarTraits<Scalar>::accumulator(e_V);
}

/// Advances by a period of unknown voltage, without changing the estimate.
template <class Scalar>
constexpr Scalar luenberger_hold(LuenbergerState<Scalar>& state, Scalar i_A) {
  state.i_A = i_A;
  return ScalarTraits<Scalar>::signal(state.e_V);
}

}  // namespace sixstep::control

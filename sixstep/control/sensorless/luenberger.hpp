// SPDX-License-Identifier: Apache-2.0
// A Luenberger observer of the back-EMF of the phase whose leg floats, from its voltage, which has no star point in it
// (floating_voltage.hpp), and its current:
//
//   L di/dt = w - R i - e,   de/dt = 0                                              the model, (1) of model.md
//   i_p = a i^ + b (w - e^),   a = exp(-R T/L),   b = (1 - a)/R                      exact for w, e constant in a period
//   eps = i - i_p,   i^ = i_p + l eps,   e^ = e^ - h eps
//   (1 - l) a = p1 p2,   h b = (1 - p1)(1 - p2)                                      its two poles in z
//
// w is the mean over the period that ends with the sample of i. With both poles at p a back-EMF that grows like a ramp is
// seen 2 p/(1 - p) periods late, and half a period more, since a mean tells of a period's middle: a time, the same at
// every speed, which the follower takes off (observer.hpp). A phase without current has w = e: there R and L only shape how
// the old estimate dies, p times each period.
//
// D. G. Luenberger, Observing the state of a linear system, IEEE Trans. Military Electronics 8 (1964) 74.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The default estimates nothing.
template <class Scalar>
struct LuenbergerConfig {
  Gain<Scalar> decay{};    ///< a
  Gain<Scalar> drive{};    ///< b, A per V
  Gain<Scalar> current{};  ///< l
  Gain<Scalar> emf{};      ///< h, V per A
  bool operator==(const LuenbergerConfig&) const = default;
};

template <class Scalar>
struct LuenbergerState {
  Scalar i_A{};               ///< i^
  Accumulator<Scalar> e_V{};  ///< e^
};

/// One period: its mean voltage, and the current at its end. The estimate of e, V.
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

/// The next leg floats: in the sense in which it falls its back-EMF begins where that of the last one ended, negative.
template <class Scalar>
constexpr void luenberger_begin(LuenbergerState<Scalar>& state) {
  state.e_V = -state.e_V;
}

/// The leg has just come free, and shows its back-EMF.
template <class Scalar>
constexpr void luenberger_set(LuenbergerState<Scalar>& state, Scalar e_V, Scalar i_A) {
  state.i_A = i_A;
  state.e_V = ScalarTraits<Scalar>::accumulator(e_V);
}

/// A period whose voltage is not known: the estimate stands.
template <class Scalar>
constexpr Scalar luenberger_hold(LuenbergerState<Scalar>& state, Scalar i_A) {
  state.i_A = i_A;
  return ScalarTraits<Scalar>::signal(state.e_V);
}

}  // namespace sixstep::control

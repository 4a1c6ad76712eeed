// SPDX-License-Identifier: Apache-2.0
// A sliding-mode observer that estimates the back-EMF of the free phase, from the phase's voltage without the
// star point (floating_voltage.hpp) and its current:
//
//   L di^/dt = w - R i^ - z,   z = k sat((i^ - i)/phi)          sat: the sign, but linear in a layer of width phi
//   discretised exactly:   i^[n+1] = a i^[n] + b (w - z[n]),   a = exp(-R T/L),   b = (1 - a)/R
//   e^[n+1] = e^[n] + c (z[n+1]/a - e^[n])                      low-pass of z: the equivalent control
//
// If k is above every back-EMF, the error i^ - i moves into the layer. Inside the layer error[n+1] =
// (a - b k/phi) error[n] + b e. A chip updates z once per period. With the sign function the error would
// chatter with a width of 2 b k. phi = k b/a is the narrowest layer without chatter: the error is constant
// after one period, and z is a times e of the last period. The low-pass delays by (1 - c)/c periods, the mean
// w by half a period. observer.hpp subtracts this total delay, which compensates the phase lag at every
// speed.
//
// V. I. Utkin, Variable structure systems with sliding modes, IEEE Trans. Automatic Control 22 (1977) 212; the layer:
// J.-J. Slotine, S. S. Sastry, Int. J. Control 38 (1983) 465.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the estimate is 0.
template <class Scalar>
struct SlidingModeConfig {
  Gain<Scalar> decay{};  ///< a, decay of the current over a period
  Gain<Scalar> drive{};  ///< b, change of the current per volt over a period
  Gain<Scalar> slope{};  ///< k/phi = a/b, slope in the layer, V per A
  Scalar limit_V{};      ///< k, limit of |z|
  Gain<Scalar> raise{};  ///< 1/a
  Gain<Scalar> share{};  ///< c, factor of the low-pass
  bool operator==(const SlidingModeConfig&) const = default;
};

template <class Scalar>
struct SlidingModeState {
  Scalar i_A{};      ///< current at the last sample
  Scalar error_A{};  ///< i^ - i, error of the estimated current
  Scalar z_V{};
  Accumulator<Scalar> e_V{};  ///< e^, estimate of the back-EMF
};

/// Advances by a period with the mean voltage w_V, and the current i_A at the period's end. Returns the
/// estimate of e, V.
template <class Scalar>
constexpr Scalar sliding_mode_step(const SlidingModeConfig<Scalar>& config, SlidingModeState<Scalar>& state,
                                   Scalar w_V, Scalar i_A) {
  using T = ScalarTraits<Scalar>;
  const Scalar predicted =
      T::product(state.i_A + state.error_A, config.decay) + T::product(w_V - state.z_V, config.drive);
  state.error_A = predicted - i_A;
  state.i_A = i_A;
  state.z_V = clamped(T::product(state.error_A, config.slope), config.limit_V);
  const Scalar z = T::product(state.z_V, config.raise);
  state.e_V = state.e_V + T::accumulated(z - T::signal(state.e_V), config.share);
  return T::signal(state.e_V);
}

/// Begins a sector, in which the next leg floats. The signs are again chosen so that the back-EMF falls: the
/// new estimate is minus the last estimate.
template <class Scalar>
constexpr void sliding_mode_begin(SlidingModeState<Scalar>& state) {
  state.error_A = -state.error_A;
  state.z_V = -state.z_V;
  state.e_V = -state.e_V;
}

/// Sets the state when the leg's old current has just ended and the terminal shows the back-EMF e. The
/// equivalent control is then a e, at an error of b e.
template <class Scalar>
constexpr void sliding_mode_set(const SlidingModeConfig<Scalar>& config, SlidingModeState<Scalar>& state,
                                Scalar e_V, Scalar i_A) {
  using T = ScalarTraits<Scalar>;
  state.i_A = i_A;
  state.error_A = T::product(e_V, config.drive);
  state.z_V = T::product(e_V, config.decay);
  state.e_V = T::accumulator(e_V);
}

/// Advances by a period of unknown voltage, without changing error and estimate.
template <class Scalar>
constexpr Scalar sliding_mode_hold(SlidingModeState<Scalar>& state, Scalar i_A) {
  state.i_A = i_A;
  return ScalarTraits<Scalar>::signal(state.e_V);
}

}  // namespace sixstep::control

// SPDX-License-Identifier: Apache-2.0
// Deadbeat current control with compensation of the delay: the voltage after which the current is its reference, on the
// driven pair as a winding of R and L held over a time t (zero-order hold),
//
//   i(t) = a(t) i + b(t) (u - e),   a(t) = exp(-R t/L),   b(t) = (1 - a(t))/R
//
// What was sampled is answered `wait` later, with the last voltage until then, so that
//
//   i_w    = a(wait) i + b(wait) (u[n-1] - e)        where the answer begins
//   u[n]   = (i* - a(T) i_w)/b(T) + e                reaches i* a period later
//
// and e is K_t w, and what the predictions miss: at each sample e moves by g/b(T) times (predicted - measured). Of a constant
// voltage that the model lacks (drop, dead time, R) the part (1 - g)^n is left after n samples.
//
// Without a limit the current follows i*[n] one period after the answer begins; with an inductance that is m of the model's
// the loop has its poles at 1 - 1/m, and is stable from m = 1/2 on (no wait).
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The winding over a time: i' = decay i + A_per_V (u - e). The default is over no time but for its decay.
template <class Scalar>
struct HeldWinding {
  Gain<Scalar> decay{};
  Gain<Scalar> A_per_V{};
  bool operator==(const HeldWinding&) const = default;
};

/// Defaults give no output at all.
template <class Scalar>
struct DeadbeatConfig {
  HeldWinding<Scalar> wait{};         ///< from a sample to its answer
  HeldWinding<Scalar> rest{};         ///< from there to the next sample
  Gain<Scalar> decay{};               ///< a(T)
  Gain<Scalar> V_per_A{};             ///< 1/b(T)
  Gain<Scalar> correction_V_per_A{};  ///< g/b(T)
  Gain<Scalar> K_t_V_s{};             ///< V per mechanical rad/s
  Scalar limit{};                     ///< V: |u|, and what e may come to
  bool operator==(const DeadbeatConfig&) const = default;
};

template <class Scalar>
struct DeadbeatState {
  Scalar u{};          ///< last answer, V, clamped
  Scalar predicted{};  ///< of the next sample, A
  Scalar missed{};     ///< V that e has beside K_t w
};

template <class Scalar>
constexpr Scalar held_current(const HeldWinding<Scalar>& over, Scalar current, Scalar voltage) {
  using T = ScalarTraits<Scalar>;
  return T::product(current, over.decay) + T::product(voltage, over.A_per_V);
}

/// One tick: the voltage between the driven terminals. The prediction knows what the limit cut off.
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

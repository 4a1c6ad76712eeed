// SPDX-License-Identifier: Apache-2.0
// Field weakening: if the back-EMF exceeds the available voltage, a current along the magnet's axis reduces
// the field. The voltage reserve of the current loops controls this current (Kim and Sul, Speed Control of
// Interior Permanent Magnet Synchronous Motor Drive for the Flux Weakening Operation, IEEE Trans. IA 33,
// 1997):
//
//   i_d[n+1] = i_d[n] + K (m U_s/sqrt 3 - |v[n]|), clamped to [-I, 0]
//
// K is the gain, v the voltage of the current loops, U_s the bus voltage, I the largest weakening current.
// The law needs neither the flux linkage psi nor the inductance. While |v| is above the fraction m of the
// voltage circle, i_d falls. While |v| is below, i_d returns to 0. The state is the clamped i_d, so that it
// does not wind up. |v| is about v_q, and v_q changes by w_e L_d per ampere of i_d. The law therefore has its
// pole at 1 - K w_e L_d. K is designed at one speed. The law is stable at electrical speeds below 2/(K L_d)
// if the inner loops are much faster (design/loops/field_current.hpp).
//
// I is at most psi/L_d, because a larger current would reverse the field and need more voltage again. The
// voltage also limits i_q. For a round rotor with i_d = -psi/L_d the limit is exactly
//
//   |i_q| <= m U_s/sqrt 3/(w_e L_q)
//
// With a larger reference, v_d would need the whole voltage circle, and neither current would be controlled.
#pragma once
#include "sixstep/control/field/field_current.hpp"

namespace sixstep::control {

/// Default: the field is not weakened.
template <class Scalar>
struct FieldWeakeningConfig {
  Gain<Scalar> K_A_per_V{};  ///< K, A per V and sample
  Gain<Scalar> part{};       ///< m, fraction of the voltage circle
  Scalar most_A{};           ///< I, largest current against the magnet's field
  bool operator==(const FieldWeakeningConfig&) const = default;
};

template <class Scalar>
struct FieldWeakeningState {
  Accumulator<Scalar> i_d{};
};

/// Reference of i_d, A, from the voltage of the last tick.
template <class Scalar>
constexpr Scalar field_weakening_step(const FieldWeakeningConfig<Scalar>& config,
                                      FieldWeakeningState<Scalar>& state, const Dq<Scalar>& voltage,
                                      Scalar bus_V) {
  using T = ScalarTraits<Scalar>;
  if (!(config.most_A > Scalar{})) return Scalar{};
  const Scalar room = T::product(voltage_circle(bus_V), config.part) - vector_length(voltage.d, voltage.q);
  state.i_d = between(state.i_d + T::accumulated(room, config.K_A_per_V), T::accumulator(-config.most_A),
                      Accumulator<Scalar>{});
  return T::signal(state.i_d);
}

/// Largest i_q, A, that the voltage allows at this speed, but at most `most` >= 0. Returns `most` if the
/// field is not weakened.
template <class Scalar>
constexpr Scalar voltage_bound(const FieldWeakeningConfig<Scalar>& config,
                               const FieldCurrentConfig<Scalar>& current, Scalar speed_rad_s, Scalar bus_V,
                               Scalar most) {
  using T = ScalarTraits<Scalar>;
  const Scalar asked_V = T::product(magnitude(speed_rad_s) * most, current.q_V_s_A);
  const Scalar V = T::product(voltage_circle(bus_V), config.part);
  return config.most_A > Scalar{} && asked_V > V ? most * (V / asked_V) : most;
}

}  // namespace sixstep::control

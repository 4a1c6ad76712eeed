// SPDX-License-Identifier: Apache-2.0
// A current along the magnet that holds its field down where the bus is short of the back-EMF, by what the voltage has
// left (Kim and Sul, Speed Control of Interior Permanent Magnet Synchronous Motor Drive for the Flux Weakening
// Operation, IEEE Trans. IA 33, 1997):
//
//   i_d[n+1] = i_d[n] + K (m U_s/sqrt 3 - |v[n]|), within [-I, 0]
//
// It knows neither psi nor L: where the vector asks for more than the part m of the circle, i_d falls until it does not, and
// comes back to 0 where there is room. The bound is the state, so nothing winds up. With |v| about v_q, and
// v_q changing by w_e L_d per ampere, its own pole is 1 - K w_e L_d: K is designed at one speed and is safe below
// twice 1/(K L_d), loops within much faster provided (design/loops/field_current.hpp).
//
// More than I = psi/L_d turns the field round, and more current would ask for more voltage: I is at most that. What the
// voltage then leaves to i_q, of a round rotor exactly where i_d = -psi/L_d, is
//
//   |i_q| <= m U_s/sqrt 3/(w_e L_q)
//
// A reference beyond it would take the whole circle along d, and no current would be held any more.
#pragma once
#include "sixstep/control/field/field_current.hpp"

namespace sixstep::control {

/// The default weakens nothing.
template <class Scalar>
struct FieldWeakeningConfig {
  Gain<Scalar> K_A_per_V{};  ///< per sample
  Gain<Scalar> part{};       ///< m, of the circle
  Scalar most_A{};           ///< I
  bool operator==(const FieldWeakeningConfig&) const = default;
};

template <class Scalar>
struct FieldWeakeningState {
  Accumulator<Scalar> i_d{};
};

/// i_d to ask for, of the voltage that the last tick asked for.
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

/// Of a current of `most` >= 0 across the magnet what the voltage lets through at this speed; all where nothing is weakened.
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

// SPDX-License-Identifier: Apache-2.0
// Replaces a current reference if the available voltage V is too small for it at the present speed. In the
// rotor's frame a constant current i needs the voltage v (symbols of model.md 11)
//
//   v = Z i + E,   Z = [R, -w_e L_q; w_e L_d, R],   E = (0, w_e psi)                  |v| <= V
//
// The possible currents fill a disc (an ellipse if the rotor is salient) around -Z^-1 E, the current with
// shorted terminals. Above the speed at which |E| is V, the disc does not contain i = 0: a current of at
// least (|E| - V)/|Z| flows at every reference. A reference outside of the disc is changed in two steps:
//
//   1  if the torque drives, |i_q| is reduced at the same i_d, as far as the voltage requires
//   2  if step 1 is not sufficient, or the torque brakes, i' = i - (1 - V/|v|) Z^-1 v: i moves along the
//      line to the disc's centre, until it is on the rim
//
// For a round rotor step 2 results in the nearest current of the disc. A projection onto a disc does not
// increase the distance between two points. |i'| is therefore at most |i| plus the least possible current.
//
// A voltage beyond the circle is moved back along the line to Z i' + E, the voltage of a constant current i'.
// x is the deviation of the measured current from i', and k the gain of the loops. The loops add the voltage
// w_e L j x - k x, of which the fraction s remains. The first term rotates x and does not change |x|. The
// second term reduces |x|. |x|^2 therefore falls at the rate 2 s k |x|^2/L plus the loss in R, for every s >
// 0. If the voltage is moved back in another direction (v_d first, or along v), |x|^2 may grow.
//
// In fixed point w p L and R must be below one volt per ampere of the bases.
#pragma once
#include "sixstep/control/field/field_current.hpp"

namespace sixstep::control {

/// Returns the reference, or the current, A, that replaces it if the voltage is too small for the reference.
template <class Scalar>
constexpr Dq<Scalar> reachable_current(const FieldCurrentConfig<Scalar>& config, const Dq<Scalar>& wanted,
                                       Scalar speed_rad_s, Scalar bus_V) {
  using T = ScalarTraits<Scalar>;
  const Scalar most = voltage_reach(config, bus_V);
  Dq<Scalar> v = holding_voltage(config, wanted, speed_rad_s), i = wanted;
  if (detail::is_within(v, most)) return wanted;
  if ((wanted.q < Scalar{}) == (speed_rad_s < Scalar{})) {
    i.q = Scalar{};
    const Dq<Scalar> without = holding_voltage(config, i, speed_rad_s);
    if (detail::is_within(without, most)) return {i.d, wanted.q * detail::way_to_rim(without, v, most)};
    v = without;
  }
  const Scalar R = T::product(one<Scalar>, config.R_ohm);
  const Scalar X_d = T::product(speed_rad_s, config.d_V_s_A), X_q = T::product(speed_rad_s, config.q_V_s_A);
  const Scalar square = R * R + X_d * X_q;
  if (!(square > Scalar{})) return wanted;
  const Scalar beyond = one<Scalar> - most / vector_length(v.d, v.q);
  return {i.d - beyond * (R * v.d + X_q * v.q) / square, i.q - beyond * (R * v.q - X_d * v.d) / square};
}

}  // namespace sixstep::control

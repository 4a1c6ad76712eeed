// SPDX-License-Identifier: Apache-2.0
// Computes the current i_d along the magnet at which a salient rotor produces the most torque per ampere. At
// a given torque
//
//   T = 3/2 p (psi i_q + (L_d - L_q) i_d i_q)
//
// |i| is least where i_d^2 - i_q^2 = psi i_d/(L_q - L_d) (Jahns, Kliman and Neumann, Interior
// Permanent-Magnet Synchronous Motors for Adjustable-Speed Drives, IEEE Trans. IA 22, 1986). The solution is
//
//   i_d = a - sqrt(a^2 + i_q^2), a = psi/(2 (L_q - L_d))
//   i_d = -i_q k/(1/4 + sqrt(1/16 + k^2)), k = i_q/(4 a)
//
// psi: flux linkage, L_d, L_q: inductances of a phase. This file uses the second form, because it does not
// subtract nearly equal numbers. It also does not need a, which is infinite for a round rotor; k and i_d are
// then 0. In fixed point |k| must be below 1. For |k| <= 0.7, which is i_q up to 2.8 a, no result exceeds the
// range of the format.
#pragma once
#include "sixstep/control/root.hpp"

namespace sixstep::control {

/// Default: i_d = 0, for a round rotor.
template <class Scalar>
struct TorquePerAmpereConfig {
  Gain<Scalar> k_per_A{};  ///< k/i_q = (L_q - L_d)/(2 psi)
  bool operator==(const TorquePerAmpereConfig&) const = default;
};

template <class Scalar>
constexpr Scalar least_current_d(const TorquePerAmpereConfig<Scalar>& config, Scalar i_q) {
  constexpr auto quarter = static_cast<Scalar>(0.25);
  const Scalar k = ScalarTraits<Scalar>::product(i_q, config.k_per_A);
  if (k == Scalar{}) return Scalar{};
  return -(i_q * (k / (quarter + vector_length(quarter, k))));
}

}  // namespace sixstep::control

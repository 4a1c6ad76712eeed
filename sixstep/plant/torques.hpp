// SPDX-License-Identifier: Apache-2.0
// Definition of the torques on the rotor (model.md (4)), for recurrences, guards, energy balance and figures
// of merit.
#pragma once
#include "sixstep/plant/expansion.hpp"

namespace sixstep::plant {

/// J dw/dt = T_e - load - dry - per_speed w. Code that uses the torques binds all members, as in
///   const auto [load, dry, per_speed] = torques(c, motion);
/// This code does not compile if a member is added, so that no code can ignore an additional torque.
template <class Real>
struct Torques {
  Real load;       ///< T_load, N m
  Real dry;        ///< T_c with its sign, N m
  Real per_speed;  ///< B, N m s
};

template <class Real>
Torques<Real> torques(const Constants<Real>& c, Motion motion) {
  return {c.load, against(motion, c.coulomb), c.B};
}

/// True if the sum of the torques is linear in the speed, as FlatPair requires (recurrences.hpp). All present
/// torques are linear. If a nonlinear torque is added, this function must return false.
template <class Real>
constexpr bool is_line_over_speed(const Torques<Real>& all) {
  [[maybe_unused]] const auto& [load, dry, per_speed] = all;
  return true;
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
// Torques that act on the rotor, each defined once (model.md (4)). The recurrences, the guards, the energy balance
// and the figures of merit use them.
#pragma once
#include "sixstep/plant/expansion.hpp"

namespace sixstep::plant {

/// J dw/dt = T_e - load - dry - per_speed w. Code that uses the torques binds all of them, as in
///   const auto [load, dry, per_speed] = torques(c, motion);
/// so that an additional torque is a compile error wherever it has to be considered.
template <class Real>
struct Torques {
  Real load;       ///< T_load
  Real dry;        ///< T_c with its sign
  Real per_speed;  ///< B
};

template <class Real>
Torques<Real> torques(const Constants<Real>& c, Motion motion) {
  return {c.load, against(motion, c.coulomb), c.B};
}

/// True if their sum is linear in the speed, as FlatPair requires (recurrences.hpp). Each of these torques is; a new
/// one that is not must return false here.
template <class Real>
constexpr bool is_line_over_speed(const Torques<Real>& all) {
  [[maybe_unused]] const auto& [load, dry, per_speed] = all;
  return true;
}

}  // namespace sixstep::plant

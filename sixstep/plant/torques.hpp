// SPDX-License-Identifier: Apache-2.0
// The torques that act on the rotor stand here, each once (model.md (4)). The recurrences, the guards, the
// energy balance and the figures of merit take them from here.
#pragma once
#include "sixstep/plant/expansion.hpp"

namespace sixstep::plant {

/// J dw/dt = T_e - load - dry - per_speed w. Whoever uses the torques binds all of them, as in
///   const auto [load, dry, per_speed] = torques(c, motion);
/// so that a new one stops the compiler wherever it has to be taken into account.
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

/// Whether their sum is a line over the speed, as FlatPair takes it to be (recurrences.hpp). Each of these
/// is; a torque that is not says so here.
template <class Real>
constexpr bool is_line_over_speed(const Torques<Real>& all) {
  [[maybe_unused]] const auto& [load, dry, per_speed] = all;
  return true;
}

}  // namespace sixstep::plant

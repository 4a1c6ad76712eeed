// SPDX-License-Identifier: Apache-2.0
// What a located event does to the state, and what rounding is taken for nothing before a mode is sought. Part
// of plant.hpp.
#pragma once
#include <utility>

#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

/// Currents within rounding of zero in legs without gate, and speeds within rounding of rest where friction
/// may hold the rotor, are zero: what is consistent there is decided by settle(), not by a rounding error.
template <class Real>
void Plant<Real>::snap() {
  // mutant: constants_.amp_noise => 1000 * constants_.amp_noise
  const Real amp_noise = constants_.amp_noise;
  // Balancing may bring another one below the noise: of 1.1, 1.2 and -2.3 where 1.2 is noise, all are zero.
  for (bool snapped = true; snapped;) {
    snapped = false;
    for (unsigned k = 0; k < 3; ++k) {
      Real& i = state_.i[k];
      if (gates_.high[k] || gates_.low[k] || i == 0 || detail::abs(i) > amp_noise) continue;
      i = state_.i_low[k] = 0;
      snapped = true;
    }
    if (snapped) balance();
  }
  if (constants_.dry_friction && detail::abs(state_.w) <= constants_.speed_noise) state_.w = state_.w_low = 0;
}

/// After a current was set to zero: one left alone is zero too, two left are one current.
template <class Real>
void Plant<Real>::balance() {
  PerLeg<Real>& i = state_.i;
  const int zeros = int{i[0] == 0} + int{i[1] == 0} + int{i[2] == 0};
  if (zeros == 2) {
    i = {};
    state_.i_low = {};
  } else if (zeros == 1) {
    const int zero = i[0] == 0 ? 0 : i[1] == 0 ? 1 : 2;
    const int j = (zero + 1) % 3, k = (zero + 2) % 3;
    i[k] = -i[j];
    // mutant: -state_.i_low[j] => Real(0)
    state_.i_low[k] = -state_.i_low[j];
  }
}

template <class Real>
bool Plant<Real>::pass_edge(bool ahead) {
  const auto pieces = [this] { return constants_.emf[sector()].count; };
  const bool leaves = ahead ? mode_.piece + 1 == pieces() : mode_.piece == 0;
  if (leaves) {
    state_.sector += ahead ? 1 : -1;
    mode_.sector = static_cast<std::uint8_t>(sector_in_turn(state_.sector));
    mode_.piece = static_cast<std::uint8_t>(ahead ? 0 : pieces() - 1);
  } else {
    mode_.piece = static_cast<std::uint8_t>(mode_.piece + (ahead ? 1 : -1));
  }
  const EmfPiece<Real>& piece = constants_.emf[sector()].piece[mode_.piece];
  // mutant: piece.from => Real(0)
  state_.x = ahead ? piece.from : piece.to;
  // mutant: state_.x_low = 0; => nothing
  state_.x_low = 0;
  return leaves;
}

/// A rotor at rest on an edge, which a bridge that follows the sectors drives back from either side, would pass
/// it for ever at one instant. It is put down inside, by what rounding may have moved it: then time goes on.
template <class Real>
void Plant<Real>::leave_edge(bool ahead) {
  const Real inside =
      4 * noise_of(Real(base::sector_rad), Real(1));  // beyond what edge_guards() take for the edge
  state_.x += ahead ? inside : -inside;
}

template <class Real>
bool Plant<Real>::apply(int id) {
  const int before = std::exchange(last_event_, id);
  if (id == guard::edge_ahead || id == guard::edge_behind) {
    const bool ahead = id == guard::edge_ahead, leaves = pass_edge(ahead);
    // mutant: doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead) => false
    if (doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead)) leave_edge(ahead);
    return leaves;
  }
  if (id < guard::standstill) {
    // Two legs share one current and reach zero together; of three, the other two then carry one current.
    state_.i[id] = state_.i_low[id] = 0;
    if (connected_count(mode_.legs) == 2) state_.i = state_.i_low = {};
    balance();
  }
  if (id == guard::standstill) state_.w = state_.w_low = 0;
  stale_ = true;
  return false;
}

}  // namespace sixstep::plant

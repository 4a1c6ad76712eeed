// SPDX-License-Identifier: Apache-2.0
// Member functions of plant.hpp that apply a located event to the state, and that set values at noise level
// to zero before the mode is settled.
#pragma once
#include <utility>

#include "sixstep/plant/plant.hpp"

namespace sixstep::plant {

/// Sets currents at noise level to zero, in legs whose gates are off. Also sets a speed at noise level to
/// zero if dry friction may stop the rotor. settle() then determines the mode, not a rounding error.
template <class Real>
void Plant<Real>::snap() {
  // mutant: constants_.amp_noise => 1000 * constants_.amp_noise
  const Real amp_noise = constants_.amp_noise;
  // balance() changes the other currents and may reduce one of them below the noise. Example with the noise
  // 1.2: the currents 1.1, 1.2 and -2.3 all become zero.
  for (bool snapped = true; snapped;) {
    snapped = false;
    for (unsigned k = 0; k < 3; ++k) {
      Real& i = state_.i[k];
      if (gates_.high[k] || gates_.low[k] || i == 0 || detail::abs(i) > amp_noise) continue;
      i = state_.i_low[k] = 0;
      snapped = true;
    }
    if (snapped) detail::balance(state_);
  }
  if (constants_.dry_friction && detail::abs(state_.w) <= constants_.speed_noise) state_.w = state_.w_low = 0;
}

template <class Real>
bool Plant<Real>::pass_edge(bool ahead) {
  return detail::pass_edge(
      state_, mode_, ahead, [this](int sector) { return constants_.emf[sector].piece.data(); },
      [this](int sector) { return constants_.emf[sector].count; });
}

template <class Real>
bool Plant<Real>::apply(int id) {
  const int before = std::exchange(last_event_, id);
  if (id == guard::edge_ahead || id == guard::edge_behind) {
    const bool ahead = id == guard::edge_ahead, leaves = pass_edge(ahead);
    // mutant: doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead) => false
    if (doubted_ && before == (ahead ? guard::edge_behind : guard::edge_ahead))
      detail::clear_edge(state_, ahead);
    return leaves;
  }
  if (id < guard::standstill) {
    // With two connected legs, both currents reach zero together. If one of three currents reaches zero, the
    // other two currents are opposite.
    state_.i[id] = state_.i_low[id] = 0;
    if (connected_count(mode_.legs) == 2) state_.i = state_.i_low = {};
    detail::balance(state_);
  }
  if (id == guard::standstill) state_.w = state_.w_low = 0;
  stale_ = true;
  return false;
}

}  // namespace sixstep::plant

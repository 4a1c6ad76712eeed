// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's path from codes of which some are glitches.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_runs.hpp"

namespace sixstep::analysis {

/// Place and direction of the rotor during a stay.
struct Whereabouts {
  std::uint8_t sector = 0;  ///< 0..5, with each line at its own pin
  bool forward = true;      ///< direction in which the rotor came there
  bool glitch = false;      ///< the stay's code is not that of the sector
};

struct RotorPath {
  std::vector<Whereabouts> at_stays;  ///< one per stay
  /// Median time in a sector, s; of an even count the longer one; 0: none.
  double sector_s = 0.0;
};

/// The likeliest path (A. J. Viterbi's algorithm): a rotor continues more often than it turns back, and
/// passes sectors one by one. A code that is not that of the rotor's sector is a spike, a bounce or a loose
/// contact. It is less likely the longer it lasts in relation to the time in a sector. `mask`: that of
/// HallEdges.
RotorPath likeliest_way(const std::vector<Stay>& stays, std::uint8_t mask);

}  // namespace sixstep::analysis

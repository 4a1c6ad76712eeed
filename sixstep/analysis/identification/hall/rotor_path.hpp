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
  bool forward = true;      ///< direction in which it came there
  bool glitch = false;      ///< the stay's code is not that of the sector
};

struct RotorPath {
  std::vector<Whereabouts> at_stays;  ///< one per stay
  /// Median time in a sector, of an even count the longer; 0: none.
  double sector_s = 0.0;
};

/// The likeliest path (A. J. Viterbi's algorithm): a rotor continues more often than it turns back, and
/// passes sectors one by one. A code that is not its sector's is a spike, a bounce or a loose contact, and
/// less likely the longer it lasts against a sector's time. `mask`: HallEdges.
RotorPath likeliest_way(const std::vector<Stay>& stays, std::uint8_t mask);

}  // namespace sixstep::analysis

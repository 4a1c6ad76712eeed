// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's path from codes that include glitches.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_runs.hpp"

namespace sixstep::analysis {

/// Sector and direction of the rotor during a stay.
struct Whereabouts {
  std::uint8_t sector = 0;  ///< 0..5, with each line at its own pin
  bool forward = true;      ///< true: the rotor entered the sector forward
  bool glitch = false;      ///< true: the stay's code is not the code of the sector
};

struct RotorPath {
  std::vector<Whereabouts> at_stays;  ///< one per stay
  /// Median time in a sector, s; for an even count the longer of the two middle times; 0: no sector was
  /// passed.
  double sector_s = 0.0;
};

/// The likeliest path (A. J. Viterbi's algorithm). A rotor continues more often than it reverses, and passes
/// sectors one by one. A code that differs from the sector's code is a spike, a bounce or a loose contact.
/// The longer it lasts relative to the time in a sector, the less likely it is. `mask`: HallEdges::mask.
RotorPath likeliest_way(const std::vector<Stay>& stays, std::uint8_t mask);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// The way a rotor went, as the codes tell it where some of them are glitches.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_runs.hpp"

namespace sixstep::analysis {

/// Where the rotor was during a stay.
struct Whereabouts {
  std::uint8_t sector = 0;  ///< 0..5, with each line at its own pin
  bool forward = true;      ///< the way it came there
  bool glitch = false;      ///< the stay shows another code
};

struct RotorPath {
  std::vector<Whereabouts> at_stays;  ///< one per stay
  double sector_s =
      0.0;  ///< time in a sector, the middle one by length, of an even count the longer; 0 where there is none
};

/// The likeliest way (A. J. Viterbi's algorithm): a rotor goes on more often than it turns back, and passes
/// sectors one by one; a code that is none of its sector's is a spike, a bounce or a contact that is off, the
/// less likely the longer it stands beside a sector's time. `mask`: HallEdges.
RotorPath likeliest_way(const std::vector<Stay>& stays, std::uint8_t mask);

}  // namespace sixstep::analysis

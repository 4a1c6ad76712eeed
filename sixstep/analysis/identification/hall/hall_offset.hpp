// SPDX-License-Identifier: Apache-2.0
// From the way that the Hall lines tell to the rotor's own angle: by the voltages of the same log.
#pragma once
#include "sixstep/analysis/identification/hall/hall_voltages.hpp"

namespace sixstep::analysis {

struct HallOffsetEstimate {
  bool mirrored = false;  ///< the lines' order runs against the rotor's
  double mirrored_probability = 0.0;
  int rotation = 0;    ///< the sector where the lines show sector 0; mirrored: the one above it
  FoundMotion motion;  ///< in electrical angles
  VoltageModel voltages;
  bool between_turns = false;  ///< enough is passed between the rotor's turns back to tell the hysteresis
  std::size_t at_turns = 0;    ///< edges left out for it

  /// Of the rotor, where the lines show that one with each at its own pin.
  int sector_of(int shown) const {
    return ((mirrored ? rotation - 1 - shown : rotation + shown) % 6 + 6) % 6;
  }
};

/// `by_edges` is what motion_of_edges() found.
base::Result<HallOffsetEstimate> place_by_voltages(const HallLog& log, const HallEdges& edges,
                                                   const FoundMotion& by_edges);

}  // namespace sixstep::analysis

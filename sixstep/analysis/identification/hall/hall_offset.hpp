// SPDX-License-Identifier: Apache-2.0
// Finds the rotor's electrical angle along the path from the Hall lines, by the voltages of the same log.
#pragma once
#include "sixstep/analysis/identification/hall/hall_voltages.hpp"

namespace sixstep::analysis {

struct HallOffsetEstimate {
  bool mirrored = false;  ///< true: the lines' order is opposite to the rotor's direction
  double mirrored_probability = 0.0;
  int rotation = 0;    ///< the rotor's sector while the lines show sector 0; if mirrored, this sector plus 1
  FoundMotion motion;  ///< in electrical angles
  VoltageModel voltages;
  bool between_turns = false;  ///< true: enough edges lie between the rotor's reversals to find the
                               ///< hysteresis
  std::size_t at_turns = 0;    ///< number of edges that are excluded because the rotor reversed next to them

  /// The rotor's sector while the lines show the sector `shown`, counted as if each line were at its own pin.
  int sector_of(int shown) const {
    return ((mirrored ? rotation - 1 - shown : rotation + shown) % 6 + 6) % 6;
  }
};

/// `by_edges` is the result of motion_of_edges().
base::Result<HallOffsetEstimate> place_by_voltages(const HallLog& log, const HallEdges& edges,
                                                   const FoundMotion& by_edges);

}  // namespace sixstep::analysis

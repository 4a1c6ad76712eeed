// SPDX-License-Identifier: Apache-2.0
// What the codes alone tell: which two never occur, and each edge with its time, its way and its place.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// Sectors are counted as if each line were at its own pin: forward is 100 110 010 and so on, of `inverted`
/// lines their complement. Where the rotor really is, only voltages tell.
struct HallEdge {
  double t_s = 0.0;           ///< middle of the time in which it may have been
  double width_s = 0.0;       ///< of that time
  std::int64_t boundary = 0;  ///< between sector boundary - 1 and sector boundary; sector 6 is 0 a turn on
  int direction = 1;          ///< +1, -1
  bool begins = false;        ///< what came between this and the last one is not known
  /// The rotor turned beyond it and came back over it: the edge before or behind is the same, passed the other way.
  bool at_turn = false;
};

struct HallEdges {
  /// XOR of it makes of the codes those of probes 120 degrees apart, up to their order: 0 where 000 and 111
  /// never occur; 2 where 010 and 101 do not, as with probes 60 degrees apart, H2 in the middle.
  std::uint8_t mask = 0;
  double mask_probability = 0.0;
  std::vector<HallEdge> edges;
  std::size_t glitches = 0;           ///< stays of another code than the rotor's
  std::size_t skipped = 0;            ///< sectors that were passed unseen
  std::array<std::size_t, 6> seen{};  ///< edges by boundary modulo 6
  std::size_t forward = 0, backward = 0;
  std::size_t unused = 0;  ///< edges behind the first most_edges
  double sector_s = 0.0;   ///< time between two edges: the middle one by length, of an even count the longer
  double sector_samples = 0.0;  ///< and its rows; 0 where each row is a change
};

/// Where an edge lies among `own` that repeat.
inline std::size_t repeating(std::int64_t boundary, std::size_t own) {
  const auto size = static_cast<std::int64_t>(own);
  return static_cast<std::size_t>((boundary % size + size) % size);
}

/// What a log tells from then on is less than what it costs.
inline constexpr std::size_t most_edges = 20'000;

/// Or why the log tells nothing: it stands, a line is dead, it is too short or sampled too slowly. `where`
/// names the column.
base::Result<HallEdges> hall_edges(const HallLog& log);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Evaluates only the codes of a log. It finds which two codes never occur, and each edge with its time,
// direction and sector border.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// An edge of the Hall code. Sectors are counted as if each line were at its own pin: forward is 100 110 010
/// and so on; with `inverted` lines it is the complement. Only voltages show the true angle.
struct HallEdge {
  double t_s = 0.0;      ///< middle of the interval in which the edge occurred
  double width_s = 0.0;  ///< width of that interval
  std::int64_t boundary =
      0;  ///< index of the border between sectors boundary - 1 and boundary; 6 is border 0 a turn later
  int direction = 1;    ///< +1 forward, -1 backward
  bool begins = false;  ///< true: the path between the edge before and this edge is unknown
  /// The rotor reversed just before or just after this edge: the edge before or after it is at the same
  /// boundary, in the other direction.
  bool at_turn = false;
};

struct HallEdges {
  /// A code XOR the mask is the code of probes 120 degrees apart, except for the order of the lines. The mask
  /// is 0 if 000 and 111 never occur. It is 2 if 010 and 101 never occur, as with probes 60 degrees apart and
  /// H2 in the middle.
  std::uint8_t mask = 0;
  double mask_probability = 0.0;
  std::vector<HallEdge> edges;
  std::size_t glitches = 0;           ///< passages with a code that the rotor cannot produce
  std::size_t skipped = 0;            ///< sectors passed without a row of their code
  std::array<std::size_t, 6> seen{};  ///< number of edges at each boundary modulo 6
  std::size_t forward = 0, backward = 0;
  std::size_t unused = 0;       ///< edges after the first most_edges, which are ignored
  double sector_s = 0.0;        ///< median time between two edges, s; of an even count the longer of the two
                                ///< middle times
  double sector_samples = 0.0;  ///< rows in this time; 0: each row is a change
};

/// Index of a boundary's edge in a pattern of `own` edges that repeats.
inline std::size_t repeating(std::int64_t boundary, std::size_t own) {
  const auto size = static_cast<std::int64_t>(own);
  return static_cast<std::size_t>((boundary % size + size) % size);
}

/// Largest number of edges that are evaluated. More edges hardly improve the result.
inline constexpr std::size_t most_edges = 20'000;

/// The edges, or a Problem with the reason why there are none: the rotor is at rest, a line is dead, the log
/// is too short or sampled too slowly. `where` of the Problem names the column.
base::Result<HallEdges> hall_edges(const HallLog& log);

}  // namespace sixstep::analysis

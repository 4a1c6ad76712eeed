// SPDX-License-Identifier: Apache-2.0
// Identifies a motor and its wires from a log of Hall lines and, where there are any, voltages: which line is
// which, inverted or not, 60 or 120 degrees apart, the places of the edges and their jitter. Every result has its
// uncertainty.
//
// Without voltages a log does not show where the rotor is. Then the first line, two swapped lines against
// backward rotation, and the common offset of all edges stay unknown. The results are then places of the
// edges against each other, as if each line were at its own pin.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/analysis/identification/hall/hall_wires.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"
#include "sixstep/analysis/identification/interval.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/control/bridge_command.hpp"

namespace sixstep::analysis {

/// Place of one of the repeating edges, against the mean of all of them: own[n] of model.md 10.
struct IdentifiedEdge {
  std::uint8_t before = 0, after = 0;  ///< codes at the pins, turning forward
  Interval own_deg;                    ///< electrical
  std::size_t seen = 0;                ///< passages that count: without those left out and not used
};

/// Results that need voltages.
struct IdentifiedPlace {
  PinCodes codes{};                ///< at the pins, in sectors 0 to 5
  double probability = 0.0;        ///< probability that all six are right
  double order_probability = 0.0;  ///< probability that the lines do not run the other way round
  std::vector<HallWires> wires;    ///< all that make these codes, the plainest first
  bool forward = true;             ///< direction of most of the log
  /// Common offset of all edges, in the direction of positive angles. A log that turns one way only cannot
  /// separate it from half the hysteresis and from the delay's path at the log's speed: the value is then the sum
  /// of them for that direction.
  Interval offset_deg;
  double usual_speed_deg_s = 0.0;  ///< electrical: mean size of the speed at the edges
  bool both_ways = false;          ///< the log does, so that the offset is separated from the hysteresis
  /// Edges that do not count for the hysteresis, because the rotor reversed beyond them.
  std::size_t at_turns = 0;
  /// Given where the log turns both ways, and far enough between its reversals.
  std::optional<Interval> hysteresis_deg;
  std::optional<Interval> delay_s;  ///< delay of the Hall lines behind the voltages, where speeds differ
  Interval flux_linkage_Vs;         ///< peak of a phase's fundamental
  double explained = 0.0;           ///< part of the voltages' power that the rotor's motion explains
};

/// One passage of an edge, for a picture.
struct EdgePassage {
  double t_s = 0.0, speed_deg_s = 0.0;  ///< electrical
  std::size_t edge = 0;                 ///< index in HallIdentity::edges
  /// Against its nominal place, offset and own place included; without voltages up to a constant.
  double place_deg = 0.0;
  bool left_out = false, begins = false;
};

struct HallIdentity {
  std::size_t rows = 0;
  double seconds = 0.0, sector_s = 0.0;
  bool rows_are_changes = false;
  std::size_t forward = 0, backward = 0;  ///< edges; without voltages as if each line were at its own pin
  std::size_t glitches = 0, skipped = 0;  ///< hall_edges.hpp
  std::size_t left_out = 0;               ///< edges that contradict all others
  std::size_t voltages_left_out = 0;      ///< voltage readings that contradict all others
  std::size_t unused = 0;                 ///< edges after the first most_edges
  std::uint8_t mask = 0;                  ///< the codes that never occur are this one and its complement
  double mask_probability = 0.0;
  std::vector<IdentifiedEdge> edges;  ///< six, or six of each pole pair from where the log began
  /// Jitter of an edge from one passage to the next, rms. Without voltages only an upper bound, because an
  /// unsteady rotor has the same effect.
  Interval jitter_deg;
  std::optional<IdentifiedPlace> place;
  std::vector<EdgePassage> passages;
};

/// `pole_pairs` above 1: identifies each edge of the shaft's turn, which needs voltages; 1: the six that all pole
/// pairs share. Ended by keep_going it returns a Problem "was interrupted".
base::Result<HallIdentity> identify(const HallLog& log, int pole_pairs = 1, const KeepGoing& keep_going = {});

/// The pair that makes positive torque where the pins show a code: control::positive_pair() of its sector.
struct CodePair {
  std::uint8_t code = 0, sector = 0;
  control::Pair pair;
};
/// Six rows in the order of their codes.
std::vector<CodePair> commutation_of(const PinCodes& codes);

}  // namespace sixstep::analysis

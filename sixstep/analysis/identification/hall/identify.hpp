// SPDX-License-Identifier: Apache-2.0
// Identifies a motor and its wires from a log of Hall lines and, if recorded, voltages:
// - which line is which, and which lines are inverted,
// - whether the probes are 60 or 120 degrees apart,
// - the angles of the edges and their jitter.
//
// Every result has its uncertainty. Without voltages a log does not show the rotor's angle. Three things are
// then unknown: which line is the first, whether two lines are swapped or the rotor turned backwards, and the
// common offset of all edges. The results are then angles of the edges relative to each other, as if each
// line were at its own pin.
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

/// Angle of one of the repeating edges, relative to the mean of all repeating edges: own[n] of model.md 10.
struct IdentifiedEdge {
  std::uint8_t before = 0, after = 0;  ///< codes at the pins before and after the edge, turning forward
  Interval own_deg;                    ///< electrical degrees
  std::size_t seen = 0;                ///< number of passages that are used
};

/// Results that need voltages.
struct IdentifiedPlace {
  PinCodes codes{};                ///< codes at the pins, in sectors 0 to 5
  double probability = 0.0;        ///< probability that all six codes are right
  double order_probability = 0.0;  ///< probability that the lines' direction is right
  std::vector<HallWires> wires;    ///< all wirings with these codes, the simplest first
  bool forward = true;             ///< true: the rotor turns forward in most of the log
  /// Common offset of all edges, in the direction of positive angles. If the log has one direction only, the
  /// offset cannot be separated from half the hysteresis and from the delay's path at the log's speed. The
  /// value is then the sum of the three for this direction.
  Interval offset_deg;
  double usual_speed_deg_s = 0.0;  ///< mean magnitude of the electrical speed at the edges
  bool both_ways = false;          ///< true: the log has both directions, which separates the offset from the
                                   ///< hysteresis
  /// Number of edges that are not used for the hysteresis, because the rotor reversed beyond them.
  std::size_t at_turns = 0;
  /// Present if the log has both directions, and enough edges between its reversals.
  std::optional<Interval> hysteresis_deg;
  std::optional<Interval> delay_s;  ///< delay of the Hall lines behind the voltages; present if speeds differ
  Interval flux_linkage_Vs;         ///< peak of a phase's fundamental
  double explained = 0.0;           ///< fraction of the voltages' power that the rotor's motion explains
};

/// One passage of an edge, for a picture.
struct EdgePassage {
  double t_s = 0.0, speed_deg_s = 0.0;  ///< electrical speed
  std::size_t edge = 0;                 ///< index in HallIdentity::edges
  /// Distance from the edge's nominal angle, including the offset and the edge's own deviation. Without
  /// voltages, an unknown constant is added to this distance.
  double place_deg = 0.0;
  bool left_out = false, begins = false;
};

struct HallIdentity {
  std::size_t rows = 0;
  double seconds = 0.0, sector_s = 0.0;
  bool rows_are_changes = false;
  std::size_t forward = 0, backward = 0;  ///< number of edges; without voltages the direction is counted as
                                          ///< if each line were at its own pin
  std::size_t glitches = 0, skipped = 0;  ///< numbers as defined in hall_edges.hpp
  std::size_t left_out = 0;               ///< number of edges that contradict all others
  std::size_t voltages_left_out = 0;      ///< number of voltage readings that contradict all others
  std::size_t unused = 0;                 ///< number of edges after the first most_edges
  std::uint8_t mask = 0;                  ///< the code mask and its complement never occur
  double mask_probability = 0.0;
  std::vector<IdentifiedEdge> edges;  ///< six edges, or six for each pole pair, counted from the log's begin
  /// Jitter of an edge from one passage to the next, rms. Without voltages it is an upper bound, because an
  /// unsteady rotor has the same effect.
  Interval jitter_deg;
  std::optional<IdentifiedPlace> place;
  std::vector<EdgePassage> passages;
};

/// Identifies a motor. `pole_pairs` above 1: each edge of the shaft's turn, which needs voltages. 1: the six
/// edges that are common to all pole pairs. If keep_going ends the work, the result is a Problem "was
/// interrupted".
base::Result<HallIdentity> identify(const HallLog& log, int pole_pairs = 1, const KeepGoing& keep_going = {});

/// The pair with positive torque while the pins show a code: control::positive_pair() of the code's sector.
struct CodePair {
  std::uint8_t code = 0, sector = 0;
  control::Pair pair;
};
/// Six rows in the order of their codes.
std::vector<CodePair> commutation_of(const PinCodes& codes);

}  // namespace sixstep::analysis

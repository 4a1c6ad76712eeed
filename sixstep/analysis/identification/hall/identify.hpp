// SPDX-License-Identifier: Apache-2.0
// What a log of Hall lines, and of voltages where there are any, says of a motor and its wires: which line is
// which, inverted or not, 60 or 120 degrees apart, where the edges stand, how they jitter. Every answer says
// how sure it is.
//
// Without voltages a log cannot tell where the rotor is: not which line is the first, not whether two are
// swapped or the rotor turned backwards, not the offset that all edges share. What it tells is then of edges
// against each other, told as if each line were at its own pin.
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

/// Where one of the edges that repeat stands, against the mean of all of them: model.md 10's own[n].
struct IdentifiedEdge {
  std::uint8_t before = 0, after = 0;  ///< codes at the pins, turning forward
  Interval own_deg;                    ///< electrical
  std::size_t seen = 0;                ///< passages that say so: all but those left out and not used
};

/// What only voltages tell.
struct IdentifiedPlace {
  PinCodes codes{};                ///< at the pins, in sectors 0 to 5
  double probability = 0.0;        ///< that all six are right
  double order_probability = 0.0;  ///< that the lines do not run the other way round
  std::vector<HallWires> wires;    ///< that make these codes, the plainest first
  bool forward = true;             ///< most of the log
  /// Of all edges, in the direction of positive angles. A log that turns one way only cannot part it from
  /// half the hysteresis and from what a delay is at the log's speed: it is then as that way shows it.
  Interval offset_deg;
  double usual_speed_deg_s = 0.0;  ///< electrical: mean size of the speed at the edges
  bool both_ways = false;          ///< the log turns so: the offset is parted from the hysteresis
  std::size_t at_turns =
      0;  ///< edges that say nothing of the hysteresis, for the rotor turned back beyond them
  std::optional<Interval>
      hysteresis_deg;               ///< where the log turns both ways, and far enough between its turns
  std::optional<Interval> delay_s;  ///< of the Hall lines behind the voltages, where speeds differ
  Interval flux_linkage_Vs;         ///< peak of a phase's fundamental
  double explained = 0.0;           ///< part of the voltages' power that the rotor makes
};

/// One edge as it was passed, for a picture.
struct EdgePassage {
  double t_s = 0.0, speed_deg_s = 0.0;  ///< electrical
  std::size_t edge = 0;                 ///< of HallIdentity::edges
  double place_deg =
      0.0;  ///< against where it belongs, offset and own place in it; without voltages up to a constant
  bool left_out = false, begins = false;
};

struct HallIdentity {
  std::size_t rows = 0;
  double seconds = 0.0, sector_s = 0.0;
  bool rows_are_changes = false;
  std::size_t forward = 0, backward = 0;  ///< edges; without voltages as if each line were at its own pin
  std::size_t glitches = 0, skipped = 0;  ///< hall_edges.hpp
  std::size_t left_out = 0;               ///< edges that contradict all others
  std::size_t voltages_left_out = 0;      ///< readings of the voltages that do
  std::size_t unused = 0;                 ///< edges behind the first most_edges
  std::uint8_t mask = 0;                  ///< the codes that never occur are this one and its complement
  double mask_probability = 0.0;
  std::vector<IdentifiedEdge> edges;  ///< six, or six of each pole pair from where the log began
  /// Of an edge from one passage to the next, rms. Without voltages no more than a bound: an unsteady rotor looks alike.
  Interval jitter_deg;
  std::optional<IdentifiedPlace> place;
  std::vector<EdgePassage> passages;
};

/// `pole_pairs` where each edge of the shaft's turn is wanted, from the voltages of a log; 1 for the six that
/// they share. Told to stop it answers with a Problem "was interrupted".
base::Result<HallIdentity> identify(const HallLog& log, int pole_pairs = 1, const KeepGoing& keep_going = {});

/// The pair that makes positive torque where the pins show a code: control::positive_pair() of its sector.
struct CodePair {
  std::uint8_t code = 0, sector = 0;
  control::Pair pair;
};
/// By code, six of them.
std::vector<CodePair> commutation_of(const PinCodes& codes);

}  // namespace sixstep::analysis

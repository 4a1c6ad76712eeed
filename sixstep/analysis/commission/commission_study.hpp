// SPDX-License-Identifier: Apache-2.0
// A drive finds out what hangs at it, on the virtual board: what it found, within which bounds, and what the motor is.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "sixstep/analysis/commission/commission_bench.hpp"

namespace sixstep::analysis {

/// What the readings may be off by, by the chip's own numbers: converters' rounding and noise (level_steps.hpp,
/// flux_turn.hpp), the capture timer's count, and what dead time and diodes turn the field by. A trapezoid's field leaves
/// 1.12 degrees more, and cogging pulls the rotor aside, of which the chip cannot know: the bench, which does, adds both.
/// A gain that a converter is wrong by is not in it.
struct CommissionBounds {
  double R_part = 0.0, L_part = 0.0, flux_part = 0.0;  ///< of what was found
  double edge_deg = 0.0;                               ///< electrical, of each Hall edge and of the offset
};
CommissionBounds bounds_of(const CommissionBench& bench, const control::CommissioningState& found);

/// When a phase began.
struct CommissionPhase {
  control::CommissioningPhase phase{};
  double from_s = 0.0, to_s = 0.0;
};

/// For a picture.
struct CommissionRow {
  double t_s = 0.0;
  std::array<double, 3> i_A{};  ///< at the legs
  double turns = 0.0;           ///< electrical, of the rotor since the start
};

/// An edge as it was found, by the code behind it and ahead of it at the pins, in the direction that the board takes for
/// forward.
struct CommissionEdge {
  std::uint8_t before = 0, after = 0;
  double found_deg = 0.0, true_deg = 0.0;  ///< electrical, 0 to 360: where the board has it
};

struct CommissionStudy {
  CommissionSubject subject;
  CommissionBench bench;
  control::CommissioningState state;  ///< as the chip had it at the end
  control::Commissioned<double> found;
  CommissionBounds bounds;
  std::vector<CommissionPhase> phases;
  std::vector<CommissionRow> rows;
  std::array<CommissionEdge, 6> edges{};  ///< where the lines were found
  double shown_offset_deg = 0.0;          ///< of the true edges against the sectors that the board sees
  double seconds = 0.0;

  bool done() const { return state.phase == control::CommissioningPhase::done; }
  bool lines_found() const { return state.probes.verdict == control::HallSurvey::good; }
  /// Of the six edges, the one that is farthest from where it is, in degrees.
  double worst_edge_deg() const;
  /// All was found, each value within its bounds, and a table by which the motor turns.
  bool holds() const;
};

struct CommissionOrder {
  CommissionSubject subject{};
  std::function<bool()> keep_going{};  ///< false ends it early: a Problem "was interrupted"
};

/// Problems are those of the bench. What the chip did not find is no Problem: its state says so.
base::Result<CommissionStudy> study_commission(const CommissionOrder& order);

}  // namespace sixstep::analysis

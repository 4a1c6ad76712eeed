// SPDX-License-Identifier: Apache-2.0
// Runs commissioning on the virtual board, and compares the chip's results, within their bounds, with the motor's
// true values.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "sixstep/analysis/commission/commission_bench.hpp"

namespace sixstep::analysis {

/// Largest errors of the results. The gain error of a converter is not included. Most errors follow from the
/// chip's own numbers:
/// - rounding and noise of the converters (level_steps.hpp, flux_turn.hpp),
/// - the capture timer's count,
/// - the angle by which dead time and diodes turn the field.
///
/// The chip cannot measure two errors; the bench adds them: a trapezoid's field adds 1.12 degrees, and
/// cogging shifts the rotor.
struct CommissionBounds {
  double R_part = 0.0, L_part = 0.0, flux_part = 0.0;  ///< errors relative to the measured value
  double edge_deg = 0.0;  ///< electrical degrees, of each Hall edge and of the offset
};
CommissionBounds bounds_of(const CommissionBench& bench, const control::CommissioningState& found);

/// A phase of the test with its beginning and end.
struct CommissionPhase {
  control::CommissioningPhase phase{};
  double from_s = 0.0, to_s = 0.0;
};

/// A row of the run, for a picture.
struct CommissionRow {
  double t_s = 0.0;
  std::array<double, 3> i_A{};  ///< currents at the board's legs
  double turns = 0.0;           ///< electrical turns of the rotor since the start
};

/// A Hall edge with the codes at the pins before and after it, in the board's forward direction.
struct CommissionEdge {
  std::uint8_t before = 0, after = 0;
  double found_deg = 0.0, true_deg = 0.0;  ///< electrical degrees, 0 to 360, in the board's frame
};

struct CommissionStudy {
  CommissionSubject subject;
  CommissionBench bench;
  control::CommissioningState state;  ///< state of the chip at the end
  control::Commissioned<double> found;
  CommissionBounds bounds;
  std::vector<CommissionPhase> phases;
  std::vector<CommissionRow> rows;
  std::array<CommissionEdge, 6> edges{};  ///< filled if the Hall lines were found
  double shown_offset_deg = 0.0;  ///< true offset: mean deviation of the true edges from the board's sectors
  double seconds = 0.0;

  bool done() const { return state.phase == control::CommissioningPhase::done; }
  bool lines_found() const { return state.probes.verdict == control::HallSurvey::good; }
  /// Largest error of the six edges, degrees.
  double worst_edge_deg() const;
  /// True if every value was found and is within its bounds, and the Hall table turns the motor forward.
  bool holds() const;
};

struct CommissionOrder {
  CommissionSubject subject{};
  std::function<bool()> keep_going{};  ///< false ends the study early with a Problem "was interrupted"
};

/// Returns the Problems of the bench. A value that the chip did not find is no Problem; `state` contains the
/// reason.
base::Result<CommissionStudy> study_commission(const CommissionOrder& order);

}  // namespace sixstep::analysis

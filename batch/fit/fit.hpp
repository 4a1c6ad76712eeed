// SPDX-License-Identifier: Apache-2.0
// Fits constants of a motor, and of the probes that recorded it, to recordings from a bench. The model of each
// recording is the event-exact simulation of a scenario that does what was done on the bench.
//
// Weighted least squares by Levenberg and Marquardt's method; derivatives by central differences of the simulation,
// whose values are exact to rounding. Bounds of 95 % follow from the residuals: their size, their correlation from row
// to row, and, where the sum of squares is not parabolic, its profile.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/rooms.hpp"
#include "sixstep/analysis/for_each.hpp"
#include "sixstep/analysis/identification/fit/fit_result.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace batch {

/// A recording and the scenario that does what was done on the bench.
struct FitBench {
  std::string name;          ///< name of the recording, for messages
  study::Scenario scenario;  ///< its motor is the starting point; all benches have the same motor
  study::Trace log;          ///< t_s and columns of a trace, in the columns' units; NaN cells are left out
  double shift_s = 0.0;      ///< added to the log's times; the starting point if shift_s is free
};

struct FitRequest {
  std::vector<FitBench> benches;
  /// The free parameters: keys that differ from drive to drive ("motor_override.resistance_ohm", "supply.voltage_V"),
  /// shared by all benches; or of each bench "shift_s" and "drift"; or of each of its columns "offset", "gain" and
  /// "delay_s", which a column's name may follow: "gain.i_a_A". Empty: usual_free().
  std::vector<std::string> free;
  analysis::ForEach for_each = analysis::one_after_the_other;
  std::function<bool()> keep_going = {};  ///< called from time to time; false ends the search
};

/// The scenario with both frictions of its motor as keys of the sheet; a friction that the sheet does not have is 0. A fit
/// can vary only keys that the sheet has.
study::Scenario with_both_frictions(study::Scenario scenario);

/// R, L, torque constant, inertia and both frictions of the scenario's motor; the offset of each column.
std::vector<std::string> usual_free(const study::Scenario& scenario);

using analysis::Fit;

/// Problems: no free parameter, a key that cannot vary, a column that the scenario does not have, too few rows, a
/// simulated drive that stops, keep_going() was false.
base::Result<Fit> fit(const FitRequest& request);

}  // namespace batch

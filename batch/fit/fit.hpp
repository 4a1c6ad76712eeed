// SPDX-License-Identifier: Apache-2.0
// Fits constants of a motor, and of the probes that recorded it, to recordings from a bench. The model of
// each recording is an event-exact simulation of a scenario that repeats the bench test.
//
// The method is weighted least squares by Levenberg and Marquardt. Derivatives are central differences of the
// simulation, whose values are exact to rounding. Bounds of 95 % follow from the size of the residuals and
// their correlation from row to row. If the sum of squares is not parabolic, they follow from its profile.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/rooms.hpp"
#include "sixstep/analysis/for_each.hpp"
#include "sixstep/analysis/identification/interval.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace batch {

/// A recording, and the scenario that repeats the bench test.
struct FitBench {
  std::string name;  ///< name of the recording, for messages
  study::Scenario
      scenario;  ///< scenario of the test; its motor is the starting point, and all benches have the same motor
  study::Trace log;      ///< t_s and columns of a trace, in the columns' units; NaN cells are left out
  double shift_s = 0.0;  ///< time added to the log's times, s; the starting point if shift_s is free
};

struct FitRequest {
  std::vector<FitBench> benches;
  /// The free parameters:
  /// - keys that differ from drive to drive ("motor_override.resistance_ohm", "supply.voltage_V"), common to
  /// all benches;
  /// - "shift_s" and "drift" of each bench;
  /// - "offset", "gain" and "delay_s" of each column of each bench, or of one column: "gain.i_a_A".
  /// Empty: usual_free().
  std::vector<std::string> free;
  analysis::ForEach for_each = analysis::one_after_the_other;
  std::function<bool()> keep_going = {};  ///< called repeatedly; if it returns false, the search ends
};

/// R, L, torque constant, inertia and both frictions of the motor; and the offset of each column.
std::vector<std::string> usual_free();

struct FittedValue {
  std::string key;    ///< as in FitRequest::free, with the column's name
  std::string bench;  ///< a probe's parameter: name of its recording
  std::string unit;
  double start = 0.0;
  analysis::Interval value;
  bool by_profile = false;  ///< true: the sum of squares is not parabolic within the bounds
  bool at_zero =
      false;  ///< true: the best value would be negative; the value is then 0, and only the upper bound is computed
};

/// A free parameter that the recordings do not determine. It has its starting value in the fit.
struct Undetermined {
  std::string key, bench, unit;
  double value = 0.0;
  std::string reason;     ///< "no recorded column depends on it"
  std::string recording;  ///< a recording that would determine the parameter; may be empty
};

struct FitColumn {
  std::string bench;
  study::Column column;
  std::vector<double> t_s, recorded, model;  ///< rows of the fit; model includes gain and offset of the probe
  double noise = 0.0;                        ///< rms of recorded values minus model, in the column's unit
  double correlation = 0.0;  ///< correlation of the residuals of consecutive rows; 0 for white noise
};

struct Fit {
  std::vector<FittedValue> values;
  std::vector<Undetermined> undetermined;
  std::vector<FitColumn> columns;
  std::size_t simulations = 0;
  bool converged = false;
};

/// Problems: no free parameter, a key that cannot vary, a column that the scenario does not have, too few
/// rows, a simulated drive that stops, or keep_going() returned false.
base::Result<Fit> fit(const FitRequest& request);

}  // namespace batch

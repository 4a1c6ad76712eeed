// SPDX-License-Identifier: Apache-2.0
// The result of a fit: constants of a motor, and of the probes that recorded it, with their bounds.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/identification/interval.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::analysis {

struct FittedValue {
  std::string
      key;  ///< a key of the scenario ("motor_override.inertia_gcm2"), or a probe's parameter ("gain.i_a_A")
  std::string bench;  ///< name of the recording if the value is a probe's parameter
  std::string unit;
  double start = 0.0;
  Interval value;
  std::string given{};  ///< key of an undetermined parameter for whose kept value this one holds; empty: none
  bool by_profile = false;  ///< whether the sum of squares is not parabolic within the bounds
  bool at_zero = false;  ///< whether the best value would be negative: the value is 0, the upper bound holds
};

/// A free parameter that the recordings do not determine. It has its starting value in the fit.
struct Undetermined {
  std::string key, bench, unit;
  double value = 0.0;
  std::string reason;     ///< "no recorded column depends on it"
  std::string recording;  ///< a recording that would determine it; may be empty
};

struct FitColumn {
  std::string bench;
  study::Column column;
  std::vector<double> t_s, recorded, model;  ///< rows of the fit; model includes gain and offset of the probe
  double noise = 0.0;                        ///< rms of recorded less model, in the column's unit
  double correlation = 0.0;                  ///< of one row's residual with that of the next; white noise: 0
};

struct Fit {
  std::vector<FittedValue> values;
  std::vector<Undetermined> undetermined;
  std::vector<FitColumn> columns;
  std::size_t simulations = 0;
  bool converged = false;
};

/// The scenario's sheet in standard keys, with the fitted values of the motor. Each fitted value names its recordings as
/// its source, and its range is its bounds.
design::Sheet fitted_sheet(const study::Scenario& scenario, const Fit& fit);

/// Whether the differences of a column are correlated from row to row by more than 0.2 and than noise is: the scenario differs
/// from the bench, or a parameter is missing.
bool is_doubtful(const Fit& fit);

/// The key in a motor's file; empty if the value is none of the motor's.
std::string_view motor_key(const FittedValue& value);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Compares a board's log with a simulation of it, column by column. Both are traces: a jump has two rows at
// one instant; between rows a trace is linear.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace sixstep::analysis {

/// Comparison of one column, over the log's rows that lie in the simulated time.
struct TraceComparison {
  study::Column column;
  std::size_t rows = 0;
  double span = 0.0;      ///< highest minus lowest simulated value there
  double rms = 0.0;       ///< rms of log minus simulation
  double greatest = 0.0;  ///< log minus simulation farthest from 0, with its sign
  double at_s = 0.0;      ///< its time
};

/// Compares each column that both have, except the time. `shift_s` is added to the log's times. A column without a
/// common row is left out.
std::vector<TraceComparison> trace_comparison(const study::Trace& simulated, const study::Trace& log,
                                              double shift_s);

/// Least number of rows of a comparison: with one row alone every difference may be 0.
inline constexpr std::size_t fewest_compared = 5;

/// The shift within +-`most_s` with the least difference of all columns together, because a board's clock starts
/// some time after power-on. The difference is the geometric mean of the columns' rms, each as a part of its span
/// or, where that is greater, of the least step of its log. The search uses a grid of `step_s`, then finer
/// ones; of thousands of rows it uses a part. 0 where a shift gains too little: less than a thousandth of the
/// spans, a tenth of the difference, or the log's own steps.
double best_shift_s(const study::Trace& simulated, const study::Trace& log, double most_s, double step_s);

/// Shift for a clock that counts since midnight or since power-on: minus the first row's time where no row lies in
/// the simulated time, else 0.
double start_shift_s(const study::Trace& simulated, const study::Trace& log);

/// The compared columns, and those left out with the reason.
struct Overlay {
  std::vector<TraceComparison> columns;
  struct LeftOut {
    std::string column, reason;
  };
  std::vector<LeftOut> left_out;
  std::size_t rows = 0, inside = 0;  ///< rows of the log; rows in the simulated time
};

/// trace_comparison() of the columns with enough rows. A Problem where no column has them; `name` is the log's.
base::Result<Overlay> overlay(const std::string& name, const study::Trace& simulated, const study::Trace& log,
                              double shift_s);

/// The log at these instants, its times shifted; NaN beyond its ends.
study::Trace at_instants(const study::Trace& log, double shift_s, const std::vector<double>& t_s);

}  // namespace sixstep::analysis

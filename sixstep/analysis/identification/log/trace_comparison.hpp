// SPDX-License-Identifier: Apache-2.0
// Compares a board's log with a simulation of the board, column by column. Both are traces: a jump has two
// rows at one instant; between rows a trace is linear. A column of labels (study::holds_labels()) has the label of
// either row between two rows, since its edge lies somewhere between them.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace sixstep::analysis {

/// Comparison of one column, over the log's rows that lie in the simulated time.
struct TraceComparison {
  study::Column column;
  std::size_t rows = 0;
  double span = 0.0;      ///< highest minus lowest simulated value over the compared rows
  double rms = 0.0;       ///< rms of log minus simulation; of labels sqrt(differing/rows)
  double greatest = 0.0;  ///< the difference log minus simulation that is farthest from 0, with its sign
  double at_s = 0.0;      ///< time of this difference; of labels of the first differing row
  std::optional<std::size_t> differing{};  ///< labels only: rows with another label than the simulation's
};

/// Compares each column that both traces have, except the time. `shift_s` is added to the log's times. A
/// column without a common row is omitted.
std::vector<TraceComparison> trace_comparison(const study::Trace& simulated, const study::Trace& log,
                                              double shift_s);

/// Least number of rows of a comparison: with a single row every difference may be 0.
inline constexpr std::size_t fewest_compared = 5;

/// The shift in s within +-`most_s` with the least difference over all columns. A board's clock needs a shift
/// because it starts some time after power-on. The difference is the geometric mean of the columns' rms. Each
/// rms is a fraction of the column's span or, if it is greater, of the least step of the column's log.
///
/// The search uses a grid of `step_s`, then finer grids. With thousands of rows it uses a part of the rows.
/// The result is 0 if the shift reduces the difference by too little: by less than a thousandth of the spans,
/// a tenth of the difference, or the log's own steps.
double best_shift_s(const study::Trace& simulated, const study::Trace& log, double most_s, double step_s);

/// Shift in s for a clock that counts from midnight or from power-on: minus the first row's time if no row
/// lies in the simulated time, else 0.
double start_shift_s(const study::Trace& simulated, const study::Trace& log);

/// The compared columns, and the omitted columns with the reason.
struct Overlay {
  std::vector<TraceComparison> columns;
  struct LeftOut {
    std::string column, reason;
  };
  std::vector<LeftOut> left_out;
  std::size_t rows = 0, inside = 0;  ///< rows of the log; rows within the simulated time
};

/// trace_comparison() of the columns with enough rows. A Problem if no column has enough rows; `name` is the
/// log's name.
base::Result<Overlay> overlay(const std::string& name, const study::Trace& simulated, const study::Trace& log,
                              double shift_s);

/// The log at these instants, with shifted times; NaN beyond the log's ends.
study::Trace at_instants(const study::Trace& log, double shift_s, const std::vector<double>& t_s);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// A board's log laid over a simulation of it: how far the two lie apart, column by column. Both are traces; where one jumps, both sides of
// the jump stand at one instant, and between its rows each is straight.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace sixstep::analysis {

/// Of one column, over those of the log's rows that lie in the simulated time.
struct TraceComparison {
  study::Column column;
  std::size_t rows = 0;
  double span = 0.0;      ///< of what was simulated there: highest less lowest
  double rms = 0.0;       ///< of log less simulation
  double greatest = 0.0;  ///< the one farthest from 0, with its sign
  double at_s = 0.0;      ///< where that was
};

/// Of each column that both have, but for the time. `shift_s` is added to the log's times. Empty where no row meets the other.
std::vector<TraceComparison> trace_comparison(const study::Trace& simulated, const study::Trace& log,
                                              double shift_s);

/// Rows that a comparison must have at the least: of one alone every difference may be 0.
inline constexpr std::size_t fewest_compared = 5;

/// The shift within `most_s` either way by which all columns together differ least: by the geometric mean of their rms, each as a part of
/// its own span or, where that is greater, of the least step of its log; looked for in steps first: a board's clock starts some time after it is turned on. Of thousands of rows a part is
/// asked. 0 where a shift gains nothing that counts: less than a thousandth of the spans, or less than the log's own steps can tell.
double best_shift_s(const study::Trace& simulated, const study::Trace& log, double most_s, double step_s);

/// What makes a clock that counts since midnight, or since it was turned on, count from the simulation's start: minus the first row's time
/// where no row lies in the simulated time, else 0.
double start_shift_s(const study::Trace& simulated, const study::Trace& log);

/// What was compared, and what was not.
struct Overlay {
  std::vector<TraceComparison> columns;
  struct LeftOut {
    std::string column, reason;
  };
  std::vector<LeftOut> left_out;
  std::size_t rows = 0, inside = 0;  ///< of the log, and of these in the simulated time
};

/// trace_comparison() of columns with rows enough. A Problem where no column has them; `name` is the log's.
base::Result<Overlay> overlay(const std::string& name, const study::Trace& simulated, const study::Trace& log,
                              double shift_s);

/// The log at these instants, its times shifted; NaN beyond its ends.
study::Trace at_instants(const study::Trace& log, double shift_s, const std::vector<double>& t_s);

}  // namespace sixstep::analysis

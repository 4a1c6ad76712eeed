// SPDX-License-Identifier: Apache-2.0
// Writes several runs on one page: the differences of their inputs, of their results and of every curve.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct ComparedRun {
  std::string name;                          ///< short name of the file
  const sixstep::study::Scenario& scenario;  ///< scenario of the run; for a board's log, the scenario with
                                             ///< which the log is compared
  const sixstep::study::Outcome* outcome;    ///< null for a board's log, which has only columns
  const sixstep::study::Trace& events;       ///< every event, with both sides of each jump; for drawing
  const sixstep::study::Trace& grid;  ///< exact values at the same instants in all runs; for subtraction
};

inline constexpr std::size_t most_compared = 5;  ///< a page has no more distinguishable colours

struct ComparisonInput {
  std::vector<ComparedRun> runs;  ///< two to most_compared; differences are relative to the first one, which
                                  ///< must be a run
  std::vector<sixstep::analysis::TraceComparison> laid_over{};  ///< comparison with a log, which is then the
                                                                ///< last run
  double shift_s = 0.0;                                         ///< shift of the log
  std::string command;
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_comparison(const ComparisonInput& input);

/// The time grid in s on which the runs of these scenarios are subtracted: whole periods of the fastest PWM,
/// as fine as a page can hold.
double common_grid_s(const std::vector<const sixstep::study::Scenario*>& scenarios);

}  // namespace report

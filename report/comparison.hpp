// SPDX-License-Identifier: Apache-2.0
// Writes several runs on one page: the differences between their inputs, their results and their curves.
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
  const sixstep::study::Scenario& scenario;  ///< scenario of the run; for a board's log, the scenario of the
                                             ///< compared simulation
  const sixstep::study::Outcome* outcome;    ///< null for a board's log, which has only columns
  const sixstep::study::Trace& events;       ///< every event, with the values before and after each jump; for
                                             ///< drawing
  const sixstep::study::Trace& grid;  ///< exact values at the same instants in all runs; for subtraction
};

inline constexpr std::size_t most_compared = 5;  ///< the page has five distinguishable colours

struct ComparisonInput {
  std::vector<ComparedRun> runs;  ///< two to most_compared; differences are relative to the first entry,
                                  ///< which must be a run
  std::vector<sixstep::analysis::TraceComparison> laid_over{};  ///< if not empty: comparison with a log,
                                                                ///< which is the last entry of `runs`
  double shift_s = 0.0;                                         ///< time by which the log is shifted, s
  std::string command;
  std::string version;
};

/// Returns the page. The same input gives the same bytes.
std::string render_comparison(const ComparisonInput& input);

/// The time grid in s on which the runs are subtracted. Its step is a whole number of periods of the fastest
/// PWM, as fine as fits into a page.
double common_grid_s(const std::vector<const sixstep::study::Scenario*>& scenarios);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Several runs on one page: what differs in what they were given, in what came out, and in every curve.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct ComparedRun {
  std::string name;                          ///< short: the file's
  const sixstep::study::Scenario& scenario;  ///< of a board's log the one that it is laid over
  const sixstep::study::Outcome*
      outcome;                          ///< null: a log of a board, of which nothing is known but its columns
  const sixstep::study::Trace& events;  ///< every event, both sides of each jump: what is drawn
  const sixstep::study::Trace& grid;  ///< at the same instants for all runs, exact there: what is subtracted
};

inline constexpr std::size_t most_compared = 5;  ///< as many as there are colours that can be told apart

struct ComparisonInput {
  std::vector<ComparedRun> runs;  ///< two to most_compared; differences are against the first, which is a run
  std::vector<sixstep::analysis::TraceComparison> laid_over{};  ///< of a log, the last one
  double shift_s = 0.0;                                         ///< of the log
  std::string command;
  std::string version;
};

/// The same input gives the same bytes.
std::string render_comparison(const ComparisonInput& input);

/// The grid on which these scenarios can be subtracted: whole periods of the quickest PWM, as fine as a page
/// can carry; s.
double common_grid_s(const std::vector<const sixstep::study::Scenario*>& scenarios);

}  // namespace report

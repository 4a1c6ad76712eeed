// SPDX-License-Identifier: Apache-2.0
// Writes a run as one HTML file that needs no network: verdict, linked charts, parameters with their sources,
// gains with their derivation, energy balance.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

struct ReportInput {
  const sixstep::study::Scenario& scenario;
  const sixstep::study::Outcome& outcome;
  const sixstep::study::Trace& trace;  ///< trace of KeptRows; columns without a number are omitted
  std::string command;                 ///< the command that writes this report again
  std::string version;
  std::string scenario_text;  ///< text of the scenario's file
};

/// Returns the page. The same input gives the same bytes: the page contains no date and no machine name.
std::string render(const ReportInput& input);

struct IndexEntry {
  std::string title;
  std::string file;  ///< file name of the report, relative to the index; empty: there is no report
  const sixstep::study::Outcome* outcome;  ///< null: there is no outcome
  bool finished = true;                    ///< false: interrupted or not started, so the run is not judged
};

/// The table of all verdicts of one command, with links to the reports. If an experiment is not finished, the
/// table begins with a note and has no total.
std::string render_index(const std::vector<IndexEntry>& entries, std::string_view command,
                         std::string_view version);

}  // namespace report

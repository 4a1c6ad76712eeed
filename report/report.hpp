// SPDX-License-Identifier: Apache-2.0
// A run as one HTML file that opens anywhere, without a network: verdict, linked charts, parameters with
// their sources, gains with their derivation, energy book.
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
  const sixstep::study::Trace& trace;  ///< of every event, as KeptRows has it; NaN columns are left out
  std::string command;                 ///< what makes this report again
  std::string version;
  std::string scenario_text;  ///< the file as written
};

/// The same input gives the same bytes: no date, no machine name.
std::string render(const ReportInput& input);

struct IndexEntry {
  std::string title;
  std::string file;                        ///< of the report, relative to the index; empty: there is none
  const sixstep::study::Outcome* outcome;  ///< null: it came to none
  bool finished = true;                    ///< false: cut short, or never begun; nothing is judged then
};

/// The table of all verdicts of one command, with links to the reports. Where not all experiments are
/// finished it says so first, and draws no sum of them.
std::string render_index(const std::vector<IndexEntry>& entries, std::string_view command,
                         std::string_view version);

}  // namespace report

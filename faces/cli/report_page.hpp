// SPDX-License-Identifier: Apache-2.0
// Connects the command line with the report.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "report/plan_page.hpp"
#include "report/report.hpp"
#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace cli {

struct ReportSource {
  const study::Scenario& scenario;
  const study::Outcome& outcome;
  const study::Trace& events;  ///< every event, with the values before and after each jump
  const std::string& text;     ///< text of the scenario's file
  const std::string& command;  ///< the command that writes this report again
};

std::string report_page(const ReportSource& source);

std::string report_index(const std::vector<report::IndexEntry>& entries, const std::string& command);

struct ComparedSource {
  std::string name;
  const study::Scenario& scenario;
  const study::Outcome* outcome;  ///< null for a board's log
  const study::Trace& events;
  const study::Trace& grid;  ///< rows at the same instants for all runs
};

/// The difference between a board's log and its simulation.
struct LogFound {
  std::vector<analysis::TraceComparison> columns;
  double shift_s = 0.0;
};

/// The page of a comparison. If `log` has columns, the last run is the log.
std::string comparison_page(const std::vector<ComparedSource>& runs, const LogFound& log,
                            const std::string& command);

/// The page of one plan, or of two plans drawn over each other.
std::string plan_page(const std::vector<report::PagePlan>& plans, const std::string& command);

/// Numbers of the plan's runs that should be inspected first.
std::vector<std::size_t> worst_runs(const text::PlanStory& story, std::size_t most);

}  // namespace cli

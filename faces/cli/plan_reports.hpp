// SPDX-License-Identifier: Apache-2.0
// Links a plan's page with its runs: the command that repeats one run, and reports of the runs to inspect
// first.
#pragma once
#include <cstddef>
#include <map>
#include <string>

#include "faces/cli/plan_reading.hpp"
#include "report/plan_page.hpp"
#include "text/results/plan_text.hpp"

namespace cli {

/// A command line that repeats a run once the run's number is appended: "sixstep run a.toml --vary
/// pwm.period_s=20us:100us:9 --only".
std::string repeating_command(const RunArguments& arguments, const ReadPlan& plan);

/// The contents of a plan's page; `reports` as in WorstReports::files.
report::PagePlan page_of(const RunArguments& arguments, const ReadPlan& plan, const text::PlanStory& story,
                         std::map<std::size_t, std::string> reports);

struct WorstReports {
  std::map<std::size_t, std::string> files;  ///< paths of reports by the run's number, relative to the page
  base::Problems problems;
};

/// Repeats the worst runs and writes a complete report of each into the folder of --out.
WorstReports write_worst_reports(const RunArguments& arguments, const ReadPlan& plan,
                                 const text::PlanStory& story);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
// From a plan's page to the runs on it: the command that makes one of them alone, and reports of those to look at first.
#pragma once
#include <cstddef>
#include <map>
#include <string>

#include "faces/cli/plan_reading.hpp"
#include "report/plan_page.hpp"
#include "text/results/plan_text.hpp"

namespace cli {

/// A command line that a run's number completes: "sixstep run a.toml --vary pwm.period_s=20us:100us:9 --only".
std::string repeating_command(const RunArguments& arguments, const ReadPlan& plan);

/// What a page has of a plan; `reports` as WorstReports::files.
report::PagePlan page_of(const RunArguments& arguments, const ReadPlan& plan, const text::PlanStory& story,
                         std::map<std::size_t, std::string> reports);

struct WorstReports {
  std::map<std::size_t, std::string> files;  ///< by the run's number; beside the page
  base::Problems problems;
};

/// The worst few runs once more, each with its whole report, in the folder of --out.
WorstReports write_worst_reports(const RunArguments& arguments, const ReadPlan& plan,
                                 const text::PlanStory& story);

}  // namespace cli

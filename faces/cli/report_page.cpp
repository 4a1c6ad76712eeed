// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/report_page.hpp"

#include "report/comparison.hpp"
#include "report/plan_worst.hpp"

namespace cli {

std::string report_page(const ReportSource& s) {
  return report::render({.scenario = s.scenario,
                         .outcome = s.outcome,
                         .trace = s.events,
                         .command = s.command,
                         .version = SIXSTEP_VERSION,
                         .scenario_text = s.text});
}

std::string report_index(const std::vector<report::IndexEntry>& entries, const std::string& command) {
  return report::render_index(entries, command, SIXSTEP_VERSION);
}

std::string comparison_page(const std::vector<ComparedSource>& runs, const LogFound& log,
                            const std::string& command) {
  report::ComparisonInput input{.runs = {},
                                .laid_over = log.columns,
                                .shift_s = log.shift_s,
                                .command = command,
                                .version = SIXSTEP_VERSION};
  for (const ComparedSource& run : runs)
    input.runs.push_back({run.name, run.scenario, run.outcome, run.events, run.grid});
  return report::render_comparison(input);
}

std::string plan_page(const std::vector<report::PagePlan>& plans, const std::string& command) {
  return report::render_plan({.plans = plans, .command = command, .version = SIXSTEP_VERSION});
}

std::vector<std::size_t> worst_runs(const text::PlanStory& story, std::size_t most) {
  return report::worst_runs(story, most);
}

}  // namespace cli

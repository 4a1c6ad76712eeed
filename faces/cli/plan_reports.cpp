// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "faces/cli/report_page.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "text/escape/escape.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_reports = 3;

std::size_t place_of_page() {
  return static_cast<std::size_t>(std::ranges::find(formats(), page_option, &Format::option) -
                                  formats().begin());
}

/// Writes the report of one run. Returns problems if it is not written.
base::Problems write_report(const RunArguments& a, const ReadPlan& plan, std::size_t number,
                            const std::string& path) {
  base::Result<analysis::PlannedRun> run = plan.scenarios->run(number);
  if (!run) return run.problems();
  files::TraceOrigin origin = origin_of_run(plan, number);
  origin.command =
      fmt::format("{} {} {} {}", repeating_command(a, plan), number, page_option, text::shell_word(path));
  Job job(std::move(run->scenario), std::move(origin));
  OutputPaths paths;
  paths.force = a.paths.force;
  paths.of_formats[place_of_page()] = path;
  if (base::Problems problems = job.prepare(paths); !problems.empty()) return problems;
  job.run([](double) {});
  return job.problems();
}

}  // namespace

std::string repeating_command(const RunArguments& a, const ReadPlan& plan) {
  const analysis::Plan& p = plan.scenarios->plan();
  std::string text = "sixstep run " + text::shell_word(plan.origin.scenario);
  const auto add = [&](const std::string& option, const std::string& value) {
    text += " " + option + " " + text::shell_word(value);
  };
  for (const std::string& vary : a.plan.vary) add("--vary", vary);
  if (!a.plan.sampling.empty()) add("--sampling", a.plan.sampling);
  if (a.plan.points > 0) add("--points", std::to_string(a.plan.points));
  if (a.plan.tolerances) text += " --tolerances";
  for (const std::string& set : a.sets) add("--set", set);
  if (!a.data_dir.empty()) add("--data", a.data_dir);
  if (a.seed) add("--seed", std::to_string(*a.seed));
  if (p.axes.empty()) return text + " --drive";
  if (a.runs > 0) add("--runs", std::to_string(a.runs));
  return text + " --only";
}

report::PagePlan page_of(const RunArguments& a, const ReadPlan& plan, const text::PlanStory& story,
                         std::map<std::size_t, std::string> reports) {
  return {.story = story,
          .title = plan.title,
          .motor = plan.origin.motor,
          .notes = plan.notes,
          .repeats = repeating_command(a, plan),
          .reports = std::move(reports)};
}

WorstReports write_worst_reports(const RunArguments& a, const ReadPlan& plan, const text::PlanStory& story) {
  WorstReports written;
  for (const std::size_t number : worst_runs(story, most_reports)) {
    if (interrupted()) break;
    const std::string file = fmt::format("{}.run-{}.html", plan.name, number);
    const base::Problems problems = write_report(a, plan, number, (fs::path(a.out) / file).string());
    if (problems.empty()) written.files.emplace(number, file);
    append(written.problems, problems);
  }
  return written;
}

}  // namespace cli

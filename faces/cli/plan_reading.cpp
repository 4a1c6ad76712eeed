// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "faces/cli/choose.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/settings.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "sixstep/analysis/plan/plan_description.hpp"
#include "text/plan/plan_file.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

/// Whether the file is a plan. Only regular files are examined, because a pipe can be read only once.
bool is_plan_file(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  const base::Result<std::string> text = files::read_text(file);
  return text && text::is_plan(*text);
}

/// Adds the command line's options to a plan. An axis of an option replaces the file's axis for the same key.
base::Problems add_options(const RunArguments& a, analysis::Plan& plan) {
  base::Problems problems;
  std::size_t of_file = plan.axes.size();
  for (const std::string& vary : a.plan.vary) {
    base::Result<analysis::Axis> axis = text::axis_of(vary);
    if (!axis) {
      for (base::Problem problem : axis.problems()) {
        problem.where = "--vary " + problem.where;
        problems.push_back(std::move(problem));
      }
      continue;
    }
    // An option replaces only axes of the file; two options for one key are a problem.
    const auto end = plan.axes.begin() + static_cast<std::ptrdiff_t>(of_file);
    const auto same = std::find_if(plan.axes.begin(), end,
                                   [&](const analysis::Axis& other) { return other.key == axis->key; });
    if (same != end) {
      plan.axes.erase(same);
      --of_file;
    }
    plan.axes.push_back(std::move(*axis));
  }
  if (!a.plan.sampling.empty())
    choose("--sampling", a.plan.sampling, analysis::sampling_choices, plan.sampling, problems);
  else if (a.plan.points > 0 && plan.sampling == analysis::Sampling::grid)
    plan.sampling = analysis::Sampling::sobol;
  if (a.plan.points > 0 && plan.sampling == analysis::Sampling::grid)
    problems.push_back({"--points", std::to_string(a.plan.points),
                        "applies only to drawn points; in a grid each range has its own number of points",
                        "write --vary KEY=FROM:TO:POINTS, or leave out --sampling grid"});
  for (const analysis::Axis& axis : plan.axes)
    for (const std::string& set : a.sets)
      if (set.substr(0, set.find('=')) == axis.key)
        problems.push_back({"--set " + axis.key, "", "has no effect, because the plan varies this key",
                            "remove --set, or the key from the plan"});
  if (a.plan.points > 0) plan.points = a.plan.points;
  if (a.runs > 0) plan.drives = a.runs;
  if (a.drive) plan.drives = static_cast<std::size_t>(*a.drive) + 1;
  if (a.seed) plan.seed = *a.seed;
  return problems;
}

/// In problems, replaces vary[0] by "--vary pwm.period_s". If a scenario lacks a list of axes, replaces vary
/// by "--vary".
void in_words_of(const RunArguments& a, const std::string& file, const analysis::Plan& plan,
                 base::Problems& problems) {
  for (base::Problem& problem : problems) {
    if (problem.where == "vary" && !is_plan_file(file)) problem.where = "--vary";
    for (std::size_t n = 0; n < plan.axes.size() && !a.plan.vary.empty(); ++n)
      if (problem.where.starts_with(fmt::format("vary[{}].", n)))
        problem.where = "--vary " + plan.axes[n].key;
  }
}

/// The plan of the file; for a scenario, a plan with a single run.
base::Result<text::PlanFile> plan_of(const std::string& file) {
  if (!is_plan_file(file)) {
    text::PlanFile alone;
    alone.scenario = file;
    return alone;
  }
  base::Result<std::string> text = files::read_text(file);
  if (!text) return text.problems();
  base::Result<text::PlanFile> plan = text::read_plan_text(file, std::move(*text));
  if (plan) plan->scenario = text::beside(file, plan->scenario);
  return plan;
}

std::uint64_t inputs_digest(const files::ReadLog& log, const RunArguments& a, bool tolerances) {
  std::uint64_t digest = log.digest();
  for (const std::string& set : a.sets) digest = files::text_digest(set, digest);
  return tolerances ? files::text_digest("sheet_tolerances", digest) : digest;
}

base::Problems without_drives(const RunArguments& a, const analysis::Plan& plan) {
  if (!a.plan.tolerances || plan.drives > 0) return {};
  return {{.where = "--tolerances",
           .limit = "needs several drives, but this plan runs only the drive as written",
           .cure = "give the number of drives, for example --runs 1000"}};
}

base::Problems without_series(const std::string& file, const ReadPlan& plan) {
  if (plan.scenarios->plan().drives == 0 || !plan.nominal.spread.empty()) return {};
  return {{.where = file + ":",
           .limit = "has no [[spread]], so that all drives would be the same",
           .cure = "add [[spread]] with the values that vary; see: sixstep help spread"}};
}

}  // namespace

bool plans(const RunArguments& a, const std::string& file) {
  const PlanArguments& p = a.plan;
  return a.runs > 0 || a.drive || !p.vary.empty() || !p.sampling.empty() || p.points > 0 || p.tolerances ||
         !p.store.empty() || p.resume || p.dry_run || is_plan_file(file);
}

base::Result<ReadPlan> read_plan(const std::string& file, const RunArguments& arguments) {
  base::Problems problems;
  const files::ReadOptions options = read_options(arguments.data_dir, arguments.sets, problems);
  if (!problems.empty()) return problems;
  base::Result<text::PlanFile> of_file = plan_of(file);
  if (!of_file) return of_file.problems();
  const files::ReadLog log;  // logs only the inputs of the runs, because other parts of the plan may change
  base::Result<std::string> text = files::read_text(of_file->scenario);
  if (!text) return text.problems();
  analysis::Plan& plan = of_file->plan;
  problems = add_options(arguments, plan);
  if (problems.empty()) problems = without_drives(arguments, plan);
  if (problems.empty()) problems = analysis::check(plan);
  in_words_of(arguments, file, plan, problems);
  if (!problems.empty()) return problems;

  const bool tolerances = of_file->sheet_tolerances || arguments.plan.tolerances;
  ReadPlan read;
  read.name = fs::path(file).stem().string();
  read.scenarios = std::make_unique<text::PlannedScenarios>(
      text::PlannedText{of_file->scenario,
                        *text,
                        {.overrides = options.overrides, .resolve = files::on_disk(options.data_dir)},
                        tolerances},
      plan);
  base::Result<study::Scenario> nominal = read.scenarios->nominal();
  if (!nominal) return nominal.problems();
  read.nominal = std::move(*nominal);
  problems = read.scenarios->check();
  in_words_of(arguments, file, plan, problems);
  append(problems, without_series(file, read));
  if (!problems.empty()) return problems;
  read.title = of_file->title.empty() ? read.nominal.title : of_file->title;
  read.notes = of_file->notes;
  read.minimise = of_file->minimise;
  read.evaluations = of_file->evaluations;
  read.columns = analysis::columns_of(read.scenarios->plan(), read.nominal, unit_of);
  read.origin = {.scenario = file,
                 .digest = inputs_digest(log, arguments, tolerances),
                 .title = read.title,
                 .motor = read.nominal.sheet.name,
                 .command = arguments.command,
                 .text = *text};
  return read;
}

files::TraceOrigin origin_of_run(const ReadPlan& plan, std::uint64_t number) {
  files::TraceOrigin origin = plan.origin;
  origin.digest =
      files::text_digest(fmt::format("seed {} drive {}", plan.scenarios->plan().seed, number), origin.digest);
  return origin;
}

std::string store_path(const RunArguments& a, const std::string& name) {
  if (!a.plan.store.empty() || a.out.empty()) return a.plan.store;
  return (fs::path(a.out) / (name + ".sqlite")).string();
}

}  // namespace cli

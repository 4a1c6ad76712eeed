// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/optimise_command.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "batch/optimise.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/stop_watch.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "text/keys/key_advice.hpp"
#include "text/plan/plan_file.hpp"
#include "text/results/optimum_text.hpp"
#include "text/results/plan_text.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

/// The column of the figure that the plan minimises.
base::Result<std::size_t> figure_of(const OptimiseArguments& a, const ReadPlan& plan) {
  if (plan.minimise.empty())
    return base::Problem{a.plan + ":", "", "does not name the figure to minimise",
                         "name a figure of the scenario: minimise = \"label\""};
  std::vector<std::string> known;
  for (std::size_t n = 0; n < plan.columns->figures.size(); ++n) {
    if (plan.columns->figures[n].name == plan.minimise) return n;
    known.push_back(plan.columns->figures[n].name);
  }
  const std::string near = text::nearest(plan.minimise, known);
  return base::Problem{a.plan + ": minimise", plan.minimise, "is not a figure of the scenario",
                       near.empty() ? fmt::format("use one of: {}", fmt::join(known, "; "))
                                    : fmt::format("did you mean {}?", near)};
}

base::Problems not_to_be_chosen(const OptimiseArguments& a, const analysis::Plan& plan) {
  base::Problems problems;
  for (const analysis::Axis& axis : plan.axes) {
    if (!axis.values.empty())
      problems.push_back({a.plan + ": " + axis.key, "", "is a list, and --optimise needs ranges",
                          "give from and to, or write a plan for each value"});
    if (axis.strays)
      problems.push_back({a.plan + ": " + axis.key, "", "is drawn by [[spread]] and cannot be chosen",
                          "move it into [[spread]] of the scenario"});
  }
  return problems;
}

struct OptimumFiles {
  std::optional<files::AtomicFile> toml, json;

  base::Problems open(const OptimiseArguments& a) {
    for (const auto& [path, file] :
         {std::pair{a.toml, &toml}, std::pair{a.json == "-" ? "" : a.json, &json}}) {
      if (path.empty()) continue;
      base::Result<files::AtomicFile> opened = files::AtomicFile::create({path, a.force});
      if (!opened) return opened.problems();
      file->emplace(std::move(*opened));
    }
    return {};
  }
};

std::optional<analysis::Optimum> search(const OptimiseArguments& a, const ReadPlan& plan, std::size_t figure,
                                        files::PlanStore& store) {
  std::map<std::size_t, analysis::RunRecord> before;
  const base::Problems unread =
      store.each([&](const analysis::RunRecord& record) { before.emplace(record->number, record); });
  complain(unread);
  const StopWatch watch([&store] { return store.failed(); });
  Progress progress({.seconds = {}, .pieces = plan.evaluations, .of = "points"}, a.quiet);
  return batch::optimise({.plan = plan.scenarios->plan(),
                          .columns = plan.columns,
                          .figure = figure,
                          .evaluations = plan.evaluations,
                          .scenario = [&](const std::vector<std::string>& point,
                                          std::size_t drive) { return plan.scenarios->run(point, drive); },
                          .known = [&](std::size_t number) -> std::optional<analysis::RunRecord> {
                            const auto known = before.find(number);
                            return known == before.end() ? std::nullopt : std::optional(known->second);
                          },
                          .take = [&](analysis::RunRecord&& record) { store.add(std::move(record)); },
                          .progress = [&](std::size_t done) { progress.pieces_done(done); },
                          .stop = watch.token(),
                          .jobs = a.jobs});
}

base::Problems write(OptimumFiles& outputs, const ReadPlan& plan, const analysis::Optimum& best,
                     const std::string& json) {
  base::Problems unwritten;
  const auto commit = [&](std::optional<files::AtomicFile>& file, const std::string& text) {
    if (!file) return;
    file->write(text);
    const base::Problems wrong = file->commit();
    unwritten.insert(unwritten.end(), wrong.begin(), wrong.end());
  };
  const base::Result<study::Scenario> there = plan.scenarios->at(best.point);
  if (there) commit(outputs.toml, files::with_own_mark(plan.origin.command, text::scenario_text(*there)));
  commit(outputs.json, json);
  return unwritten;
}

}  // namespace

Exit optimise_command(const OptimiseArguments& a) {
  RunArguments as_run;
  as_run.files = {a.plan};
  as_run.data_dir = a.data_dir;
  as_run.command = a.command;
  as_run.paths.force = a.force;
  as_run.plan.store = a.store;
  as_run.plan.resume = a.resume;
  const base::Result<ReadPlan> plan = read_plan(a.plan, as_run);
  if (!plan) return refused(plan.problems());
  const base::Result<std::size_t> figure = figure_of(a, *plan);
  if (!figure) return refused(figure.problems());
  if (const base::Problems problems = not_to_be_chosen(a, plan->scenarios->plan()); !problems.empty())
    return refused(problems);
  if (const base::Problems problems = batch::missing_optimiser(); !problems.empty()) return refused(problems);
  catch_interrupts();
  OptimumFiles outputs;
  if (const base::Problems problems = outputs.open(a); !problems.empty()) return refused(problems);
  base::Result<files::PlanStore> store =
      store_of(as_run, *plan, text::plan_identity(plan->scenarios->plan()) + " minimise " + plan->minimise);
  if (!store) return refused(store.problems());
  const std::optional<analysis::Optimum> best = search(a, *plan, *figure, *store);
  if (const base::Problems unwritten = store->finish(); !unwritten.empty()) return refused(unwritten);
  if (interrupted()) return told_interrupted("the search", kept_in(a.store));
  if (!best)
    return refused({{a.plan + ":", "", "has no point that can be run",
                     "find the reason with: sixstep run PLAN --only 0"}});
  const text::OptimumStory story{plan->name, plan->scenarios->plan(), *plan->columns, *figure};
  const std::string json = text::optimum_json(story, *best);
  if (const base::Problems unwritten = write(outputs, *plan, *best, json); !unwritten.empty())
    return refused(unwritten);
  if (a.json == "-") print(json);
  const std::string drawn = text::drawn_text(
      text::drive_spreads(plan->nominal, *plan->columns),
      plan->scenarios->made_of().sheet_tolerances ? analysis::tolerances_not_drawn(plan->nominal) : "");
  if (!a.quiet) print(drawn + text::optimum_text(story, *best), a.json == "-" ? stderr : stdout);
  return best->holds ? Exit::ok : Exit::failed;
}

}  // namespace cli

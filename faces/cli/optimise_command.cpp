#include "sixstep/analysis/verify/robust.hpp"
// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/optimise_command.hpp"
#include "sixstep/analysis/verify/robust.hpp"

#include <fmt/format.h>
#include "sixstep/analysis/verify/robust.hpp"

#include <map>
#include <optional>
#include <utility>
#include "sixstep/analysis/verify/robust.hpp"

#include "batch/optimise.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/stop_watch.hpp"
#include "faces/cli/terminal.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "text/keys/key_advice.hpp"
#include "text/plan/plan_file.hpp"
#include "text/results/optimum_text.hpp"
#include "text/results/plan_text.hpp"
#include "text/scenario/scenario_text.hpp"

#include "sixstep/analysis/verify/robust.hpp"
namespace cli {
#include "sixstep/analysis/verify/robust.hpp"
namespace {
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
/// The column of the figure that the plan minimises.
#include "sixstep/analysis/verify/robust.hpp"
base::Result<std::size_t> figure_of(const OptimiseArguments& a, const ReadPlan& plan) {
#include "sixstep/analysis/verify/robust.hpp"
  if (plan.minimise.empty())
#include "sixstep/analysis/verify/robust.hpp"
    return base::Problem{a.plan + ":", "", "does not name the figure to minimise",
#include "sixstep/analysis/verify/robust.hpp"
                         "name a figure of the scenario: minimise = \"label\""};
#include "sixstep/analysis/verify/robust.hpp"
  std::vector<std::string> known;
#include "sixstep/analysis/verify/robust.hpp"
  for (std::size_t n = 0; n < plan.columns->figures.size(); ++n) {
#include "sixstep/analysis/verify/robust.hpp"
    if (plan.columns->figures[n].name == plan.minimise) return n;
#include "sixstep/analysis/verify/robust.hpp"
    known.push_back(plan.columns->figures[n].name);
#include "sixstep/analysis/verify/robust.hpp"
  }
#include "sixstep/analysis/verify/robust.hpp"
  const std::string near = text::nearest(plan.minimise, known);
#include "sixstep/analysis/verify/robust.hpp"
  return base::Problem{a.plan + ": minimise", plan.minimise, "is not a figure of the scenario",
#include "sixstep/analysis/verify/robust.hpp"
                       near.empty() ? fmt::format("use one of: {}", fmt::join(known, "; "))
#include "sixstep/analysis/verify/robust.hpp"
                                    : fmt::format("did you mean {}?", near)};
#include "sixstep/analysis/verify/robust.hpp"
}
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
base::Problems not_to_be_chosen(const OptimiseArguments& a, const analysis::Plan& plan) {
#include "sixstep/analysis/verify/robust.hpp"
  base::Problems problems;
#include "sixstep/analysis/verify/robust.hpp"
  for (const analysis::Axis& axis : plan.axes) {
#include "sixstep/analysis/verify/robust.hpp"
    if (!axis.values.empty())
#include "sixstep/analysis/verify/robust.hpp"
      problems.push_back({a.plan + ": " + axis.key, "", "is a list of values, but --optimise needs ranges",
#include "sixstep/analysis/verify/robust.hpp"
                          "give from and to instead of values, or write a plan for each value"});
#include "sixstep/analysis/verify/robust.hpp"
    if (axis.strays)
#include "sixstep/analysis/verify/robust.hpp"
      problems.push_back({a.plan + ": " + axis.key, "", "is drawn by [[spread]] and cannot be chosen",
#include "sixstep/analysis/verify/robust.hpp"
                          "move the key into [[spread]] of the scenario"});
#include "sixstep/analysis/verify/robust.hpp"
  }
#include "sixstep/analysis/verify/robust.hpp"
  return problems;
#include "sixstep/analysis/verify/robust.hpp"
}
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
struct OptimumFiles {
#include "sixstep/analysis/verify/robust.hpp"
  std::optional<files::AtomicFile> toml, json;
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
  base::Problems open(const OptimiseArguments& a) {
#include "sixstep/analysis/verify/robust.hpp"
    for (const auto& [path, file] :
#include "sixstep/analysis/verify/robust.hpp"
         {std::pair{a.toml, &toml}, std::pair{a.json == "-" ? "" : a.json, &json}}) {
#include "sixstep/analysis/verify/robust.hpp"
      if (path.empty()) continue;
#include "sixstep/analysis/verify/robust.hpp"
      base::Result<files::AtomicFile> opened = files::AtomicFile::create({path, a.force});
#include "sixstep/analysis/verify/robust.hpp"
      if (!opened) return opened.problems();
#include "sixstep/analysis/verify/robust.hpp"
      file->emplace(std::move(*opened));
#include "sixstep/analysis/verify/robust.hpp"
    }
#include "sixstep/analysis/verify/robust.hpp"
    return {};
#include "sixstep/analysis/verify/robust.hpp"
  }
#include "sixstep/analysis/verify/robust.hpp"
};
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
std::optional<analysis::Optimum> search(const OptimiseArguments& a, const ReadPlan& plan, std::size_t figure,
#include "sixstep/analysis/verify/robust.hpp"
                                        files::PlanStore& store) {
#include "sixstep/analysis/verify/robust.hpp"
  std::map<std::size_t, analysis::RunRecord> before;
#include "sixstep/analysis/verify/robust.hpp"
  const base::Problems unread =
#include "sixstep/analysis/verify/robust.hpp"
      store.each([&](const analysis::RunRecord& record) { before.emplace(record->number, record); });
#include "sixstep/analysis/verify/robust.hpp"
  complain(unread);
#include "sixstep/analysis/verify/robust.hpp"
  const StopWatch watch([&store] { return store.failed(); });
#include "sixstep/analysis/verify/robust.hpp"
  Progress progress({.seconds = {}, .pieces = plan.evaluations, .of = "points"}, a.quiet);
#include "sixstep/analysis/verify/robust.hpp"
  return batch::optimise({.plan = plan.scenarios->plan(),
#include "sixstep/analysis/verify/robust.hpp"
                          .columns = plan.columns,
#include "sixstep/analysis/verify/robust.hpp"
                          .figure = figure,
#include "sixstep/analysis/verify/robust.hpp"
                          .evaluations = plan.evaluations,
#include "sixstep/analysis/verify/robust.hpp"
                          .scenario = [&](const std::vector<std::string>& point,
#include "sixstep/analysis/verify/robust.hpp"
                                          std::size_t drive) { return plan.scenarios->run(point, drive); },
#include "sixstep/analysis/verify/robust.hpp"
                          .known = [&](std::size_t number) -> std::optional<analysis::RunRecord> {
#include "sixstep/analysis/verify/robust.hpp"
                            const auto known = before.find(number);
#include "sixstep/analysis/verify/robust.hpp"
                            return known == before.end() ? std::nullopt : std::optional(known->second);
#include "sixstep/analysis/verify/robust.hpp"
                          },
#include "sixstep/analysis/verify/robust.hpp"
                          .take = [&](analysis::RunRecord&& record) { store.add(std::move(record)); },
#include "sixstep/analysis/verify/robust.hpp"
                          .progress = [&](std::size_t done) { progress.pieces_done(done); },
#include "sixstep/analysis/verify/robust.hpp"
                          .stop = watch.token(),
#include "sixstep/analysis/verify/robust.hpp"
                          .jobs = a.jobs});
#include "sixstep/analysis/verify/robust.hpp"
}
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
base::Problems write(OptimumFiles& outputs, const ReadPlan& plan, const analysis::Optimum& best,
#include "sixstep/analysis/verify/robust.hpp"
                     const std::string& json) {
#include "sixstep/analysis/verify/robust.hpp"
  base::Problems unwritten;
#include "sixstep/analysis/verify/robust.hpp"
  const auto commit = [&](std::optional<files::AtomicFile>& file, const std::string& text) {
#include "sixstep/analysis/verify/robust.hpp"
    if (!file) return;
#include "sixstep/analysis/verify/robust.hpp"
    file->write(text);
#include "sixstep/analysis/verify/robust.hpp"
    const base::Problems wrong = file->commit();
#include "sixstep/analysis/verify/robust.hpp"
    unwritten.insert(unwritten.end(), wrong.begin(), wrong.end());
#include "sixstep/analysis/verify/robust.hpp"
  };
#include "sixstep/analysis/verify/robust.hpp"
  const base::Result<study::Scenario> there = plan.scenarios->at(best.point);
#include "sixstep/analysis/verify/robust.hpp"
  if (there) commit(outputs.toml, files::with_own_mark(plan.origin.command, text::scenario_text(*there)));
#include "sixstep/analysis/verify/robust.hpp"
  commit(outputs.json, json);
#include "sixstep/analysis/verify/robust.hpp"
  return unwritten;
#include "sixstep/analysis/verify/robust.hpp"
}
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
}  // namespace
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
Exit optimise_command(const OptimiseArguments& a) {
#include "sixstep/analysis/verify/robust.hpp"
  RunArguments as_run;
#include "sixstep/analysis/verify/robust.hpp"
  as_run.files = {a.plan};
#include "sixstep/analysis/verify/robust.hpp"
  as_run.data_dir = a.data_dir;
#include "sixstep/analysis/verify/robust.hpp"
  as_run.command = a.command;
#include "sixstep/analysis/verify/robust.hpp"
  as_run.paths.force = a.force;
#include "sixstep/analysis/verify/robust.hpp"
  as_run.plan.store = a.store;
#include "sixstep/analysis/verify/robust.hpp"
  as_run.plan.resume = a.resume;
#include "sixstep/analysis/verify/robust.hpp"
  const base::Result<ReadPlan> plan = read_plan(a.plan, as_run);
#include "sixstep/analysis/verify/robust.hpp"
  if (!plan) return refused(plan.problems());
#include "sixstep/analysis/verify/robust.hpp"
  const base::Result<std::size_t> figure = figure_of(a, *plan);
#include "sixstep/analysis/verify/robust.hpp"
  if (!figure) return refused(figure.problems());
#include "sixstep/analysis/verify/robust.hpp"
  if (const base::Problems problems = not_to_be_chosen(a, plan->scenarios->plan()); !problems.empty())
#include "sixstep/analysis/verify/robust.hpp"
    return refused(problems);
#include "sixstep/analysis/verify/robust.hpp"
  if (const base::Problems problems = batch::missing_optimiser(); !problems.empty()) return refused(problems);
#include "sixstep/analysis/verify/robust.hpp"
  catch_interrupts();
#include "sixstep/analysis/verify/robust.hpp"
  OptimumFiles outputs;
#include "sixstep/analysis/verify/robust.hpp"
  if (const base::Problems problems = outputs.open(a); !problems.empty()) return refused(problems);
#include "sixstep/analysis/verify/robust.hpp"
  base::Result<files::PlanStore> store =
#include "sixstep/analysis/verify/robust.hpp"
      store_of(as_run, *plan, text::plan_identity(plan->scenarios->plan()) + " minimise " + plan->minimise);
#include "sixstep/analysis/verify/robust.hpp"
  if (!store) return refused(store.problems());
#include "sixstep/analysis/verify/robust.hpp"
  const std::optional<analysis::Optimum> best = search(a, *plan, *figure, *store);
#include "sixstep/analysis/verify/robust.hpp"
  if (const base::Problems unwritten = store->finish(); !unwritten.empty()) return refused(unwritten);
#include "sixstep/analysis/verify/robust.hpp"
  if (interrupted()) return told_interrupted("the search", kept_in(a.store));
#include "sixstep/analysis/verify/robust.hpp"
  if (!best)
#include "sixstep/analysis/verify/robust.hpp"
    return refused({{a.plan + ":", "", "has no point that can be run",
#include "sixstep/analysis/verify/robust.hpp"
                     "find the reason with: sixstep run PLAN --only 0"}});
#include "sixstep/analysis/verify/robust.hpp"
  const text::OptimumStory story{plan->name, plan->scenarios->plan(), *plan->columns, *figure};
#include "sixstep/analysis/verify/robust.hpp"
  const std::string json = text::optimum_json(story, *best);
#include "sixstep/analysis/verify/robust.hpp"
  if (const base::Problems unwritten = write(outputs, *plan, *best, json); !unwritten.empty())
#include "sixstep/analysis/verify/robust.hpp"
    return refused(unwritten);
#include "sixstep/analysis/verify/robust.hpp"
  if (a.json == "-") print(json);
#include "sixstep/analysis/verify/robust.hpp"
  const std::string drawn = text::drawn_text(
#include "sixstep/analysis/verify/robust.hpp"
      text::drive_spreads(plan->nominal, *plan->columns),
#include "sixstep/analysis/verify/robust.hpp"
      plan->scenarios->made_of().sheet_tolerances ? analysis::tolerances_not_drawn(plan->nominal) : "");
#include "sixstep/analysis/verify/robust.hpp"
  if (!a.quiet) print(drawn + text::optimum_text(story, *best), a.json == "-" ? stderr : stdout);
#include "sixstep/analysis/verify/robust.hpp"
  return best->holds ? Exit::ok : Exit::failed;
#include "sixstep/analysis/verify/robust.hpp"
}
#include "sixstep/analysis/verify/robust.hpp"

#include "sixstep/analysis/verify/robust.hpp"
}  // namespace cli

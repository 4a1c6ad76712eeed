// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "batch/plan_runs.hpp"
#include "faces/cli/plan_foretold.hpp"
#include "faces/cli/plan_outputs.hpp"
#include "faces/cli/plan_ranks.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/terminal.hpp"
#include "text/plan/plan_file.hpp"
#include "text/results/junit.hpp"
#include "text/results/plan_text.hpp"

namespace cli {
namespace {

Exit exit_of(const analysis::Series& series) {
  Exit exit = series.passed == series.runs ? Exit::ok : Exit::failed;
  if (!series.refused.empty()) exit = graver(exit, Exit::bad_input);
  if (!series.faults.empty()) exit = graver(exit, Exit::fault);
  return exit;
}

batch::PlanRuns runs_of(const RunArguments& a, const ReadPlan& plan, files::PlanStore& store) {
  return {.plan = plan.scenarios->plan(),
          .columns = plan.columns,
          .scenario = [&plan](std::size_t n) { return plan.scenarios->run(n); },
          .wanted = [&store](std::size_t n) { return !store.has(n); },
          .take = [&store](analysis::RunRecord&& record) { store.add(std::move(record)); },
          .stop = {},
          .jobs = a.jobs};
}

/// Whether this program still makes of a stored run what it made of it then.
base::Problems same_program(const batch::PlanRuns& runs, files::PlanStore& store) {
  std::optional<analysis::RunRecord> before;
  base::Problems problems = store.each([&](const analysis::RunRecord& record) {
    if (!before && record.end != analysis::RunEnd::refused) before = record;
  });
  if (!problems.empty() || !before) return problems;
  const std::optional<analysis::RunRecord> now = batch::run_one(runs, before->number);
  if (!now || now->digest == before->digest) return {};
  return {{.where = store.path() + ":",
           .limit = fmt::format("was begun by another version of sixstep: run {} has other bits now",
                                before->number),
           .cure = "finish it with that version, or begin anew with --force"}};
}

struct Told {
  Exit exit = Exit::ok;
  base::Problems problems;
  text::JunitSuite verdicts;
};

Told tell(const RunArguments& a, const ReadPlan& plan, files::PlanStore& store, PlanOutputs& outputs) {
  Told told;
  const analysis::Plan& p = plan.scenarios->plan();
  analysis::Series series = analysis::series_of(plan.columns);
  const auto each = [&](const std::function<void(const analysis::RunRecord&)>& visit) {
    const base::Problems unread = store.each([&](const analysis::RunRecord& record) {
      if (record.number >= analysis::runs_of(p)) return;  // of a sitting that wanted more
      analysis::RunRecord whole = record;
      whole.point = analysis::point_of_run(p, record.number);
      visit(whole);
    });
    told.problems.insert(told.problems.end(), unread.begin(), unread.end());
  };
  each([&](const analysis::RunRecord& record) { analysis::add(series, record); });
  const text::PlanStory story{plan.name, p, plan.columns, plan.units, series, each};
  if (!a.quiet && told.problems.empty()) print(text::plan_table(story), a.paths.prints() ? stderr : stdout);
  const base::Problems unwritten = outputs.publish(story, plan, !interrupted());
  told.problems.insert(told.problems.end(), unwritten.begin(), unwritten.end());
  told.exit = exit_of(series);
  told.verdicts = text::junit_suite(plan.name, series);
  return told;
}

Exit run_plan(const RunArguments& a, const ReadPlan& plan, std::vector<text::JunitSuite>& suites) {
  PlanOutputs outputs;
  if (const base::Problems problems = outputs.open(a, plan); !problems.empty()) return refused(problems);
  base::Result<files::PlanStore> store = store_of(a, plan, text::plan_identity(plan.scenarios->plan()));
  if (!store) return refused(store.problems());
  batch::PlanRuns runs = runs_of(a, plan, *store);
  if (const base::Problems problems = same_program(runs, *store); !problems.empty()) return refused(problems);
  {
    const StoreWatch watch(*store);
    runs.stop = watch.token();
    Progress progress({.seconds = {},
                       .pieces = analysis::runs_of(runs.plan),
                       .of = runs.plan.axes.empty() ? "drives" : "runs",
                       .before = store->rows()},
                      a.quiet);
    runs.take = [&](analysis::RunRecord&& record) {
      store->add(std::move(record));
      progress.pieces_done(store->rows());
    };
    make(runs, plan);
  }
  if (const base::Problems unwritten = store->finish(); !unwritten.empty()) return refused(unwritten);
  const Told told = tell(a, plan, *store, outputs);
  complain(told.problems);
  suites.push_back(told.verdicts);
  if (interrupted()) return exit_of_interrupt();
  return told.problems.empty() ? told.exit : graver(told.exit, Exit::bad_input);
}

Exit run_plans(const RunArguments& a, const std::vector<ReadPlan>& plans,
               std::optional<files::AtomicFile>& junit) {
  Exit exit = Exit::ok;
  std::vector<text::JunitSuite> suites;
  for (const ReadPlan& plan : plans) {
    exit = graver(exit, a.plan.dry_run ? foretell(a, plan) : run_plan(a, plan, suites));
    if (interrupted()) break;
  }
  if (!junit) return exit;
  junit->write(text::junit_xml(suites));
  const base::Problems unwritten = interrupted() ? junit->commit_partial() : junit->commit();
  complain(unwritten);
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

base::Problems contradictions(const RunArguments& a) {
  base::Problems problems;
  if (a.plan.resume && a.plan.store.empty() && a.out.empty())
    problems.push_back({.where = "--resume",
                        .limit = "goes on with the runs of a store, and none is named",
                        .cure = "add --store FILE.sqlite, or --out DIR as it was"});
  if (a.files.size() > 1 && (!a.plan.store.empty() || (a.paths.any() && a.out.empty())))
    problems.push_back({.where = a.plan.store.empty() ? all_options() : "--store",
                        .limit = "name the outputs of one plan",
                        .cure = "run the files one by one, or with --out DIR"});
  return problems;
}

}  // namespace

Exit plan_command(const RunArguments& arguments) {
  if (const base::Problems problems = contradictions(arguments); !problems.empty()) return refused(problems);
  if (!arguments.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(arguments.out, error);
    if (error)
      return refused({{.where = arguments.out + ":",
                       .limit = fmt::format("cannot be made a folder: {}", error.message()),
                       .cure = "choose another --out"}});
  }
  std::vector<ReadPlan> read;
  base::Problems problems;
  for (const std::string& file : arguments.files) {
    base::Result<ReadPlan> plan = read_plan(file, arguments);
    if (plan)
      read.push_back(std::move(*plan));
    else
      problems.insert(problems.end(), plan.problems().begin(), plan.problems().end());
  }
  if (!problems.empty()) return refused(problems);
  std::optional<files::AtomicFile> junit;
  if (!arguments.junit.empty() && !arguments.plan.dry_run) {
    base::Result<files::AtomicFile> file =
        files::AtomicFile::create({arguments.junit, arguments.paths.force});
    if (!file) return refused(file.problems());
    junit.emplace(std::move(*file));
  }
  return run_plans(arguments, read, junit);
}

}  // namespace cli

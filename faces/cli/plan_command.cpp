// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "batch/plan_runs.hpp"
#include "faces/cli/compare_command.hpp"
#include "faces/cli/plan_estimate.hpp"
#include "faces/cli/plan_outputs.hpp"
#include "faces/cli/plan_ranks.hpp"
#include "faces/cli/plan_reports.hpp"
#include "faces/cli/plan_stopped.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/stop_watch.hpp"
#include "faces/cli/terminal.hpp"
#include "files/controller_watch.hpp"
#include "sixstep/analysis/verify/robust.hpp"
#include "text/escape/escape.hpp"
#include "text/plan/plan_file.hpp"
#include "text/results/junit.hpp"
#include "text/results/plan_text.hpp"
#include "text/results/series_table.hpp"

namespace cli {
namespace {

Exit exit_of_series(const analysis::Series& series) {
  Exit exit = series.passed == series.runs ? Exit::ok : Exit::failed;
  if (!series.refused.empty()) exit = graver(exit, Exit::bad_input);
  if (!series.faults.empty()) exit = graver(exit, Exit::fault);
  return exit;
}

batch::PlanRuns runs_of(const RunArguments& a, const ReadPlan& plan, files::PlanStore& store) {
  return {.plan = plan.scenarios->plan(),
          .columns = plan.columns,
          .scenario =
              [&plan](std::size_t n) {
                files::controllers_make_run(n);
                return plan.scenarios->run(n);
              },
          .wanted = [&store](std::size_t n) { return !store.has(n); },
          .take = [&store](analysis::RunRecord&& record) { store.add(std::move(record)); },
          .stop = {},
          .jobs = a.jobs};
}

/// Repeats one stored run. Returns problems if this program computes other values than the stored row.
base::Problems same_program(const batch::PlanRuns& runs, files::PlanStore& store) {
  std::optional<analysis::RunRecord> before;
  base::Problems problems = store.each([&](const analysis::RunRecord& record) {
    if (!before && record->digest != 0) before = record;
  });
  if (!problems.empty() || !before) return problems;
  const std::optional<analysis::RunRecord> now = batch::run_one(runs, (*before)->number);
  if (!now || (*now)->digest == (*before)->digest) return {};
  return {{.where = store.path() + ":",
           .limit = fmt::format("was begun by another version of sixstep, and run {} now has another result",
                                (*before)->number),
           .cure = "finish the runs with that version, or start again with --force"}};
}

/// A plan with complete runs: the rows of its store and the results. The object must not move.
class MadePlan {
 public:
  MadePlan(const ReadPlan& plan, files::PlanStore store)
      : plan_(plan), store_(std::move(store)), series_(analysis::series_of(*plan.columns)) {
    each([&](const analysis::RunRecord& record) { analysis::add(series_, record); });
    const std::size_t wanted = analysis::runs_of(plan.scenarios->plan());
    if (problems_.empty() && series_.runs < wanted && !interrupted())
      problems_.push_back(
          {store_.path() + ":", "",
           fmt::format("contains only {} of the {} runs that were stored", series_.runs, wanted),
           "start again with --force"});
  }
  MadePlan(const MadePlan&) = delete;
  MadePlan& operator=(const MadePlan&) = delete;

  const text::PlanStory& story() const { return story_; }
  /// The reasons why some rows could not be read.
  const base::Problems& problems() const { return problems_; }
  /// A message about runs in the store that are not part of the plan; empty if there are none.
  std::string beyond() const {
    if (beyond_ == 0) return "";
    return fmt::format(
        "{}: contains {} more run{} than the {} of this plan; request more runs to include these runs\n",
        text::visible(store_.path()), beyond_, beyond_ == 1 ? "" : "s",
        analysis::runs_of(plan_.scenarios->plan()));
  }
  Exit exit() const { return exit_of_series(series_); }
  /// The number of stopped or refused runs, and the reason for the first such run.
  std::string stopped() const {
    const std::string lines = text::stopped_text(series_, plan_.scenarios->plan());
    return lines.empty() ? "" : text::visible(plan_.name) + ":\n" + lines;
  }
  /// Whether runs of the plan are missing; the table states this as well.
  bool cut_short() const { return series_.runs < analysis::runs_of(plan_.scenarios->plan()); }
  text::JunitSuite verdicts() const { return text::junit_suite(plan_.name, series_); }

 private:
  /// Visits the rows of the requested plan, each with its point in the plan.
  void each(const std::function<void(const analysis::RunRecord&)>& visit) {
    const analysis::Plan& p = plan_.scenarios->plan();
    beyond_ = 0;
    const base::Problems unread = store_.each([&](const analysis::RunRecord& record) {
      // The row belongs to an earlier call with more runs.
      if (record->number >= analysis::runs_of(p)) return void(++beyond_);
      analysis::RunValues values = *record;
      values.point = analysis::point_of_run(p, record->number);
      if (const auto whole = analysis::RunRecord::of(plan_.columns, std::move(values)))
        visit(*whole);
      else
        append(problems_, whole.problems());
    });
    append(problems_, unread);
  }

  const ReadPlan& plan_;
  files::PlanStore store_;
  analysis::Series series_;
  base::Problems problems_;
  std::size_t beyond_ = 0;
  text::PlanStory story_{
      plan_.name,
      plan_.scenarios->plan(),
      *plan_.columns,
      series_,
      [this](const auto& visit) { each(visit); },
      text::drive_spreads(plan_.nominal, *plan_.columns),
      plan_.scenarios->made_of().sheet_tolerances ? analysis::tolerances_not_drawn(plan_.nominal) : ""};
};

/// Makes the runs that are not in the store, until all are made or the program is interrupted.
base::Result<files::PlanStore> make_runs(const RunArguments& a, const ReadPlan& plan) {
  base::Result<files::PlanStore> store = store_of(a, plan, text::plan_identity(plan.scenarios->plan()));
  if (!store) return store;
  batch::PlanRuns runs = runs_of(a, plan, *store);
  note_stopped_runs(*store, a.plan.resume);
  if (const base::Problems problems = same_program(runs, *store); !problems.empty()) return problems;
  {
    const StopWatch watch([&store] { return store->failed(); });
    runs.stop = watch.token();
    runs.wanted = [&store, stopped = take_stopped_runs(plan, *store)](std::size_t n) {
      return !store->has(n) && !stopped.contains(n);
    };
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
  if (const base::Problems unwritten = store->finish(); !unwritten.empty()) return unwritten;
  if (!interrupted()) forget_stopped_runs(*store);
  return store;
}

/// Prints the table; with --quiet, only the runs that stopped or could not start.
void tell(const RunArguments& a, const MadePlan& made) {
  if (a.quiet) return print(made.stopped(), stderr);
  print(text::plan_table(made.story()), a.paths.prints() ? stderr : stdout);
  if (made.cut_short()) stop_is_told();
}

/// Also adds the problems to the verdicts for build servers, because a suite without cases would count as
/// successful.
Exit refused_plan(const std::string& name, const base::Problems& problems,
                  std::vector<text::JunitSuite>& suites) {
  suites.push_back(text::junit_suite(name, problems));
  return refused(problems);
}

Exit run_plan(const RunArguments& a, const ReadPlan& plan, std::vector<text::JunitSuite>& suites) {
  PlanOutputs outputs;
  if (const base::Problems problems = outputs.open(a, plan); !problems.empty())
    return refused_plan(plan.name, problems, suites);
  base::Result<files::PlanStore> store = make_runs(a, plan);
  if (!store) return refused_plan(plan.name, store.problems(), suites);
  const MadePlan made(plan, std::move(*store));
  if (made.problems().empty()) tell(a, made);
  if (!a.quiet) print(made.beyond(), stderr);
  base::Problems problems = outputs.publish(made.story(), plan, !interrupted());
  append(problems, made.problems());
  complain(problems);
  suites.push_back(problems.empty() ? made.verdicts() : text::junit_suite(plan.name, problems));
  if (interrupted()) {
    const std::string left = left_behind(outputs.partial_files(), store_path(a, plan.name));
    if (!left.empty()) tell_stop(text::visible(plan.name) + ": interrupted; " + left);
    return exit_of_interrupt();
  }
  return problems.empty() ? made.exit() : graver(made.exit(), Exit::bad_input);
}

/// Draws two plans on one page.
Exit compare_plans(const RunArguments& a, const std::vector<ReadPlan>& plans,
                   std::vector<text::JunitSuite>& suites) {
  base::Result<files::AtomicFile> file = files::AtomicFile::create({a.paths.of(page_option), a.paths.force});
  if (!file) return refused_plan(a.paths.of(page_option), file.problems(), suites);
  std::vector<std::unique_ptr<MadePlan>> made;
  std::vector<report::PagePlan> pages;
  base::Problems problems;
  Exit exit = Exit::ok;
  for (const ReadPlan& plan : plans) {
    base::Result<files::PlanStore> store = make_runs(a, plan);
    if (!store) return refused_plan(plan.name, store.problems(), suites);
    if (interrupted()) return told_interrupted("the comparison");
    const MadePlan& one = *made.emplace_back(std::make_unique<MadePlan>(plan, std::move(*store)));
    exit = graver(exit, one.exit());
    suites.push_back(one.verdicts());
    tell(a, one);
    if (!a.quiet) print(one.beyond(), stderr);
    pages.push_back(page_of(a, plan, one.story(), {}));
  }
  file->write(plan_page(pages, a.command));
  for (const auto& one : made) append(problems, one->problems());
  const base::Problems unwritten = problems.empty() ? file->commit() : problems;
  complain(unwritten);
  if (!unwritten.empty()) suites.push_back(text::junit_suite(a.paths.of(page_option), unwritten));
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

Exit run_plans(const RunArguments& a, const std::vector<ReadPlan>& plans,
               std::optional<files::AtomicFile>& junit) {
  Exit exit = Exit::ok;
  std::vector<text::JunitSuite> suites;
  const bool on_one_page = compares(a) && !a.plan.dry_run;
  if (on_one_page) exit = compare_plans(a, plans, suites);
  for (const ReadPlan& plan : plans) {
    if (on_one_page || (interrupted() && !suites.empty())) break;
    exit = graver(exit, a.plan.dry_run ? estimate(a, plan) : run_plan(a, plan, suites));
  }
  if (!junit) return exit;
  junit->write(text::junit_xml(suites));
  const base::Problems unwritten = interrupted() ? junit->commit_partial() : junit->commit();
  complain(unwritten);
  // A path that is not a regular file, such as a pipe, has no partial name.
  const std::string partial = files::partial_name(junit->path());
  if (interrupted() && unwritten.empty() && std::filesystem::exists(partial))
    tell_stop("the verdicts of the finished runs are in " + text::visible(partial));
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

base::Problems plan_contradictions(const RunArguments& a) {
  base::Problems problems;
  if (a.plan.resume && a.plan.store.empty() && a.out.empty())
    problems.push_back({.where = "--resume",
                        .limit = "continues the runs of a store, but no store is named",
                        .cure = "add --store FILE.sqlite, or the earlier --out DIR"});
  if (a.watch)
    problems.push_back({.where = "--watch",
                        .limit = "repeats one scenario, and this is a plan of many runs",
                        .cure = "leave --watch out, or watch one run with --only N"});
  const bool both = compares(a);
  if (both && a.files.size() > report::most_plans_on_a_page)
    problems.push_back({.where = "--html",
                        .value = fmt::format("{} plans", a.files.size()),
                        .limit = fmt::format("must be at most {} on one page", report::most_plans_on_a_page),
                        .cure = "name two plans, or write a page for each plan with --out DIR"});
  if (a.files.size() > 1 && (!a.plan.store.empty() || (a.paths.any() && a.out.empty() && !both)))
    problems.push_back({.where = a.plan.store.empty() ? all_options() : "--store",
                        .limit = "apply to one plan only",
                        .cure = "run the plans one by one, or use --out DIR"});
  return problems;
}

}  // namespace

Exit plan_command(const RunArguments& arguments) {
  if (const base::Problems problems = plan_contradictions(arguments); !problems.empty())
    return refused(problems);
  if (!arguments.out.empty())
    if (const base::Problems unmade = make_folder(arguments.out); !unmade.empty()) return refused(unmade);
  std::vector<ReadPlan> read;
  base::Problems problems;
  for (const std::string& file : arguments.files) {
    base::Result<ReadPlan> plan = read_plan(file, arguments);
    if (plan)
      read.push_back(std::move(*plan));
    else
      append(problems, plan.problems());
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

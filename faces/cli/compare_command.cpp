// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "batch/for_each.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/run_command.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/loop/cores.hpp"
#include "faces/loop/on_core.hpp"
#include "files/atomic_file.hpp"
#include "report/comparison.hpp"
#include "report/kept_rows.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/results/verdict_table.hpp"

namespace cli {
namespace {

study::Trace all_columns() {
  study::Trace trace{.columns = study::all_columns(), .values = {}};
  trace.values.resize(trace.columns.size());
  return trace;
}

/// Under the turning motor's names, whatever the motor: what is drawn and what is subtracted are one.
void add(study::Trace& trace, study::Row row, const std::vector<study::Column>& columns) {
  for (std::size_t n = 0; n < row.size(); ++n) trace.values[n].push_back(row[n] / columns[n].per_turning);
}

/// A run that keeps what is drawn and what is subtracted.
struct Compared {
  study::Scenario scenario;
  const loop::Core* core = nullptr;
  std::size_t most_bytes = report::most_row_bytes;  ///< of events
  study::Trace grid = all_columns();
  std::optional<report::KeptRows> events;
  std::optional<study::Outcome> outcome;
  base::Problems problems;

  void run(const std::function<void(double t_s)>& reached) {
    study::Listeners listeners;
    events.emplace(scenario, most_bytes);
    listeners.on_event = [this](study::Row row) { events->add(row); };
    listeners.on_record = [this](study::Row row) { add(grid, row, study::all_columns(scenario.sheet.kind)); };
    listeners.keep_going = [&reached](double t_s) {
      reached(t_s);
      return !interrupted();
    };
    base::Result<study::Outcome> result = loop::run(core, scenario, listeners);
    if (result)
      outcome = std::move(*result);
    else
      problems = result.problems();
  }
};

/// The same instants for all, every column: what a scenario records for itself is of no use here.
std::vector<Compared> on_one_grid(const std::vector<Job>& jobs) {
  std::vector<const study::Scenario*> scenarios;
  std::vector<Compared> runs;
  scenarios.reserve(jobs.size());
  runs.reserve(jobs.size());
  for (const Job& job : jobs) scenarios.push_back(&job.scenario());
  for (const Job& job : jobs) {
    Compared& run = runs.emplace_back(Compared{
        .scenario = job.scenario(), .core = job.core(), .most_bytes = report::most_row_bytes / jobs.size()});
    run.scenario.record = {.grid_s = report::common_grid_s(scenarios)};
    // A column that a mode has no use for is asked for all the same, so that all runs have the same ones.
    for (const study::Column& column : study::all_columns(run.scenario.sheet.kind))
      run.scenario.record.columns.push_back(column.name);
  }
  return runs;
}

void print_table(const std::vector<Job>& jobs, const std::vector<Compared>& runs) {
  std::vector<text::TableEntry> entries;
  for (std::size_t n = 0; n < runs.size(); ++n) entries.push_back({jobs[n].name(), &*runs[n].outcome});
  print(text::verdict_table(entries, may_colour(stdout)) +
        text::verdict_summary(entries, may_colour(stdout)));
}

}  // namespace

bool names_own_firmware(const RunArguments& a) {
  return a.on.size() > 5 && a.on.compare(a.on.size() - 5, 5, ".toml") == 0;
}

bool lays_over(const RunArguments& a) {
  if (names_own_firmware(a)) return a.files.size() == 1;
  const std::span<const loop::Core> known = loop::cores();
  return a.files.size() == 1 && std::any_of(known.begin(), known.end(), [&a](const loop::Core& core) {
           return core.by_registers && core.name == a.on;
         });
}

bool compares(const RunArguments& a) {
  return (a.files.size() > 1 || lays_over(a)) && !a.paths.of(page_option).empty() &&
         a.paths.files().size() == 1 && !a.paths.prints() && a.out.empty();
}

base::Problems check_comparison(const RunArguments& arguments) {
  if (arguments.files.size() <= report::most_compared) return {};
  return {{.where = "--html",
           .value = fmt::format("{} files", arguments.files.size()),
           .limit = fmt::format("is more than the {} that one page can tell apart", report::most_compared),
           .cure = "compare fewer, or write one report each with --out DIR"}};
}

Exit compare_command(const RunArguments& arguments, const std::vector<Job>& jobs) {
  base::Result<files::AtomicFile> file =
      files::AtomicFile::create({arguments.paths.of(page_option), arguments.paths.force});
  if (!file) return refused(file.problems());
  std::vector<Compared> runs = on_one_grid(jobs);
  {
    Work work;
    for (const Compared& run : runs) work.seconds.push_back(run.scenario.duration_s);
    Progress progress(std::move(work), arguments.quiet);
    batch::for_each(runs.size(), arguments.jobs, [&](std::size_t n) {
      runs[n].run([&progress, n](double t_s) { progress.reached(n, t_s); });
      progress.finished(n);
    });
  }
  if (interrupted()) return told_interrupted("the comparison");
  Exit exit = Exit::ok;
  std::vector<ComparedSource> sources;
  for (std::size_t n = 0; n < runs.size(); ++n) {
    complain(runs[n].problems);
    exit = graver(exit, runs[n].outcome ? exit_of(*runs[n].outcome) : Exit::bad_input);
    if (runs[n].outcome)
      sources.push_back(
          {jobs[n].name(), runs[n].scenario, *runs[n].outcome, runs[n].events->trace(), runs[n].grid});
  }
  if (sources.size() < runs.size()) return exit;
  for (const ComparedSource& source : sources)
    if (const std::string told = report::rows_told(source.events); !told.empty() && !arguments.quiet)
      print(fmt::format("{}: {}\n", source.name, told), stderr);
  file->write(comparison_page(sources, arguments.command));
  const base::Problems unwritten = file->commit();
  complain(unwritten);
  if (!arguments.quiet) print_table(jobs, runs);
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

}  // namespace cli

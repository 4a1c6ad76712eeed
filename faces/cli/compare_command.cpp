// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>

#include "batch/for_each.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/run_command.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/loop/cores.hpp"
#include "faces/loop/on_core.hpp"
#include "files/atomic_file.hpp"
#include "files/text_file.hpp"
#include "report/comparison.hpp"
#include "report/kept_rows.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/escape/escape.hpp"
#include "text/recording/board_log.hpp"
#include "text/results/trace_comparison_text.hpp"
#include "text/results/verdict_table.hpp"

namespace cli {
namespace {

study::Trace all_columns() {
  study::Trace trace{.columns = study::all_columns(), .values = {}};
  trace.values.resize(trace.columns.size());
  return trace;
}

/// Stores a row in the units of a rotary motor, because the page reads the same columns for every motor.
void add(study::Trace& trace, study::Row row, const std::vector<study::Column>& columns) {
  for (std::size_t n = 0; n < row.size(); ++n) trace.values[n].push_back(row[n] / columns[n].per_turning);
}

/// A run with two sets of rows: every event for drawing, and a common grid for subtraction.
struct Compared {
  study::Scenario scenario;
  const loop::Core* core = nullptr;
  std::size_t most_bytes = report::most_row_bytes;  ///< limit of the memory for events, bytes
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

/// Runs all jobs on the same instants with every column, independent of the scenario's [record].
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
    // Columns that have no meaning in a mode are included, so that all runs have the same columns.
    for (const study::Column& column : study::all_columns(run.scenario.sheet.kind))
      run.scenario.record.columns.push_back(column.name);
  }
  return runs;
}

/// A board's log, and its comparison with the run.
struct Log {
  std::string name;
  std::optional<double> shift_s;  ///< requested shift; empty: fitted
  text::BoardLog read;
  study::Trace grid;
  LogFound found;
};

/// In problems, replaces the library's member by its option.
base::Problems of_options(base::Problems problems) {
  for (base::Problem& p : problems)
    if (p.where == "columns" || p.where == "esc") p.where.insert(0, "--");
  return problems;
}

base::Result<std::optional<Log>> read_log(const LogArguments& asked, const study::Scenario& scenario) {
  if (asked.path.empty()) return std::optional<Log>();
  const base::Range interval = base::allowed(base::above(0.0), "s");
  if (asked.interval_s && !interval.holds(*asked.interval_s))
    return base::Problem{"--interval", base::written(*asked.interval_s), base::limit_of(interval),
                         "give the time from one row to the next in seconds"};
  const base::Result<std::string> text = files::read_text(asked.path);
  if (!text) return text.problems();
  base::Result<text::BoardLog> read =
      text::read_board_log(asked.path, *text,
                           {.formulas = asked.columns,
                            .interval_s = asked.interval_s,
                            .pole_pairs = design::sheet_constants(scenario.sheet).pole_pairs,
                            .field_oriented = scenario.control.drive == study::FirmwareKind::field,
                            .esc = asked.esc});
  if (!read) return of_options(read.problems());
  return std::optional(Log{.name = std::filesystem::path(asked.path).filename().string(),
                           .shift_s = asked.shift_s,
                           .read = std::move(*read),
                           .grid = {},
                           .found = {}});
}

/// Shifts the log's times to the run's, because a board's clock starts after the board's set-up. The shift is
/// fitted over all columns within twenty PWM periods, in steps of a twentieth of a period; --shift replaces
/// the fit. Problems: almost no row of the log is in the simulated time.
base::Problems lay_over(Log& log, const Compared& run) {
  const study::Trace simulated = run.events->trace();
  study::Trace& trace = log.read.trace;
  if (const double start_s = analysis::start_shift_s(simulated, trace); start_s != 0.0) {
    log.read.notes.push_back(fmt::format(
        "the log's clock starts at {:.10g} s; times are counted from the log's first row. If that row is later than the run's start, give --shift",
        -start_s));
    for (double& t : trace.values.front()) t += start_s;
  }
  const double period_s = run.scenario.pwm.period_s;
  const double most_s = 20.0 * period_s, step_s = period_s / 20.0;
  log.found.shift_s = log.shift_s.value_or(analysis::best_shift_s(simulated, trace, most_s, step_s));
  if (!log.shift_s && std::fabs(log.found.shift_s) > most_s - 1.5 * step_s)
    log.read.notes.push_back(fmt::format(
        "no larger move than {:.4g} s, 20 PWM periods, was tried, and the best one is the largest: the clocks may differ by more; give --shift",
        most_s));
  base::Result<analysis::Overlay> overlay = analysis::overlay(log.name, simulated, trace, log.found.shift_s);
  if (!overlay) return overlay.problems();
  for (const auto& [column, reason] : overlay->left_out) log.read.not_used.push_back({column, reason});
  text::note_not_used(log.read.not_used, log.read.notes);
  if (overlay->inside < overlay->rows)
    log.read.notes.push_back(fmt::format("{} of {} rows are outside the simulated time",
                                         overlay->rows - overlay->inside, overlay->rows));
  log.found.columns = std::move(overlay->columns);
  log.grid = analysis::at_instants(trace, log.found.shift_s, run.grid.values.front());
  for (double& t : trace.values.front()) t += log.found.shift_s;
  return {};
}

/// Opens the page's file. Empty if no page is requested.
base::Result<std::optional<files::AtomicFile>> page_of_runs(const RunArguments& arguments) {
  const std::string& path = arguments.paths.of(page_option);
  if (path.empty()) return std::optional<files::AtomicFile>();
  base::Result<files::AtomicFile> file = files::AtomicFile::create({path, arguments.paths.force});
  if (!file) return file.problems();
  return std::optional(std::move(*file));
}

void print_table(const std::vector<Job>& jobs, const std::vector<Compared>& runs, bool quiet) {
  std::vector<text::TableEntry> entries;
  for (std::size_t n = 0; n < runs.size(); ++n) entries.push_back({jobs[n].name(), &*runs[n].outcome});
  if (quiet) return print(text::faults_text(entries), stderr);
  print(text::verdict_table(entries, may_colour(stdout)) +
        text::verdict_summary(entries, may_colour(stdout)));
}

}  // namespace

bool names_own_firmware(const RunArguments& a) {
  return a.on.size() > 5 && a.on.compare(a.on.size() - 5, 5, ".toml") == 0;
}

bool on_a_chip(const RunArguments& a) {
  const std::span<const loop::Core> known = loop::cores();
  return names_own_firmware(a) || std::any_of(known.begin(), known.end(), [&a](const loop::Core& core) {
           return core.by_registers && core.name == a.on;
         });
}

bool lays_over(const RunArguments& a) { return a.files.size() == 1 && a.log.path.empty() && on_a_chip(a); }

bool compares(const RunArguments& a) {
  if (!a.log.path.empty()) return true;
  return (a.files.size() > 1 || lays_over(a)) && !a.paths.of(page_option).empty() &&
         a.paths.files().size() == 1 && !a.paths.prints() && a.out.empty();
}

base::Problems check_comparison(const RunArguments& arguments) {
  const bool with_log = !arguments.log.path.empty();
  const bool page_alone =
      arguments.paths.files().size() == (arguments.paths.of(page_option).empty() ? 0 : 1) &&
      !arguments.paths.prints();
  if (with_log && (arguments.files.size() > 1 || !arguments.out.empty() || !page_alone))
    return {{.where = "--compare",
             .value = arguments.log.path,
             .limit = "can be compared with only one run",
             .cure = "name one scenario, and --html FILE as the only output"}};
  if (arguments.files.size() <= report::most_compared) return {};
  return {{.where = "--html",
           .value = fmt::format("{} files", arguments.files.size()),
           .limit = fmt::format("must be at most {}, the number of colours of a page", report::most_compared),
           .cure = "compare fewer scenarios, or write a report for each scenario with --out DIR"}};
}

Exit compare_command(const RunArguments& arguments, const std::vector<Job>& jobs) {
  base::Result<std::optional<files::AtomicFile>> file = page_of_runs(arguments);
  if (!file) return refused(file.problems());
  base::Result<std::optional<Log>> log = read_log(arguments.log, jobs.front().scenario());
  if (!log) return refused(log.problems());
  if (*log && !(*log)->read.recognised.empty() && !arguments.quiet)
    print(fmt::format("{} is {}\n", text::visible((*log)->name), (*log)->read.recognised), stderr);
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
          {jobs[n].name(), runs[n].scenario, &*runs[n].outcome, runs[n].events->trace(), runs[n].grid});
  }
  if (sources.size() < runs.size()) return exit;
  for (const ComparedSource& source : sources)
    if (const std::string told = report::rows_told(source.events); !told.empty() && !arguments.quiet)
      print(fmt::format("{}: {}\n", source.name, told), stderr);
  if (*log) {
    if (const base::Problems nothing = lay_over(**log, runs.front()); !nothing.empty())
      return graver(exit, refused(nothing));
    sources.push_back({(*log)->name, runs.front().scenario, nullptr, (*log)->read.trace, (*log)->grid});
  }
  base::Problems unwritten;
  if (*file) {
    (*file)->write(comparison_page(sources, *log ? (*log)->found : LogFound(), arguments.command));
    unwritten = (*file)->commit();
    complain(unwritten);
  }
  print_table(jobs, runs, arguments.quiet);
  if (*log && !arguments.quiet)
    print(text::trace_comparison_text((*log)->name, (*log)->found.columns, (*log)->found.shift_s,
                                      (*log)->read.notes));
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

}  // namespace cli

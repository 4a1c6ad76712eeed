// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/run_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "batch/for_each.hpp"
#include "faces/cli/bode_command.hpp"
#include "faces/cli/compare_command.hpp"
#include "faces/cli/file_watch.hpp"
#include "faces/cli/integer_in.hpp"
#include "faces/cli/plan_command.hpp"
#include "faces/cli/plan_reading.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/report_page.hpp"
#include "faces/cli/run_reading.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/store_option.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/loop/cores.hpp"
#include "files/atomic_file.hpp"
#include "text/escape/escape.hpp"
#include "text/results/junit.hpp"
#include "text/results/verdict_table.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

OutputPaths paths_of(const RunArguments& arguments, const Job& job) {
  if (arguments.out.empty()) return arguments.paths;
  OutputPaths paths;
  paths.force = arguments.paths.force;
  const std::string base = (fs::path(arguments.out) / job.name()).string();
  for (std::size_t n = 0; n < formats().size(); ++n)
    if (!formats()[n].in_folder.empty()) paths.of_formats[n] = base + std::string(formats()[n].in_folder);
  return paths;
}

/// Files that describe all runs. They are written last.
struct Lists {
  std::optional<files::AtomicFile> index, junit;
};

/// Opens all outputs before the first run. Opening the index proves that the folder is writable.
base::Problems prepare(const RunArguments& arguments, std::vector<Job>& jobs, Lists& lists) {
  base::Problems problems;
  if (!arguments.out.empty()) {
    if (base::Problems unmade = make_folder(arguments.out); !unmade.empty()) return unmade;
    base::Result<files::AtomicFile> file =
        files::AtomicFile::create({(fs::path(arguments.out) / "index.html").string(), arguments.paths.force});
    if (!file) return file.problems();
    lists.index.emplace(std::move(*file));
  }
  if (!arguments.junit.empty()) {
    base::Result<files::AtomicFile> file =
        files::AtomicFile::create({arguments.junit, arguments.paths.force});
    if (!file) return file.problems();
    lists.junit.emplace(std::move(*file));
  }
  for (Job& job : jobs) append(problems, job.prepare(paths_of(arguments, job)));
  return problems;
}

void run_all(std::vector<Job>& jobs, const RunArguments& arguments) {
  for (const Job& job : jobs)
    if (!arguments.quiet) print(job.foretold(), stderr);
  Work work;
  for (const Job& job : jobs) work.seconds.push_back(job.scenario().duration_s);
  Progress progress(std::move(work), arguments.quiet);
  batch::for_each(jobs.size(), arguments.jobs, [&](std::size_t n) {
    if (!interrupted()) jobs[n].run([&progress, n](double t_s) { progress.reached(n, t_s); });
    progress.finished(n);
  });
}

/// Writes the index of all runs. After an interrupt, writes an index of the finished runs under its partial
/// name and prints a message.
base::Problems write_index(const RunArguments& arguments, const std::vector<Job>& jobs,
                           files::AtomicFile& index) {
  std::vector<report::IndexEntry> entries;
  std::size_t finished = 0;
  for (const Job& job : jobs) {
    entries.push_back(
        {job.scenario().title, fs::path(job.page()).filename().string(), job.outcome(), job.finished()});
    finished += job.finished() ? 1 : 0;
  }
  index.write(report_index(entries, arguments.command));
  if (finished == jobs.size()) return index.commit();
  base::Problems unwritten = index.commit_partial();
  if (unwritten.empty())
    print(fmt::format("{} of {} experiments finished; {} lists them\n", finished, jobs.size(),
                      text::visible(files::partial_name(index.path()))),
          stderr);
  return unwritten;
}

void print_table(const std::vector<Job>& jobs, const RunArguments& arguments) {
  std::vector<text::TableEntry> entries;
  for (const Job& job : jobs)  // an interrupted run has no verdict yet
    if (job.finished()) entries.push_back({job.name(), job.outcome()});
  if (arguments.quiet) return print(text::faults_text(entries), stderr);
  std::FILE* to = arguments.paths.prints() ? stderr : stdout;  // standard output then contains only the
                                                               // requested format
  if (entries.empty()) return;
  std::string text = text::verdict_table(entries, may_colour(to));
  // The summary is omitted if runs were interrupted or never began.
  if (!interrupted() && entries.size() == jobs.size()) text += text::verdict_summary(entries, may_colour(to));
  print(text, to);
}

std::string verdicts_xml(const std::vector<Job>& jobs) {
  std::vector<text::JunitSuite> suites;
  suites.reserve(jobs.size());
  for (const Job& job : jobs)
    // A run whose output failed did not reach its end, even if it has results.
    suites.push_back(job.outcome() && job.problems().empty() ? text::junit_suite(job.name(), *job.outcome())
                                                             : text::junit_suite(job.name(), job.problems()));
  return text::junit_xml(suites);
}

/// Prints problems, interrupted runs and the table, and writes the index.
Exit tell(const std::vector<Job>& jobs, const RunArguments& arguments, Lists& lists) {
  Exit exit = interrupted() ? exit_of_interrupt() : Exit::ok;
  for (const Job& job : jobs) {
    if (!interrupted()) exit = graver(exit, job.exit_code());
    complain(job.problems());
    if (const std::string cut = job.cut_short(); !cut.empty()) {
      print(cut, stderr);
      if (interrupted()) stop_is_told();
    }
    if (!arguments.quiet) print(job.left_out(), stderr);
  }
  if (interrupted() && std::ranges::none_of(jobs, &Job::begun))
    tell_stop("interrupted before the first run began");
  print_table(jobs, arguments);
  base::Problems unwritten;
  if (lists.index) append(unwritten, write_index(arguments, jobs, *lists.index));
  if (lists.junit) {
    lists.junit->write(verdicts_xml(jobs));
    append(unwritten, interrupted() ? lists.junit->commit_partial() : lists.junit->commit());
  }
  complain(unwritten);
  return unwritten.empty() ? exit : graver(exit, Exit::bad_input);
}

Exit run_jobs(const RunArguments& arguments, JobsRead& read) {
  Lists lists;
  base::Problems problems = std::move(read.problems);
  if (problems.empty() && compares(arguments)) return compare_command(arguments, read.jobs);
  if (problems.empty()) problems = prepare(arguments, read.jobs, lists);
  if (!problems.empty()) return refused(problems);
  run_all(read.jobs, arguments);
  return tell(read.jobs, arguments, lists);
}

Exit run_again_on_save(const RunArguments& arguments) {
  for (;;) {
    JobsRead read = read_jobs(arguments);
    const FileWatch watch(read.files);
    const Exit exit = run_jobs(arguments, read);
    if (interrupted() || unheard()) return exit;
    if (!arguments.quiet) print("-- runs again when a file is saved; Ctrl-C ends\n", stderr);
    if (!watch.wait_for_a_change()) return ended_as_asked(exit);
  }
}

base::Problems one_at_a_time(const RunArguments& a) {
  const bool on_core = !a.on.empty();
  return {{.where = on_core ? "--on" : "--compare",
           .limit = fmt::format("{}, but this is a plan of many runs",
                                on_core ? "runs one scenario on a core" : "compares a log with one run"),
           .cure = "choose one run: --only N, or --drive N of a series"}};
}

Exit run_command(const RunArguments& arguments) {
  if (const base::Problems problems = contradictions(arguments); !problems.empty()) return refused(problems);
  catch_interrupts();
  if (arguments.bode) return bode_command(arguments);
  const bool alone = arguments.drive || arguments.plan.only;
  if (!alone &&
      std::ranges::any_of(arguments.files, [&](const std::string& f) { return plans(arguments, f); }))
    return arguments.on.empty() && arguments.log.path.empty() ? plan_command(arguments)
                                                              : refused(one_at_a_time(arguments));
  if (arguments.watch) return run_again_on_save(arguments);
  JobsRead read = read_jobs(arguments);
  return run_jobs(arguments, read);
}

/// The files in the folder of --out, as text: "NAME.csv, NAME.json, ..".
std::string names_in_folder() {
  std::string text;
  for (const Format& format : formats())
    if (!format.in_folder.empty())
      text += fmt::format("{}NAME{}", text.empty() ? "" : ", ", format.in_folder);
  return text;
}

std::vector<std::string_view> core_names() {
  std::vector<std::string_view> names;
  for (const loop::Core& core : loop::cores()) names.push_back(core.name);
  return names;
}

void declare_plan_options(CLI::App& run, PlanArguments& a) {
  run.add_option("--vary", a.vary, "KEY=FROM:TO:POINTS, or KEY=VALUE,VALUE; several options make a grid");
  run.add_option("--sampling", a.sampling,
                 "arrangement of the points: grid, latin-hypercube, sobol, monte-carlo or saltelli");
  run.add_option(
         "--points", a.points,
         "number of points; in a grid each range has its own number of points; saltelli makes points x (keys + 2) runs")
      ->check(integer_in(1, 1'000'000'000));
  run.add_flag(
      "--tolerances", a.tolerances,
      "drives of --runs also vary in R, L, K_t and Hall edges, which the sheet states without tolerances");
  take_store(run, a.store, "store each finished run in this SQLite file");
  run.add_flag("--resume", a.resume, "continue the runs of --store, or of the earlier --out");
  run.add_flag("--dry-run", a.dry_run, "print only number, duration and file size of the runs");
  run.add_option("--only", a.only, "only run N of the plan, with all its outputs")
      ->check(integer_in(0, std::numeric_limits<std::int64_t>::max()));
}

void declare_options(CLI::App& run, RunArguments& a) {
  run.add_option("FILE", a.files, "scenario or plan files")->required();
  run.add_option("--out", a.out,
                 fmt::format("folder for {} of each file, index.html of scenarios and NAME.sqlite of a plan",
                             names_in_folder()));
  for (std::size_t n = 0; n < formats().size(); ++n)
    run.add_option(std::string(formats()[n].option), a.paths.of_formats[n],
                   std::string(formats()[n].meaning));
  run.add_option("--junit", a.junit, "write the verdicts of all files as JUnit XML, for build servers");
  take_force(run, a.paths.force);
  take_sets(run, a.sets);
  take_data(run, a.data_dir);
  run.add_flag("--quiet", a.quiet, "print errors only");
  take_jobs(run, a.jobs);
  CLI::Option* watch = run.add_flag("--watch", a.watch, "run again whenever a file that was read is saved");
  CLI::Option* runs =
      run.add_option("--runs", a.runs, "number of drives of the series that [[spread]] describes");
  runs->excludes(watch)->check(integer_in(1, 1'000'000'000));
  // Checked as a signed number, because an unsigned parser would read -1 as a large number.
  const CLI::Validator whole = integer_in(0, std::numeric_limits<std::int64_t>::max());
  run.add_option("--seed", a.seed, "seed of the series of drives. Default: 1")->check(whole);
  run.add_option("--drive", a.drive, "run only drive N of the series, with all outputs of a single run")
      ->excludes(runs)
      ->check(whole);
  CLI::Option* bode = run.add_flag(
      "--bode", a.bode,
      "measure the outermost loop's frequency response at the scenario's end, beside the designed response");
  run.add_option(
         "--amplitude", a.amplitude,
         "amplitude of --bode's multisine, A, rad/s or deg. Default: a twentieth of the final reference")
      ->needs(bode);
  run.add_option(
         "--on", a.on,
         fmt::format(
             "core that runs the drive in an emulator: {}; or MAP.toml, a firmware map that names your own firmware",
             fmt::join(core_names(), ", ")))
      ->excludes(bode)
      ->excludes(runs);
  CLI::Option* log =
      run.add_option(
             "--compare", a.log.path,
             "compare a board's log or an oscilloscope's record with the run, in a table and on the page of --html")
          ->excludes(bode)
          ->excludes(runs);
  run.add_option(
         "--columns", a.log.columns,
         "meaning of each column of --compare, with constants: "
         "time=ms_today/1000,speed=erpm*2*pi/60/7,i_m=current_motor. Default: by the log's headings, also the headings of "
         "VESC Tool, ArduPilot, Betaflight, ODrive, moteus and SimpleFOC")
      ->delimiter(',')
      ->needs(log);
  run.add_option("--interval", a.log.interval_s,
                 "time from row to row of --compare in s, if the log has no column of time")
      ->needs(log);
  run.add_option("--esc", a.log.esc, "number of the ESC or motor in a log of several ESCs or motors")
      ->check(integer_in(0, 1000))
      ->needs(log);
  run.add_option(
         "--shift", a.log.shift_s,
         "time to add to the rows of --compare, s. Default: a shift fitted within 20 PWM periods. If the log's clock starts after the run, times count from the log's first row")
      ->needs(log);
  declare_plan_options(run, a.plan);
}

}  // namespace

Verb declare_run(CLI::App& app) {
  CLI::App& run = *app.add_subcommand("run", "run scenarios, or plans of many runs, and judge them");
  const auto a = std::make_shared<RunArguments>();
  declare_options(run, *a);
  return {&run, calling(run_command, a)};
}

}  // namespace cli

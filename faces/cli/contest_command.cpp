// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/contest_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "batch/contest.hpp"
#include "faces/cli/contest_own.hpp"
#include "faces/cli/contest_store.hpp"
#include "faces/cli/duplicate_outputs.hpp"
#include "faces/cli/new_file.hpp"
#include "faces/cli/open_or_report.hpp"
#include "faces/cli/outputs.hpp"
#include "faces/cli/plan_storing.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/stop_watch.hpp"
#include "faces/cli/store_option.hpp"
#include "faces/cli/terminal.hpp"
#include "faces/cli/with_unit.hpp"
#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "report/contest_page.hpp"
#include "text/contest/contest_entries.hpp"
#include "text/contest/contest_text.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

namespace fs = std::filesystem;

struct ContestArguments {
  std::string motor, board, data_dir;
  OwnArguments own;
  std::optional<double> voltage_V, settle_s, current_settle_s, period_s;
  std::size_t drives = 10;
  std::uint64_t seed = 1;
  std::string json, csv, html, write, store;
  bool quiet = false, force = false, resume = false;
  unsigned jobs = 0;
  std::string command;  ///< the command that writes the files again
};

/// A file name for a controller: "six-step-soft.toml" for "six-step, soft".
std::string file_name(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (c == ' ')
      out += '-';
    else if (c != ',')
      out += c;
  return out + ".toml";
}

/// The output files. They are opened before the runs, so that an unwritable path fails at once.
struct ContestFiles {
  std::optional<files::AtomicFile> json, csv, html;
  std::vector<files::AtomicFile> scenarios;  ///< files of the entries with a scenario, in their order

  base::Problems open(const ContestArguments& a, const std::vector<analysis::ContestEntry>& entries) {
    base::Problems found = duplicate_outputs({{"--json", a.json}, {"--csv", a.csv}, {"--html", a.html}});
    if (!found.empty()) return found;
    const auto one = [&](std::optional<files::AtomicFile>& into, const std::string& path) {
      if (!path.empty() && path != "-")
        open_or_report(into, files::AtomicFile::create({path, a.force}), found);
    };
    one(json, a.json);
    one(csv, a.csv);
    if (!a.html.empty()) open_or_report(html, files::AtomicFile::create({a.html, a.force}), found);
    if (a.write.empty() || !found.empty()) return found;
    found = make_folder(a.write);
    for (const analysis::ContestEntry& entry : entries) {
      if (!entry.scenario || !found.empty()) continue;
      std::optional<files::AtomicFile> file;
      one(file, (fs::path(a.write) / file_name(entry.who->name)).string());
      if (file) scenarios.push_back(std::move(*file));
    }
    return found;
  }
};

base::Problems write(const analysis::Contest& contest, const ContestArguments& a, ContestFiles& out) {
  base::Problems found;
  const auto put = [&](files::AtomicFile& file, const std::string& text) {
    file.write(text);
    append(found, file.commit());
  };
  if (out.json) put(*out.json, text::contest_json(contest));
  if (out.csv) put(*out.csv, files::csv_head(a.command) + text::contest_csv(contest));
  if (out.html) put(*out.html, report::render_contest({contest, a.command, SIXSTEP_VERSION}));
  auto file = out.scenarios.begin();
  for (const analysis::ContestEntry& entry : contest.entries) {
    if (!entry.scenario || file == out.scenarios.end()) continue;
    study::Scenario scenario = *entry.scenario;
    scenario.motor = motor_beside(scenario.motor, file->path());
    put(*file++, files::with_own_mark(a.command, text::scenario_text(scenario, contest.bench.rules)));
  }
  return found;
}

/// In problems, replaces the library's members by options.
base::Problems in_contest_options(base::Problems problems) {
  constexpr std::pair<std::string_view, std::string_view> options[] = {
      {"voltage_V", "--voltage"},
      {"settle_s", "--settle"},
      {"current_settle_s", "--current-settle"},
      {"period_s", "--period"}};
  for (base::Problem& p : problems)
    for (const auto& [member, option] : options)
      if (p.where == member) p.where = option;
  return problems;
}

base::Result<analysis::ContestBench> bench_of(const ContestArguments& a) {
  const base::Result<design::Sheet> sheet = files::read_sheet(a.motor, a.data_dir);
  if (!sheet) return sheet.problems();
  analysis::ContestSpec spec{.motor = a.motor,
                             .sheet = *sheet,
                             .voltage_V = a.voltage_V,
                             .settle_s = a.settle_s,
                             .current_settle_s = a.current_settle_s,
                             .period_s = a.period_s};
  if (!a.board.empty()) {
    const base::Result<study::Scenario> board =
        files::read_scenario(a.board, {.data_dir = a.data_dir, .overrides = {}});
    if (!board) return board.problems();
    spec.board = *board;
  }
  base::Result<analysis::ContestBench> bench = analysis::contest_bench(spec);
  if (!bench) return in_contest_options(bench.problems());
  return bench;
}

Exit exit_of_contest(const analysis::Contest& contest) {
  const bool any = std::any_of(contest.rows.begin(), contest.rows.end(),
                               [](const analysis::ContestRow& row) { return row.nominal_held; });
  return any ? Exit::ok : Exit::failed;
}

/// Reports each user's controller that has no run, for example because it has no speed loop. The row of such
/// a controller contains only dashes.
Exit own_without_run(const analysis::Contest& contest) {
  Exit exit = Exit::ok;
  for (std::size_t n = 0; n < contest.entries.size(); ++n) {
    const analysis::ContestEntry& entry = contest.entries[n];
    if (n < analysis::contestants().size() || entry.scenario) continue;
    complain(
        {{"--own " + std::string(entry.who->name), "", "was not run, so its row in the table has no figures",
          "correct the problems that the next lines report"}});
    complain(entry.scenario.problems());
    exit = Exit::failed;
  }
  return exit;
}

analysis::Contest nominally(const ContestArguments& a, analysis::ContestBench bench,
                            std::vector<analysis::ContestEntry> entries) {
  const StopWatch watch;
  Progress progress({.seconds = {}, .pieces = batch::nominal_runs(entries.size()), .of = "nominal runs"},
                    a.quiet);
  return batch::compare_nominally(std::move(bench), std::move(entries),
                                  {.drives = a.drives,
                                   .seed = a.seed,
                                   .jobs = a.jobs,
                                   .unit_of = unit_of,
                                   .progress = [&](std::size_t done) { progress.pieces_done(done); },
                                   .stop = watch.token()});
}

/// Runs the drives within the tolerances, except the drives whose rows are already in the store.
base::Problems over_the_tolerances(const ContestArguments& a, analysis::Contest& contest) {
  if (a.drives == 0) return {};
  base::Result<files::PlanStore> store = store_of(contest, {a.store, a.resume, a.force, a.command});
  if (!store) return store.problems();
  const StopWatch watch([&store] { return store->failed(); });
  const auto runs = static_cast<std::size_t>(
      std::count_if(contest.entries.begin(), contest.entries.end(),
                    [](const analysis::ContestEntry& entry) { return static_cast<bool>(entry.scenario); }));
  Progress progress({.seconds = {}, .pieces = runs * a.drives, .of = "drives", .before = store->rows()},
                    a.quiet);
  return take_drives(contest,
                     {.drives = a.drives,
                      .seed = a.seed,
                      .jobs = a.jobs,
                      .progress = [&](std::size_t done) { progress.pieces_done(done); },
                      .stop = watch.token()},
                     *store);
}

base::Problems contest_contradictions(const ContestArguments& a) {
  base::Problems problems;
  if (a.resume && a.store.empty())
    problems.push_back({.where = "--resume",
                        .limit = "continues the drives of a store, but no store is named",
                        .cure = "add --store FILE.sqlite"});
  if (!a.store.empty() && a.drives == 0)
    problems.push_back(
        {.where = "--store",
         .limit = "stores drives within the tolerances, but with --runs 0 there are no such drives",
         .cure = "leave out --store or --runs 0"});
  return problems;
}

Exit contest_command(const ContestArguments& a) {
  if (const base::Problems problems = contest_contradictions(a); !problems.empty()) return refused(problems);
  catch_interrupts();
  base::Result<analysis::ContestBench> bench = bench_of(a);
  if (!bench) return refused(bench.problems());
  const base::Result<Contestants> contestants = contestants_of(a.own);
  if (!contestants) return refused(contestants.problems());
  std::vector<analysis::ContestEntry> entries =
      text::contest_entries(*bench, files::on_disk(a.data_dir), contestants->all);
  if (interrupted()) return told_interrupted("compare " + a.motor);
  ContestFiles outputs;
  if (const base::Problems found = outputs.open(a, entries); !found.empty()) return refused(found);
  analysis::Contest contest = nominally(a, std::move(*bench), std::move(entries));
  if (interrupted()) return told_interrupted("compare " + a.motor);
  if (const base::Problems problems = over_the_tolerances(a, contest); !problems.empty())
    return refused(problems);
  if (interrupted()) return told_interrupted("compare " + a.motor, kept_in(a.store));
  if (const base::Problems unwritten = write(contest, a, outputs); !unwritten.empty())
    return refused(unwritten);
  if (a.json == "-") print(text::contest_json(contest));
  if (a.csv == "-") print(files::csv_head(a.command) + text::contest_csv(contest));
  if (!a.quiet && a.json != "-" && a.csv != "-") print(text::contest_text(contest));
  const Exit own = own_without_run(contest);
  return own == Exit::ok ? exit_of_contest(contest) : own;
}

void declare_options(CLI::App& verb, ContestArguments& a) {
  verb.add_option("MOTOR", a.motor, "name or path of a motor file")->required();
  verb.add_option("--voltage", a.voltage_V, "bus voltage in V. Default: the sheet's nominal voltage");
  verb.add_option("--settle", a.settle_s,
                  "settling time of all speed loops in s. Default: the shortest that Hall probes allow");
  verb.add_option(
      "--current-settle", a.current_settle_s,
      "settling time of all current loops in s. Default: the settling time that the design chooses");
  verb.add_option("--period", a.period_s, "control and PWM period in s. Default: 30e-6");
  verb.add_option("--board", a.board, "scenario whose supply, bridge, PWM and sensors all controllers share");
  for (const auto& [option, unit] : {std::pair{"--voltage", "V"}, std::pair{"--settle", "s"},
                                     std::pair{"--current-settle", "s"}, std::pair{"--period", "s"}})
    take_unit(verb.get_option(option), unit);
  declare_own(verb, a.own);
  verb.add_option(
          "--runs", a.drives,
          "number of drives within the sheet's tolerances, for each controller; 0: only the nominal drive")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str();
  verb.add_option("--seed", a.seed, "seed of the drives of --runs")->capture_default_str();
  take_store(verb, a.store, "SQLite file for the figures of the drives of --runs, one row per drive");
  verb.add_flag("--resume", a.resume, "continue with the drives that --store does not have yet");
  verb.add_option("--json", a.json,
                  "write all results as JSON; - writes to standard output instead of the tables");
  verb.add_option("--csv", a.csv, "write one line of CSV per controller; - writes to standard output");
  verb.add_option(
      "--html", a.html,
      "write a page with pictures: the best controller for each figure, and each controller's response to the load");
  verb.add_option("--write", a.write,
                  "folder to which the scenario of each controller is written, for sixstep run");
  take_force(verb, a.force);
  take_data(verb, a.data_dir);
  take_jobs(verb, a.jobs);
  verb.add_flag("--quiet", a.quiet, "print errors only; files are still written");
}

}  // namespace

Verb declare_contest(CLI::App& app) {
  CLI::App& verb = *app.add_subcommand(
      "compare",
      "compare controllers of one motor on one course; each controller is designed by its own rule");
  const auto a = std::make_shared<ContestArguments>();
  declare_options(verb, *a);
  return {&verb, calling(contest_command, a)};
}

}  // namespace cli

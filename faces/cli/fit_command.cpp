// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/fit_command.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "batch/fit/fit.hpp"
#include "batch/for_each.hpp"
#include "faces/cli/result_files.hpp"
#include "faces/cli/settings.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "files/own_file.hpp"
#include "files/scenario_on_disk.hpp"
#include "files/text_file.hpp"
#include "report/fit_page.hpp"
#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "sixstep/base/range_text.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/sheet_constants.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "text/escape/escape.hpp"
#include "text/recording/board_log.hpp"
#include "text/results/fit_text.hpp"
#include "text/scenario/scenario_text.hpp"

namespace cli {
namespace {

/// A fit simulates each used row several hundred times; more rows are thinned evenly.
constexpr std::size_t most_rows = 4000;

struct FitArguments {
  std::vector<std::string> files;  ///< pairs: a scenario (.toml) and its log, in either order
  std::vector<std::string> free, columns, sets;
  std::vector<double> shifts_s;
  std::optional<double> interval_s;
  std::optional<int> esc;
  std::string data_dir, write, html;
  unsigned jobs = 0;
  bool json = false, quiet = false, force = false;
  std::string command;  ///< the command that writes the files again
};

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

struct Pair {
  std::string scenario, log;
};

base::Result<std::vector<Pair>> pairs_of(const FitArguments& a) {
  std::vector<Pair> pairs;
  const auto is_scenario = [](const std::string& path) { return path.ends_with(".toml"); };
  for (std::size_t n = 0; n + 1 < a.files.size(); n += 2) {
    const std::string &first = a.files[n], &second = a.files[n + 1];
    if (is_scenario(first) == is_scenario(second)) break;
    pairs.push_back(is_scenario(first) ? Pair{first, second} : Pair{second, first});
  }
  if (2 * pairs.size() != a.files.size())
    return base::Problem{"FILE", text::visible(a.files[2 * pairs.size()]),
                         "is not followed by the other file of its pair",
                         "name each log beside its scenario: LOG.csv SCENARIO.toml"};
  if (!a.shifts_s.empty() && a.shifts_s.size() != pairs.size())
    return base::Problem{"--shift", std::to_string(a.shifts_s.size()),
                         fmt::format("values are given for {} logs", pairs.size()),
                         "give one shift for each log, separated by commas"};
  return pairs;
}

/// Removes the columns of labels, which have no difference, and columns that the scenario's run does not have.
void keep_numbers(study::Trace& log, const study::Scenario& scenario, std::vector<text::NotUsed>& not_used) {
  const std::vector<study::Column>& known = study::all_columns(scenario.sheet.kind);
  for (std::size_t c = log.columns.size(); c-- > 1;) {
    const std::string name = log.columns[c].name;
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const study::Column& k) { return k.name == name; });
    const bool has =
        found != known.end() && study::applies(static_cast<study::ColumnId>(found - known.begin()), scenario);
    if (has && !study::holds_labels(name)) continue;
    not_used.push_back({name, has ? "a label" : "the scenario's run does not have it"});
    log.columns.erase(log.columns.begin() + static_cast<std::ptrdiff_t>(c));
    log.values.erase(log.values.begin() + static_cast<std::ptrdiff_t>(c));
  }
}

/// Notes a column whose rows often have its highest or lowest value, as at the end of an instrument's range. A rotor at rest
/// has the value 0.
void note_clipping(const study::Trace& log, text::Notes& notes) {
  for (std::size_t c = 1; c < log.columns.size(); ++c) {
    const std::vector<double>& x = log.values[c];
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    for (const double end : {*low, *high}) {
      const auto rows = std::count(x.begin(), x.end(), end);
      if (end == 0.0 || *low == *high || 10 * rows < static_cast<std::ptrdiff_t>(x.size())) continue;
      notes.push_back(fmt::format(
          "{} of {} rows of {} have the column's {} value, {:.6g}; if the instrument's range ends there, the fit is wrong",
          rows, x.size(), log.columns[c].name, end == *low ? "lowest" : "highest", end));
    }
  }
}

/// Keeps every nth row, so that at most most_rows remain.
void thin(study::Trace& log, text::Notes& notes) {
  const std::size_t rows = log.values[0].size(), stride = (rows + most_rows - 1) / most_rows;
  if (stride <= 1) return;
  for (std::vector<double>& values : log.values) {
    for (std::size_t n = 0; n * stride < rows; ++n) values[n] = values[n * stride];
    values.resize((rows + stride - 1) / stride);
  }
  notes.push_back(fmt::format("one of {} rows is used, {} of {}", stride, log.values[0].size(), rows));
}

/// Moves the log's times into the simulated time; `given` is the option's shift.
void place_in_time(batch::FitBench& bench, std::optional<double> given, text::Notes& notes) {
  std::vector<double>& t_s = bench.log.values[0];
  const bool inside = std::any_of(t_s.begin(), t_s.end(), [&](double t) {
    return t + given.value_or(0.0) >= 0.0 && t + given.value_or(0.0) <= bench.scenario.duration_s;
  });
  if (given)
    bench.shift_s = *given;
  else if (!inside) {
    notes.push_back(fmt::format("its clock starts at {:.10g} s, so that times are counted from its first row",
                                t_s.front()));
    const double start_s = t_s.front();
    for (double& t : t_s) t -= start_s;
  }
}

base::Result<batch::FitBench> bench_of(const FitArguments& a, const Pair& pair, std::optional<double> shift_s,
                                       const files::ReadOptions& options) {
  base::Result<study::Scenario> scenario = files::read_scenario(pair.scenario, options);
  if (!scenario) return scenario.problems();
  const base::Result<std::string> text = files::read_text(pair.log);
  if (!text) return text.problems();
  base::Result<text::BoardLog> read =
      text::read_board_log(pair.log, *text,
                           {.formulas = a.columns,
                            .interval_s = a.interval_s,
                            .pole_pairs = design::sheet_constants(scenario->sheet).pole_pairs,
                            .field_oriented = scenario->control.drive == study::FirmwareKind::field,
                            .esc = a.esc});
  if (!read) return read.problems();
  batch::FitBench bench{name_of(pair.log), batch::with_both_frictions(std::move(*scenario)),
                        std::move(read->trace), 0.0};
  if (!read->recognised.empty()) read->notes.push_back("is " + read->recognised);
  keep_numbers(bench.log, bench.scenario, read->not_used);
  if (bench.log.columns.size() < 2)
    return base::Problem{pair.log, "no column", "is a number that the scenario's run has",
                         "record a current, a voltage or the speed, or name columns with --columns"};
  text::note_not_used(read->not_used, read->notes);
  note_clipping(bench.log, read->notes);
  thin(bench.log, read->notes);
  place_in_time(bench, shift_s, read->notes);
  if (!a.quiet)
    for (const std::string& note : read->notes)
      print(fmt::format("{}: {}\n", text::visible(bench.name), text::visible(note)), stderr);
  return bench;
}

/// Shows the number of trials on a terminal's last line.
class Counter {
 public:
  explicit Counter(bool quiet) : shown_(!quiet && terminal_width(stderr) > 0) {}
  ~Counter() {
    if (written_) print("\r\033[K", stderr);
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  void count() {
    ++trials_;
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(500)) return;
    last_ = now;
    written_ = true;
    print(fmt::format("\r{} trials", trials_), stderr);
  }

 private:
  bool shown_, written_ = false;
  std::size_t trials_ = 0;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

base::Result<batch::FitRequest> request_of(const FitArguments& a) {
  base::Problems problems;
  const base::Range interval = base::allowed(base::above(0.0), "s");
  if (a.interval_s && !interval.holds(*a.interval_s))
    problems.push_back({"--interval", base::written(*a.interval_s), base::limit_of(interval),
                        "give the time from one row to the next in seconds"});
  for (const double shift : a.shifts_s)
    if (!std::isfinite(shift))
      problems.push_back({"--shift", base::written(shift), "must be a number", "give a time in seconds"});
  const files::ReadOptions options = read_options(a.data_dir, a.sets, problems);
  const base::Result<std::vector<Pair>> pairs = pairs_of(a);
  if (!pairs) append(problems, pairs.problems());
  if (!problems.empty()) return problems;
  batch::FitRequest request;
  for (std::size_t n = 0; n < pairs->size(); ++n) {
    base::Result<batch::FitBench> bench =
        bench_of(a, (*pairs)[n], a.shifts_s.empty() ? std::nullopt : std::optional(a.shifts_s[n]), options);
    if (!bench) return bench.problems();
    for (const batch::FitBench& other : request.benches)
      if (other.name == bench->name) bench->name += fmt::format(" ({})", n + 1);
    request.benches.push_back(std::move(*bench));
  }
  request.free = a.free;
  if (request.free.empty()) {
    request.free = batch::usual_free(request.benches[0].scenario);
    if (a.shifts_s.empty()) request.free.emplace_back("shift_s");
  }
  return request;
}

/// In problems, replaces the library's member by its option.
base::Problems of_fit_options(base::Problems problems) {
  for (base::Problem& p : problems)
    if (p.where == "free" || p.where == "columns" || p.where == "esc") p.where.insert(0, "--");
  return problems;
}

Exit fit_command(const FitArguments& a) {
  base::Result<batch::FitRequest> request = request_of(a);
  if (!request) return refused(of_fit_options(request.problems()));
  catch_interrupts();
  ResultFiles out;
  base::Problems problems = out.open({{"--write", a.write}, {"--html", a.html}}, a.force);
  if (!problems.empty()) return refused(problems);
  const base::Result<analysis::Fit> found = [&] {
    Counter counter(a.quiet);
    request->for_each = [&a](std::size_t count, const std::function<void(std::size_t)>& each) {
      batch::for_each(count, a.jobs, each);
    };
    request->keep_going = [&counter] {
      counter.count();
      return !interrupted();
    };
    return batch::fit(*request);
  }();
  if (interrupted()) return told_interrupted("motor fit");
  if (!found) return refused(of_fit_options(found.problems()));
  const design::Sheet sheet = analysis::fitted_sheet(request->benches[0].scenario, *found);
  out.put("--write", files::with_own_mark(a.command, text::sheet_text(sheet)), problems);
  if (out.has("--html"))
    out.put("--html", report::render_fit({*found, sheet, a.command, SIXSTEP_VERSION}), problems);
  if (a.json)
    print(text::fit_json(*found, sheet));
  else if (!a.quiet)
    print(text::fit_text(*found, sheet));
  complain(problems);
  if (!problems.empty()) return Exit::bad_input;
  return found->converged ? Exit::ok : Exit::failed;
}

}  // namespace

Verb declare_fit(CLI::App& motor) {
  CLI::App& verb = *motor.add_subcommand(
      "fit", "constants of the motor, with 95 % bounds, from recordings and scenarios that repeat them");
  const auto a = std::make_shared<FitArguments>();
  verb.add_option(
          "FILE", a->files,
          "pairs of files: LOG.csv, a recording of a bench, and SCENARIO.toml, which does what was done there")
      ->required();
  verb.add_option(
          "--free", a->free,
          "what to fit: keys such as motor_override.inertia_gcm2 or supply.voltage_V, and of the probes shift_s, drift, "
          "offset, gain, delay_s (gain.i_a_A: of one column). Default: R, L, torque constant, inertia, frictions, offset, "
          "shift_s")
      ->delimiter(',');
  verb.add_option("--columns", a->columns,
                  "meaning of each column of the logs, with constants, as for run --compare: i_a_A=CH1*10")
      ->delimiter(',');
  verb.add_option("--interval", a->interval_s, "time from row to row, s, if no column holds the time");
  verb.add_option("--shift", a->shifts_s,
                  "time to add to the rows of each log, s. Default: fitted, starting at 0")
      ->delimiter(',');
  verb.add_option("--esc", a->esc, "number of the ESC in a log of several");
  take_sets(verb, a->sets);
  take_jobs(verb, a->jobs, "simulations");
  verb.add_flag("--json", a->json, "for programs");
  verb.add_option("--write", a->write, "write a motor file with the fitted constants");
  verb.add_option("--html", a->html, "write a page with charts of each column and its difference");
  take_force(verb, a->force);
  take_data(verb, a->data_dir);
  verb.add_flag("--quiet", a->quiet, "no text, only files and errors");
  return {&verb, calling(fit_command, a)};
}

}  // namespace cli

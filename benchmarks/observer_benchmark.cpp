// SPDX-License-Identifier: Apache-2.0
// Measures the cost of each observer of a run, alone and all together as in the program. Also measures every
// case of engine_benchmark as a user runs it, over ten seconds. tools/performance.py writes the table of
// docs/explanation/performance.md and the second lines of the README's table from the results.
//
//   build/dev/benchmarks/observer_benchmark
#include <benchmark/benchmark.h>

#include <filesystem>
#include <numeric>
#include <string>

#include "benchmarks/observers.hpp"
#include "files/trace/csv_writer.hpp"
#include "report/kept_rows.hpp"
#include "report/report.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/measure/recorder.hpp"
#include "sixstep/study/run/run.hpp"

namespace {

using namespace benchmarks;
namespace study = sixstep::study;
using sixstep::control::Mode;

/// An observer that measures one figure over the whole run.
study::Figures figure(const Prepared& p, const study::Measure& measure) {
  study::Scenario s = p.scenario();
  s.require.clear();
  s.compare.clear();
  s.compare.push_back({measure, 0.0, ""});
  return study::Figures(s, study::reference_levels(s));
}

/// One figure of each kind: an integral, an extreme, crossings of a band, harmonics, powers, edges. The
/// fundamental frequency is given: with the rotor's own frequency, a case that reverses the rotor would end
/// the figure early.
struct FigureRow {
  const char* name;
  study::Measure measure;
};
const FigureRow figure_rows[] = {
    {"figure: mean of the current", {.metric = study::MetricKind::mean, .signal = study::Signal::current}},
    {"figure: maximum of the current",
     {.metric = study::MetricKind::maximum, .signal = study::Signal::current}},
    {"figure: settling time of the current at 5 A",
     {.metric = study::MetricKind::settling_time,
      .signal = study::Signal::current,
      .level = 5.0,
      .start = 0.0}},
    {"figure: distortion of a phase current",
     {.metric = study::MetricKind::thd, .signal = study::Signal::phase_a, .frequency_Hz = 200.0}},
    {"figure: efficiency", {.metric = study::MetricKind::efficiency}},
    {"figure: switching frequency of a gate",
     {.metric = study::MetricKind::switching_frequency, .signal = study::Signal::gate_T1}},
};

std::vector<std::size_t> first_columns(std::size_t count) {
  std::vector<std::size_t> columns(count);
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  return columns;
}

constexpr std::int64_t grid_ticks = 30'000'000;  // a row per PWM period
constexpr double gap_s = 1e-3;
void nowhere(std::span<const double> row) { benchmark::DoNotOptimize(row.data()); }

/// A recorder whose rows are written to a CSV file, as in the program. The file does not get its final name.
void csv(benchmark::State& state, const Case& c) {
  const std::string name =
      (std::filesystem::temp_directory_path() / "sixstep-observer-benchmark.csv").string();
  const auto columns = std::span(study::all_columns()).first(7);
  std::optional<files::CsvWriter> file;
  measure(state, c, [&](const Prepared& p) {
    auto made = files::CsvWriter::create(name, columns);
    file.reset();
    if (made) file.emplace(std::move(*made));
    return study::GridRecorder(grid_ticks, p.end(), first_columns(7), [&file](std::span<const double> row) {
      if (file) file->row(row);
    });
  });
}

/// A run as in the program, without files: digest, energy audit and the scenario's figures.
void whole_study(benchmark::State& state, const Case& c) {
  const auto prepared = Prepared::of(c);
  if (!prepared) return state.SkipWithError("the scenario cannot be read");
  for (auto _ : state) benchmark::DoNotOptimize(study::run(prepared->scenario()));
  note(state, prepared->end().seconds());
}

/// From the scenario to its verdicts, over ten seconds, on the kernel that the scenario needs.
void as_user(benchmark::State& state, const Case& c) {
  constexpr double duration_s = 10.0;
  const auto scenario = read(c, duration_s);
  if (!scenario) return state.SkipWithError("the scenario cannot be read");
  for (auto _ : state) {
    const auto outcome = study::run(*scenario);
    if (!outcome || study::cut_short(*scenario, *outcome) || outcome->fault)
      return state.SkipWithError("the run does not reach its end");
    benchmark::DoNotOptimize(outcome->verdicts.data());
  }
  note(state, duration_s);
}

/// A run with its report: a row at every event is kept, and the page is written from the rows.
void report_of(benchmark::State& state, const Case& c) {
  const auto prepared = Prepared::of(c);
  if (!prepared) return state.SkipWithError("the scenario cannot be read");
  for (auto _ : state) {
    report::KeptRows rows(prepared->scenario());
    const auto outcome =
        study::run(prepared->scenario(), {.on_event = [&rows](study::Row row) { rows.add(row); }});
    if (!outcome) return state.SkipWithError("the scenario cannot be run");
    benchmark::DoNotOptimize(report::render({.scenario = prepared->scenario(),
                                             .outcome = *outcome,
                                             .trace = rows.trace(),
                                             .command = "sixstep run",
                                             .version = "",
                                             .scenario_text = ""}));
  }
  note(state, prepared->end().seconds());
}

void register_all(const Case& c) {
  add_bare_and_audited(c);
  for (const FigureRow& row : figure_rows)
    add(c, row.name, [measure = row.measure](const Prepared& p) { return figure(p, measure); });
  add(c, "rows on a grid, one per PWM period",
      [](const Prepared& p) { return study::GridRecorder(grid_ticks, p.end(), first_columns(7), nowhere); });
  add(c, "rows at every event", [](const Prepared&) {
    return study::EventRecorder(gap_s, first_columns(study::column_count), nowhere);
  });
  benchmark::RegisterBenchmark((std::string(c.name) + "/rows on a grid to a CSV file").c_str(),
                               [c](benchmark::State& state) { csv(state, c); });
  benchmark::RegisterBenchmark((std::string(c.name) + "/study: digest, audit, its figures").c_str(),
                               [c](benchmark::State& state) { whole_study(state, c); });
  benchmark::RegisterBenchmark((std::string(c.name) + "/study with its report").c_str(),
                               [c](benchmark::State& state) { report_of(state, c); });
}

}  // namespace

int main(int argc, char** argv) {
  for (const Case& c : {cases[1], cases[2]}) register_all(c);
  const auto add_user = [](const Case& c) {
    benchmark::RegisterBenchmark((std::string(c.name) + "/study of 10 s").c_str(),
                                 [c](benchmark::State& state) { as_user(state, c); });
  };
  for (const Case& c : cases) add_user(c);
  for (const Case& c : wider_cases) add_user(c);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

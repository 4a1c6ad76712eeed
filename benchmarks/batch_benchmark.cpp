// SPDX-License-Identifier: Apache-2.0
// Measures the wall time of a series of 1000 drives (R6, parameters as in
// data/scenarios/current-square-series.toml) on 1, 2, .. threads, to show how the speed of a batch scales
// with the cores. Machines are shared, and their clock frequency decreases under load. Therefore each number
// of threads is compared with the same number of single-threaded batches that run at the same time. The
// processor time per drive is shown too: if it does not increase, the threads do not slow each other down.
// Values are medians.
//
//   build/dev/benchmarks/batch_benchmark --benchmark_repetitions=9
#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "batch/plan_runs.hpp"
#include "files/scenario_on_disk.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace {

constexpr std::size_t drives = 1000;

sixstep::study::Scenario series() {
  const auto scenario =
      files::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/current-square-series.toml", {});
  if (!scenario) std::abort();
  return *scenario;
}

/// The sum of the digests of all drives. It does not depend on their order.
std::uint64_t digests(const sixstep::study::Scenario& scenario, std::size_t count, unsigned jobs) {
  const sixstep::analysis::Plan plan{.axes = {}, .drives = count};
  const sixstep::analysis::TableColumns columns = sixstep::analysis::columns_of(plan, scenario);
  std::atomic<std::uint64_t> sum{0};
  batch::run_plan({.plan = plan,
                   .columns = columns,
                   .scenario = [&](std::size_t n) -> sixstep::base::Result<sixstep::analysis::PlannedRun> {
                     return sixstep::analysis::planned_drive(scenario, 1, n);
                   },
                   .wanted = {},
                   .take = [&](sixstep::analysis::RunRecord&& record) { sum += record->digest; },
                   .stop = {},
                   .jobs = jobs});
  return sum;
}

void run_batch(benchmark::State& state, unsigned jobs) {
  const sixstep::study::Scenario scenario = series();
  std::uint64_t digest = 0;
  for (auto _ : state) digest = digests(scenario, drives, jobs);
  state.SetLabel("digest " + std::to_string(digest));
  state.counters["drives"] =
      benchmark::Counter(drives * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// The reference for the machine: the same work `threads` times, without shared data.
void run_apart(benchmark::State& state, unsigned threads) {
  const sixstep::study::Scenario scenario = series();
  for (auto _ : state) {
    std::vector<std::jthread> pool;
    for (unsigned n = 0; n < threads; ++n)
      pool.emplace_back([&] { benchmark::DoNotOptimize(digests(scenario, drives / threads, 1)); });
  }
  state.counters["drives"] = benchmark::Counter(
      static_cast<double>(drives / threads * threads * state.iterations()), benchmark::Counter::kIsRate);
}

class Linearity : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && run.counters.count("drives")) {
        drives_per_s_[run.run_name.function_name].push_back(run.counters.at("drives").value);
        cpu_s_[run.run_name.function_name].push_back(run.cpu_accumulated_time /
                                                     static_cast<double>(run.iterations));
      }
    ConsoleReporter::ReportRuns(runs);
  }
  void print(unsigned cores) const {
    std::printf("\n%-8s %12s %12s %22s %20s\n", "threads", "drives/s", "speed-up", "of unshared batches",
                "CPU us per drive");
    for (unsigned n = 1; n <= cores; ++n) {
      const std::string threads = std::to_string(n);
      const double one = median(drives_per_s_, "batch/1"), batch = median(drives_per_s_, "batch/" + threads),
                   apart = median(drives_per_s_, "apart/" + threads);
      if (one > 0 && batch > 0 && apart > 0)
        std::printf("%-8u %12.0f %12.2f %21.1f%% %20.1f\n", n, batch, batch / one, 100 * batch / apart,
                    1e6 * median(cpu_s_, "batch/" + threads) / drives);
    }
  }

 private:
  using Measured = std::map<std::string, std::vector<double>>;
  static double median(const Measured& all, const std::string& name) {
    const auto found = all.find(name);
    if (found == all.end()) return 0.0;
    std::vector<double> values = found->second;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }
  Measured drives_per_s_, cpu_s_;
};

}  // namespace

int main(int argc, char** argv) {
  const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
  for (unsigned n = 1; n <= cores; ++n) {
    benchmark::RegisterBenchmark(("batch/" + std::to_string(n)).c_str(), run_batch, n)
        ->UseRealTime()
        ->MeasureProcessCPUTime();
    benchmark::RegisterBenchmark(("apart/" + std::to_string(n)).c_str(), run_apart, n)
        ->UseRealTime()
        ->MeasureProcessCPUTime();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Linearity linearity;
  benchmark::RunSpecifiedBenchmarks(&linearity);
  linearity.print(cores);
  return 0;
}

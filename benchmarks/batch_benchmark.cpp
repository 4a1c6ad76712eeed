// SPDX-License-Identifier: Apache-2.0
// A series of 1000 drives (R6, parameters as in data/scenarios/current-square-series.toml) on 1, 2, ..
// threads, in wall time: how nearly linear the batch is over the cores. Real machines are shared and clock
// down when busy, so each thread count is also held against as many single batches side by side, one per
// thread.
//
//   build/dev/benchmarks/batch_benchmark
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "batch/monte_carlo.hpp"
#include "io/scenario_file.hpp"

namespace {

constexpr std::size_t drives = 1000;

sixstep::study::Scenario series() {
  const auto scenario =
      io::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/current-square-series.toml", {});
  if (!scenario) std::abort();
  return *scenario;
}

void run_batch(benchmark::State& state, unsigned jobs) {
  const sixstep::study::Scenario scenario = series();
  std::uint64_t digest = 0;
  for (auto _ : state)
    digest = batch::monte_carlo(scenario, {.runs = drives, .seed = 1, .jobs = jobs}).digest;
  state.SetLabel("digest " + std::to_string(digest));
  state.counters["drives"] =
      benchmark::Counter(drives * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

/// What the machine itself gives: the same work without anything in common, `threads` times.
void run_apart(benchmark::State& state, unsigned threads) {
  const sixstep::study::Scenario scenario = series();
  for (auto _ : state) {
    std::vector<std::jthread> pool;
    for (unsigned n = 0; n < threads; ++n)
      pool.emplace_back([&] {
        benchmark::DoNotOptimize(
            batch::monte_carlo(scenario, {.runs = drives / threads, .seed = 1, .jobs = 1}).digest);
      });
  }
  state.counters["drives"] = benchmark::Counter(
      static_cast<double>(drives / threads * threads * state.iterations()), benchmark::Counter::kIsRate);
}

class Linearity : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration && run.counters.count("drives")) {
        double& best = drives_per_s_[run.run_name.function_name];
        best = std::max(best, run.counters.at("drives").value);
      }
    ConsoleReporter::ReportRuns(runs);
  }
  void print(unsigned cores) const {
    std::printf("\n%-8s %16s %12s %24s\n", "threads", "drives/s, best", "speed-up", "of unshared batches");
    for (unsigned n = 1; n <= cores; ++n) {
      const double one = rate("batch/1"), batch = rate("batch/" + std::to_string(n)),
                   apart = rate("apart/" + std::to_string(n));
      if (one > 0 && batch > 0 && apart > 0)
        std::printf("%-8u %16.0f %12.2f %23.1f%%\n", n, batch, batch / one, 100 * batch / apart);
    }
  }

 private:
  double rate(const std::string& name) const {
    const auto found = drives_per_s_.find(name);
    return found == drives_per_s_.end() ? 0.0 : found->second;
  }
  std::map<std::string, double> drives_per_s_;
};

}  // namespace

int main(int argc, char** argv) {
  const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
  for (unsigned n = 1; n <= cores; ++n) {
    benchmark::RegisterBenchmark(("batch/" + std::to_string(n)).c_str(), run_batch, n)->UseRealTime();
    benchmark::RegisterBenchmark(("apart/" + std::to_string(n)).c_str(), run_apart, n)->UseRealTime();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Linearity linearity;
  benchmark::RunSpecifiedBenchmarks(&linearity);
  linearity.print(cores);
  return 0;
}

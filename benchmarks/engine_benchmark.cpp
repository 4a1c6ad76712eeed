// SPDX-License-Identifier: Apache-2.0
// The engine beside the textbook program on the same cases, in one binary, in CPU time, without observers; at
// the end the ratios, which is what one can compare between machines.
//
//   build/dev/benchmarks/engine_benchmark
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "benchmarks/rk4_yardstick.hpp"
#include "io/scenario_file.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile.hpp"

namespace {

using namespace benchmarks;
namespace study = sixstep::study;

constexpr double period_s = 30e-6;

struct Case {
  const char* name;
  const char* scenario;
  YardstickMode mode;
  double reference, reverse_s;  // of the yardstick: squared at reverse_s where > 0
};
constexpr Case cases[] = {
    {"R2 voltage run-up", "reference/R2.toml", YardstickMode::duty, 1.0, 0.0},
    {"R3 soft chopping", "reference/R3.toml", YardstickMode::duty, 0.5, 0.0},
    {"R6 current PI", "reference/R6.toml", YardstickMode::current, 5.0, 5e-3},
    {"7.4 speed cascade", "thesis/7.4-speed-thesis-gains.toml", YardstickMode::speed, 100.0, 0.0},
};

std::string label(const Case& c, const char* solver) { return std::string(c.name) + "/" + solver; }

void report_rate(benchmark::State& state, double simulated_s) {
  const double done = simulated_s * static_cast<double>(state.iterations());
  state.counters["per_period"] =
      benchmark::Counter(done / period_s, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["simulated"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
}

void run_engine(benchmark::State& state, const Case& c) {
  const auto scenario =
      io::read_scenario(std::string(SIXSTEP_SOURCE_DIR "/data/scenarios/") + c.scenario, {});
  if (!scenario) return state.SkipWithError("the scenario cannot be read");
  const auto compiled = study::compile(*scenario);
  if (!compiled) return state.SkipWithError("the scenario cannot be compiled");
  const sixstep::plant::Plant<double> plant(compiled->motor.machine, compiled->shaft, compiled->devices,
                                            compiled->supply, compiled->start);
  sixstep::sim::NoObserver nobody;
  for (auto _ : state) {
    sixstep::rig::Rig<double, double> rig(plant, compiled->drive, compiled->board, compiled->timeline);
    benchmark::DoNotOptimize(sixstep::sim::run(rig, compiled->end, nobody));
  }
  report_rate(state, compiled->end.seconds());
}

void run_yardstick(benchmark::State& state, const Case& c, std::int64_t step_ns) {
  YardstickParameters parameters{.mode = c.mode};
  parameters.step_s = 1e-9 * static_cast<double>(step_ns);
  parameters.steps_per_period = static_cast<int>(30'000 / step_ns);
  const std::int64_t steps = 20'000'000 / step_ns;  // 20 ms
  const std::int64_t stretch = c.reverse_s > 0 ? std::llround(c.reverse_s / parameters.step_s) : steps;
  for (auto _ : state) {
    Rk4Yardstick motor(parameters);
    double wanted = c.reference;
    for (std::int64_t n = 0; n < steps; wanted = -wanted) {
      motor.set_reference(wanted);
      for (const std::int64_t until = n + stretch; n < until; ++n) motor.step();
    }
    benchmark::DoNotOptimize(motor.speed());
  }
  report_rate(state, 0.02);
}

/// Remembers what was measured, for the ratios.
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.counters.count("per_period"))
        per_period_ns_[run.benchmark_name()] = 1e9 * run.counters.at("per_period").value;
    ConsoleReporter::ReportRuns(runs);
  }
  void print() const {
    std::printf("\n%-20s %14s %14s %14s %16s %16s\n", "", "ns per period", "simulated s/s", "RK4 ns/step",
                "RK4 1 us / engine", "RK4 0.1 us / engine");
    for (const Case& c : cases) {
      const double engine = ns(label(c, "engine")), coarse = ns(label(c, "rk4_1us")),
                   fine = ns(label(c, "rk4_0.1us"));
      if (engine > 0 && coarse > 0 && fine > 0)
        std::printf("%-20s %14.0f %14.0f %14.1f %16.1f %16.1f\n", c.name, engine, 1e9 * period_s / engine,
                    fine / 300, coarse / engine, fine / engine);
    }
  }

 private:
  double ns(const std::string& name) const {
    const auto found = per_period_ns_.find(name);
    return found == per_period_ns_.end() ? 0.0 : found->second;
  }
  std::map<std::string, double> per_period_ns_;
};

}  // namespace

int main(int argc, char** argv) {
  for (const Case& c : cases) {
    benchmark::RegisterBenchmark(label(c, "engine").c_str(), run_engine, c);
    benchmark::RegisterBenchmark(label(c, "rk4_1us").c_str(), run_yardstick, c, 1000);
    benchmark::RegisterBenchmark(label(c, "rk4_0.1us").c_str(), run_yardstick, c, 100);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  ratios.print();
  return 0;
}

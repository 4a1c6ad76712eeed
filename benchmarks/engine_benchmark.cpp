// SPDX-License-Identifier: Apache-2.0
// Measures the engine with either kernel and two textbook programs on the same cases, in one binary, in CPU
// time, without observers. Also measures the engine over ten times the duration. Counters: seconds per PWM
// period, simulated seconds per second, and the largest error of a phase current relative to the current's
// peak. tools/performance.py writes the README's table from the results.
//
//   build/dev/benchmarks/engine_benchmark
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <string>

#include "benchmarks/accuracy.hpp"
#include "benchmarks/cases.hpp"
#include "benchmarks/rk4_textbook.hpp"
#include "benchmarks/rk4_tuned.hpp"

namespace {

using namespace benchmarks;

std::string label(const Case& c, const char* solver) { return std::string(c.name) + "/" + solver; }

void report(benchmark::State& state, double simulated_s) {
  const double done = simulated_s * static_cast<double>(state.iterations());
  state.counters["per_period"] =
      benchmark::Counter(done / period_s, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["simulated"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
}

/// The error is computed once, because a benchmark is called several times until its time is long enough.
template <class Compute>
void report_error(benchmark::State& state, const Case& c, const std::string& name, Compute&& compute) {
  static std::map<std::string, double> known;
  if (*c.trajectory == '\0') return;
  if (!known.count(name)) known[name] = compute().current;
  state.counters["error"] = known[name];
}

template <class Rig>
Errors engine_errors(Rig rig, const Case& c) {
  sixstep::sim::NoObserver nobody;
  return errors_against(
      trajectory_file(c),
      [&](double t_s) {
        sixstep::sim::run(rig, sixstep::sim::to_instant(t_s), nobody);
        const auto& s = rig.plant().state();
        return std::array{s.i[0], s.i[1], s.i[2], s.w};
      },
      c.judged_s);
}

/// `rig_of` returns a rig of a Prepared, at rest.
template <class RigOf>
void run_engine(benchmark::State& state, const std::optional<Prepared>& prepared, RigOf&& rig_of) {
  if (!prepared) return state.SkipWithError("the scenario cannot be read");
  sixstep::sim::NoObserver nobody;
  for (auto _ : state) {
    auto rig = rig_of(*prepared);
    benchmark::DoNotOptimize(sixstep::sim::run(rig, prepared->end(), nobody));
  }
  report(state, prepared->end().seconds());
}

void run_lean(benchmark::State& state, const Case& c, double duration_s) {
  const auto prepared = Prepared::of(c, duration_s);
  run_engine(state, prepared, [](const Prepared& p) { return p.rig(); });
  if (prepared && duration_s == 0)
    report_error(state, c, label(c, "lean"), [&] { return engine_errors(prepared->rig(), c); });
}

void run_general(benchmark::State& state, const Case& c) {
  const auto prepared = Prepared::on_general(c);
  run_engine(state, prepared, [](const Prepared& p) { return p.general_rig(); });
  if (prepared)
    report_error(state, c, label(c, "general"), [&] { return engine_errors(prepared->general_rig(), c); });
}

template <class Solver>
void run_yardstick(benchmark::State& state, const Case& c, const char* name, std::int64_t step_ns) {
  YardstickParameters parameters{.mode = c.mode};
  parameters.step_s = 1e-9 * static_cast<double>(step_ns);
  parameters.steps_per_period = static_cast<int>(30'000 / step_ns);
  const std::int64_t steps = 20'000'000 / step_ns;  // 20 ms
  const std::int64_t stretch = c.reverse_s > 0 ? std::llround(c.reverse_s / parameters.step_s) : steps;
  for (auto _ : state) {
    Solver motor(parameters);
    double wanted = c.reference;
    for (std::int64_t n = 0; n < steps; wanted = -wanted) {
      motor.set_reference(wanted);
      for (const std::int64_t until = n + stretch; n < until; ++n) motor.step();
    }
    benchmark::DoNotOptimize(motor.speed());
  }
  report(state, 0.02);
  report_error(state, c, label(c, name), [&] {
    Solver motor(parameters);
    return fixed_step_errors(motor, parameters.step_s, c.reference, c.reverse_s, trajectory_file(c),
                             c.judged_s);
  });
}

template <class Solver>
void register_yardstick(const Case& c, const char* name, std::int64_t step_ns) {
  benchmark::RegisterBenchmark(label(c, name).c_str(), run_yardstick<Solver>, c, name, step_ns);
}

}  // namespace

int main(int argc, char** argv) {
  for (const Case& c : cases) {
    benchmark::RegisterBenchmark(label(c, "lean").c_str(), run_lean, c, 0.0);
    benchmark::RegisterBenchmark(label(c, "general").c_str(), run_general, c);
    register_yardstick<Rk4Textbook>(c, "textbook 1 us", 1000);
    register_yardstick<Rk4Textbook>(c, "textbook 0.1 us", 100);
    register_yardstick<Rk4Tuned>(c, "tuned 1 us", 1000);
    register_yardstick<Rk4Tuned>(c, "tuned 0.1 us", 100);
  }
  for (const Case& c : wider_cases) benchmark::RegisterBenchmark(label(c, "general").c_str(), run_general, c);
  // Ten times the duration: the cost per period must not depend on it.
  for (const Case& c : {cases[0], cases[1]}) {
    benchmark::RegisterBenchmark(label(c, "1 s").c_str(), run_lean, c, 1.0);
    benchmark::RegisterBenchmark(label(c, "10 s").c_str(), run_lean, c, 10.0);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

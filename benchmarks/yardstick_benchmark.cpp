// SPDX-License-Identifier: Apache-2.0
// Time per step of the textbook program; the engine's side of the comparison stands beside it.
#include <benchmark/benchmark.h>

#include <cmath>

#include "benchmarks/rk4_yardstick.hpp"

namespace {

using namespace benchmarks;

/// One run of the reference cases' kind, from rest: `seconds` simulated per iteration, reference squared at
/// `period_s`.
void run(benchmark::State& state, YardstickMode mode, double reference, double reverse_s) {
  YardstickParameters parameters{.mode = mode};
  parameters.step_s = 1e-9 * static_cast<double>(state.range(0));
  parameters.steps_per_period = static_cast<int>(30'000 / state.range(0));
  const std::int64_t steps = 20'000'000 / state.range(0);  // 20 ms
  const std::int64_t stretch = reverse_s > 0 ? std::llround(reverse_s / parameters.step_s) : steps;
  for (auto _ : state) {
    Rk4Yardstick motor(parameters);
    double wanted = reference;
    for (std::int64_t n = 0; n < steps; wanted = -wanted) {
      motor.set_reference(wanted);
      for (const std::int64_t until = n + stretch; n < until; ++n) motor.step();
    }
    benchmark::DoNotOptimize(motor.speed());
  }
  const double done = static_cast<double>(steps) * static_cast<double>(state.iterations());
  state.counters["per_step"] =
      benchmark::Counter(done, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["simulated"] = benchmark::Counter(done * parameters.step_s, benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(run, rk4_duty_full, YardstickMode::duty, 1.0, 0.0)->Arg(1000)->Arg(100);
BENCHMARK_CAPTURE(run, rk4_duty_half, YardstickMode::duty, 0.5, 0.0)->Arg(1000)->Arg(100);
BENCHMARK_CAPTURE(run, rk4_current_pi, YardstickMode::current, 5.0, 5e-3)->Arg(1000)->Arg(100);
BENCHMARK_CAPTURE(run, rk4_speed_cascade, YardstickMode::speed, 100.0, 0.0)->Arg(1000)->Arg(100);

}  // namespace

BENCHMARK_MAIN();

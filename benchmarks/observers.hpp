// SPDX-License-Identifier: Apache-2.0
// Measures a run with one observer, for observer_benchmark.
#pragma once
#include <benchmark/benchmark.h>

#include <string>

#include "benchmarks/cases.hpp"

namespace benchmarks {

inline void note(benchmark::State& state, double simulated_s) {
  state.counters["per_period"] =
      benchmark::Counter(simulated_s / period_s * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Measures runs with a new observer each time, returned by `make(prepared)`.
template <class Make>
void measure(benchmark::State& state, const Case& c, Make make) {
  const auto prepared = Prepared::of(c);
  if (!prepared) return state.SkipWithError("the scenario cannot be read");
  for (auto _ : state) {
    auto rig = prepared->rig();
    auto observer = make(*prepared);
    benchmark::DoNotOptimize(sixstep::sim::run(rig, prepared->end(), observer));
    benchmark::DoNotOptimize(observer);
  }
  note(state, prepared->end().seconds());
}

template <class Make>
void add(const Case& c, const char* observer, Make make) {
  benchmark::RegisterBenchmark((std::string(c.name) + "/" + observer).c_str(),
                               [c, make](benchmark::State& state) { measure(state, c, make); });
}

/// Adds the rows "none", "digest" and "energy audit and laws" (observer_audit.cpp).
void add_bare_and_audited(const Case& c);

}  // namespace benchmarks

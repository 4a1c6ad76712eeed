// SPDX-License-Identifier: Apache-2.0
// Measures the cost of the board's analogue front end, in one binary and in CPU time: a board without a front
// end (one branch per segment), the same rig compiled without it, and boards with its parts. Soft chopping at
// half duty from rest, 0.1 s.
//
//   build/dev/benchmarks/front_end_benchmark --benchmark_enable_random_interleaving=true --benchmark_repetitions=20
#include <benchmark/benchmark.h>

#include "sixstep/rig/lean_drive.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/sim/run.hpp"

namespace {

using namespace sixstep;

using Sensed = rig::SensedDrive<double>;
/// A rig calls registers() if it exists. This class deletes registers(), so that the rig has no converters.
struct WithoutConverters : Sensed {
  using Sensed::Sensed;
  void registers() = delete;
};
struct Looking : Sensed {
  using Sensed::Sensed;
  void look_at_terminals(const plant::PerLeg<double>&) {}
};
struct Capturing : Looking {
  using Looking::Looking;
  void captured_crossing(std::uint8_t, const sim::Instant&) {}
};

/// A rig with the maxon EC 45 flat 251601 at 24 V.
template <class Firmware>
rig::Rig<double, Firmware> rig_with(const rig::FrontEndConfig& front_end) {
  rig::BoardConfig board;
  board.front_end = front_end;
  const plant::Plant<double> plant({.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8},
                                   {.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6}, {}, {.V_0_V = 24}, {.bus_V = 24});
  const control::DriveConfig<double> drive{.mode = control::Mode::duty, .nominal_bus_V = 24};
  return {plant, drive, board, {{{}, rig::ActionKind::setpoint, 0.5}}};
}

template <class Firmware>
void run(benchmark::State& state, const rig::FrontEndConfig& front_end) {
  sim::NoObserver nobody;
  std::int64_t segments = 0;
  for (auto _ : state) {
    auto rig = rig_with<Firmware>(front_end);
    segments += sim::run(rig, sim::to_instant(0.1), nobody).segments;
  }
  state.counters["per_segment"] = benchmark::Counter(
      static_cast<double>(segments), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const char* name, auto what, const rig::FrontEndConfig& front_end) {
    benchmark::RegisterBenchmark(name, what, front_end);
  };
  constexpr double divider_s = 20e-6;
  add("compiled without", run<WithoutConverters>, {});
  add("none fitted", run<Sensed>, {});
  add("amplifiers", run<Sensed>, {.amplifier_s = 1e-6});
  add("amplifiers with delay", run<Sensed>, {.amplifier_s = 1e-6, .amplifier_delay_ticks = 1'000'000});
  add("terminals unfiltered", run<Looking>, {});
  add("dividers", run<Looking>, {.divider_s = divider_s});
  add("comparators", run<Capturing>, {.comparators = {.lag_s = divider_s, .hysteresis_V = 0.1}});
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Measures the cost of a core in parallel with the host: calls per second of whole runs in lock-step. Needs
// the emulators and compilers of ./test --target.
//
//   build/dev/benchmarks/loop_benchmark
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "faces/loop/emulator.hpp"
#include "faces/loop/fresh_folder.hpp"
#include "faces/loop/image.hpp"
#include "files/scenario_on_disk.hpp"
#include "sixstep/study/run/run.hpp"

namespace {

using namespace sixstep;

/// Runs the scenario on the core. A new emulator is started before each run, because a core keeps its state.
/// The start is not timed.
void lock_step(benchmark::State& state, const loop::Core& core, const char* file) {
  const base::Result<study::Scenario> scenario =
      files::read_scenario(std::string(SIXSTEP_SOURCE_DIR "/tests/target/scenarios/") + file,
                           {.overrides = {{"control.arithmetic", "q15"}}});
  if (!scenario) return state.SkipWithError(base::to_string(scenario.problems().front()).c_str());
  const base::Result<loop::FreshFolder> folder = loop::FreshFolder::make();
  if (!folder) return state.SkipWithError(base::to_string(folder.problems().front()).c_str());
  const base::Result<std::string> image = loop::compiled_image(core, *scenario, folder->path());
  if (!image) return state.SkipWithError(base::to_string(image.problems().front()).c_str());
  std::uint64_t calls = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto emulator = loop::Emulator::start(core, *image);
    if (!emulator) return state.SkipWithError(base::to_string(emulator.problems().front()).c_str());
    state.ResumeTiming();
    benchmark::DoNotOptimize(study::run(*scenario, {.keep_books = false}, {.beside = (*emulator)->port()}));
    state.PauseTiming();
    calls += (*emulator)->calls();
    emulator->reset();
    state.ResumeTiming();
  }
  state.counters["calls_per_s"] = benchmark::Counter(static_cast<double>(calls), benchmark::Counter::kIsRate);
}

}  // namespace

int main(int argc, char** argv) {
  ::setenv("SIXSTEP_SOURCES", SIXSTEP_SOURCE_DIR, 0);  // no installed sources are beside this program
  for (const loop::Core& core : loop::cores()) {
    if (core.by_registers) continue;  // a whole chip is not called by the host
    for (const char* file : {"current.toml", "speed.toml", "product.toml"})
      benchmark::RegisterBenchmark((std::string(core.name) + "/" + file).c_str(),
                                   [&core, file](benchmark::State& state) { lock_step(state, core, file); })
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

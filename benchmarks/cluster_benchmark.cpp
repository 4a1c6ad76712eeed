// SPDX-License-Identifier: Apache-2.0
// Measures the leader's work for each row from another process of a cluster: it reads the row from a message
// and writes it into the store. The inverse of the rate is the processor time per row, which limits the rate
// of rows of all nodes together (docs/howto/use-a-cluster.md). The rows have the columns of
// data/scenarios/current-square-series.toml: four values of the spread, two figures.
//
//   build/dev/benchmarks/cluster_benchmark
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "batch/letters.hpp"
#include "files/store/plan_store.hpp"

namespace {

namespace analysis = sixstep::analysis;

constexpr std::size_t rows_at_once = 1000;

analysis::RunValues values(std::size_t n) {
  const double x = 1.0 / (1.0 + static_cast<double>(n));
  return {.number = n,
          .point = {},
          .strayed = {x, x / 3, x / 7, x / 11},
          .end = analysis::RunEnd::whole,
          .problem = "",
          .figures = {x / 13, x / 17},
          .digest = 0x9e37'79b9'7f4a'7c15u * n};
}

analysis::TableColumns columns() {
  analysis::PlanColumns c;
  c.strayed = {{"a", "ohm"}, {"b", "mH"}, {"c", "mN m/A"}, {"d", "g cm^2"}};
  c.figures = {{"slowest", "s", true, {}, 1.0}, {"greatest", "A", true, {}, 1.0}};
  return std::make_shared<const analysis::PlanColumns>(std::move(c));
}

analysis::RunRecord row(const analysis::TableColumns& under, std::size_t n) {
  return *analysis::RunRecord::of(under, values(n));
}

std::string letter() {
  batch::letters::Rows rows;
  for (std::size_t n = 0; n < rows_at_once; ++n) rows.rows.push_back(values(n));
  return batch::letters::bytes_of(rows);
}

void count(benchmark::State& state) {
  state.counters["rows"] =
      benchmark::Counter(static_cast<double>(rows_at_once * static_cast<std::size_t>(state.iterations())),
                         benchmark::Counter::kIsRate);
}

void read_rows(benchmark::State& state) {
  const std::string bytes = letter();
  for (auto _ : state) benchmark::DoNotOptimize(batch::letters::read(bytes));
  count(state);
  state.SetLabel(std::to_string(bytes.size() / rows_at_once) + " bytes a row");
}

/// Includes the writer's thread: the time is the processor time of all threads.
void store_rows(benchmark::State& state) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("sixstep_rows_" + std::to_string(::getpid()) + ".sqlite"))
          .string();
  const files::StoredPlan plan{.plan = "{}", .inputs = "0", .columns = columns()};
  std::size_t n = 0;
  {
    sixstep::base::Result<files::PlanStore> store = files::PlanStore::create(path, plan, true);
    if (!store) return state.SkipWithError("no store");
    for (auto _ : state)
      for (std::size_t k = 0; k < rows_at_once; ++k) store->add(row(plan.columns, n++));
    if (!store->finish().empty()) state.SkipWithError("not stored");
  }
  count(state);
  if (n > 0) state.SetLabel(std::to_string(std::filesystem::file_size(path) / n) + " bytes a row");
  std::filesystem::remove(path);
}

BENCHMARK(read_rows);
BENCHMARK(store_rows)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();

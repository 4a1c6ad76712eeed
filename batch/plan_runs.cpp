// SPDX-License-Identifier: Apache-2.0
#include "batch/plan_runs.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

#include "batch/for_each.hpp"
#include "sixstep/study/run/run.hpp"

namespace batch {

std::optional<analysis::RunRecord> row_of_run(const analysis::TableColumns& columns, std::size_t number,
                                              std::vector<std::string> point,
                                              const base::Result<analysis::PlannedRun>& planned,
                                              const std::stop_token& stop) {
  bool cut = false;
  const auto keep_going = [&](double) {
    cut = cut || stop.stop_requested();
    return !cut;
  };
  const study::Listeners listeners{.keep_going = keep_going, .keep_books = false};
  const base::Result<study::Outcome> result =
      planned ? study::run(planned->scenario, listeners) : base::Result<study::Outcome>(planned.problems());
  if (cut) return {};
  return analysis::record_of(columns, number, std::move(point), planned, result);
}

std::optional<analysis::RunRecord> run_one(const PlanRuns& runs, std::size_t n) {
  return row_of_run(runs.columns, n, analysis::point_of_run(runs.plan, n), runs.scenario(n), runs.stop);
}

void run_plan(const PlanRuns& runs) {
  const std::size_t count = analysis::runs_of(runs.plan);
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = std::min<std::size_t>(runs.jobs == 0 ? cores : runs.jobs, count);
  std::atomic<std::size_t> next{0};
  make_runs(runs, static_cast<unsigned>(threads), [&]() -> std::optional<std::size_t> {
    for (std::size_t n = next++; n < count; n = next++)
      if (!runs.wanted || runs.wanted(n)) return n;
    return {};
  });
}

void make_runs(const PlanRuns& runs, unsigned threads,
               const std::function<std::optional<std::size_t>()>& next) {
  std::atomic<bool> failed{false};
  for_each(threads, threads, [&](std::size_t) {
    try {
      while (!failed && !runs.stop.stop_requested()) {
        const std::optional<std::size_t> n = next();
        if (!n) return;
        if (std::optional<analysis::RunRecord> record = run_one(runs, *n)) runs.take(std::move(*record));
      }
    } catch (...) {
      failed = true;
      throw;
    }
  });
}

}  // namespace batch

// SPDX-License-Identifier: Apache-2.0
// Makes a plan's runs on all cores. Each run is equal, to the bit, to the same run made alone, because runs
// share no data.
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/rooms.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"
#include "sixstep/base/result.hpp"

namespace batch {

struct PlanRuns {
  const analysis::Plan& plan;
  analysis::TableColumns columns;
  /// Returns the scenario of run n; Problems become the run's row. Several threads call it at the same time.
  std::function<base::Result<analysis::PlannedRun>(std::size_t n)> scenario;
  /// Returns true if run n is to be made; empty: all runs are made. Several threads call it at the same time.
  std::function<bool(std::size_t n)> wanted;
  /// Receives each row when its run ends, in any order; several threads call it at the same time.
  std::function<void(analysis::RunRecord&&)> take;
  std::stop_token stop;  ///< also ends the runs in progress, which then return no row
  unsigned jobs = 0;     ///< number of threads; 0: one per core
};

/// Makes a run and its row. Empty if the run was stopped before its end.
std::optional<analysis::RunRecord> row_of_run(const analysis::TableColumns& columns, std::size_t number,
                                              std::vector<std::string> point,
                                              const base::Result<analysis::PlannedRun>& planned,
                                              const std::stop_token& stop);

/// Calls row_of_run() for one run of the plan.
std::optional<analysis::RunRecord> run_one(const PlanRuns& runs, std::size_t n);

/// Makes all wanted runs. An exception that one of the functions throws is rethrown here.
void run_plan(const PlanRuns& runs);

/// Makes the runs that `next` returns, on `threads` threads, until `next` returns none or the work is
/// stopped. Each thread calls `next`, which may block. Exceptions are handled as in run_plan().
void make_runs(const PlanRuns& runs, unsigned threads,
               const std::function<std::optional<std::size_t>()>& next);

}  // namespace batch

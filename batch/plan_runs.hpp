// SPDX-License-Identifier: Apache-2.0
// A plan's runs on all cores. Each is what it would be alone, to the bit: nothing is shared between them.
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
  /// Run n; Problems are its row. Called on any thread, several at once.
  std::function<base::Result<analysis::PlannedRun>(std::size_t n)> scenario;
  /// Whether run n is to be made; without it all are. Called as `scenario`.
  std::function<bool(std::size_t n)> wanted;
  /// Each row as its run ends, in whatever order; on any thread, several at once.
  std::function<void(analysis::RunRecord&&)> take;
  std::stop_token stop;  ///< ends the runs under way, too: they leave no row
  unsigned jobs = 0;     ///< threads; 0: one per core
};

/// Makes a run and its row, if it came to an end before it was stopped.
std::optional<analysis::RunRecord> row_of_run(const analysis::TableColumns& columns, std::size_t number,
                                              std::vector<std::string> point,
                                              const base::Result<analysis::PlannedRun>& planned,
                                              const std::stop_token& stop);

/// One run of the plan, as above.
std::optional<analysis::RunRecord> run_one(const PlanRuns& runs, std::size_t n);

/// All that are wanted. An exception of one of the functions is thrown again here.
void run_plan(const PlanRuns& runs);

/// The runs that `next` names, until it names none or they are stopped, on `threads` threads. Each asks for itself, and may be
/// let wait. Exceptions as above.
void make_runs(const PlanRuns& runs, unsigned threads,
               const std::function<std::optional<std::size_t>()>& next);

}  // namespace batch

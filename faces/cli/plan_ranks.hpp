// SPDX-License-Identifier: Apache-2.0
// Runs sixstep as one of several processes that mpirun started. The first process runs the program; the
// others make the runs that it sends them.
#pragma once
#include <functional>

#include "batch/plan_runs.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Returns the program's exit code in all processes. Only the first process calls `program`, reads, prints
/// and writes.
Exit among_ranks(const std::function<Exit()>& program);

/// Threads that make runs, summed over all processes; `jobs` as in batch::PlanRuns.
unsigned threads_for_runs(unsigned jobs);

/// Makes the plan's runs with all processes. A single process works like batch::run_plan().
void make(const batch::PlanRuns& runs, const ReadPlan& plan);

}  // namespace cli

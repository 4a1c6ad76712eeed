// SPDX-License-Identifier: Apache-2.0
// Runs sixstep as one of several processes that mpirun started. The first process runs the program. It sends
// runs to the other processes, which simulate them.
#pragma once
#include <functional>

#include "batch/plan_runs.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Runs `program` in the first process; only this process reads, prints and writes files. Returns the
/// program's exit code in all processes.
Exit among_ranks(const std::function<Exit()>& program);

/// Number of threads that make runs, in all processes together; `jobs` as in batch::PlanRuns.
unsigned threads_for_runs(unsigned jobs);

/// Makes the plan's runs with all processes. A single process works like batch::run_plan().
void make(const batch::PlanRuns& runs, const ReadPlan& plan);

}  // namespace cli

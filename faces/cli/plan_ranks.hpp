// SPDX-License-Identifier: Apache-2.0
// sixstep as one of several processes that mpirun started: the first is the program, the others make the runs that it hands them.
#pragma once
#include <functional>

#include "batch/plan_runs.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// The program's exit, in all of them: only the first calls `program`, reads, prints and writes.
Exit among_ranks(const std::function<Exit()>& program);

/// Threads that make runs, of all processes there are; `jobs` as in batch::PlanRuns.
unsigned threads_for_runs(unsigned jobs);

/// The plan's runs, made by all processes there are; by this one alone on its threads as batch::run_plan() does.
void make(const batch::PlanRuns& runs, const ReadPlan& plan);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
// From the words behind `sixstep run`, or from a plan file, to the runs that are to be made.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "faces/cli/run_command.hpp"
#include "files/store/plan_store.hpp"
#include "files/trace/trace_origin.hpp"
#include "text/plan/planned_scenarios.hpp"

namespace cli {

struct ReadPlan {
  std::string name;  ///< the file's stem
  std::string title, notes;
  std::string minimise;  ///< of a plan that is to be optimised
  std::size_t evaluations = 0;
  std::unique_ptr<text::PlannedScenarios> scenarios;
  study::Scenario nominal;
  analysis::TableColumns columns;
  files::TraceOrigin origin;
};

/// Many runs are asked for: by an option, or by a file that is a plan.
bool plans(const RunArguments& arguments, const std::string& file);

/// The file is a scenario, or a plan that names one.
base::Result<ReadPlan> read_plan(const std::string& file, const RunArguments& arguments);

/// Of one run of the plan alone; its command is the plan's.
files::TraceOrigin origin_of_run(const ReadPlan& plan, std::uint64_t number);

/// The store that the runs go into: --store, or one beside the other outputs of --out; empty: one that goes with the program.
std::string store_path(const RunArguments& arguments, const std::string& name);

}  // namespace cli

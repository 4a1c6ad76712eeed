// SPDX-License-Identifier: Apache-2.0
// Reads the arguments of `sixstep run`, or a plan file, as a plan.
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
  std::string name;  ///< stem of the file's name
  std::string title, notes;
  std::string minimise;  ///< figure to minimise; empty: none
  std::size_t evaluations = 0;
  std::unique_ptr<text::PlannedScenarios> scenarios;
  study::Scenario nominal;
  analysis::TableColumns columns;
  files::TraceOrigin origin;
};

/// Whether many runs are requested: by an option, or because the file is a plan.
bool plans(const RunArguments& arguments, const std::string& file);

/// Reads the plan. `file` is a scenario, or a plan that names one.
base::Result<ReadPlan> read_plan(const std::string& file, const RunArguments& arguments);

/// The origin of one run of the plan, with the command that runs the plan.
files::TraceOrigin origin_of_run(const ReadPlan& plan, std::uint64_t number);

/// The path of the store: --store, or a file in the folder of --out. Empty: the store is temporary.
std::string store_path(const RunArguments& arguments, const std::string& name);

}  // namespace cli

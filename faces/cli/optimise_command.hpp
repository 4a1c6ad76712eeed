// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

struct OptimiseArguments {
  std::string plan;   ///< path of a plan with `minimise`
  std::string store;  ///< store for every evaluation; empty: none
  bool resume = false, force = false, quiet = false;
  std::string toml, json, data_dir, command;
  unsigned jobs = 0;
};

/// `sixstep design --optimise PLAN`: searches the plan's ranges for the least value of a figure at which
/// every drive meets every requirement. Also names the requirements that limit the figure.
Exit optimise_command(const OptimiseArguments& arguments);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

struct OptimiseArguments {
  std::string plan;   ///< a file with `minimise`
  std::string store;  ///< stores every evaluation; empty: none
  bool resume = false, force = false, quiet = false;
  std::string toml, json, data_dir, command;
  unsigned jobs = 0;
};

/// `sixstep design --optimise PLAN`: the point of its ranges with the least value of a figure at which every
/// drive holds, and the requirements that limit it.
Exit optimise_command(const OptimiseArguments& arguments);

}  // namespace cli

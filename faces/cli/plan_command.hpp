// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/run_command.hpp"

namespace cli {

/// Runs the plans that the files and options of `sixstep run` define, and writes the store, tables and files.
/// The option --runs also defines a plan.
Exit plan_command(const RunArguments& arguments);

}  // namespace cli

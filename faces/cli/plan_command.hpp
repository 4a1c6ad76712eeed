// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/run_command.hpp"

namespace cli {

/// Runs the plans that the arguments of `sixstep run` make of its files: rows into a store, tables, files.
/// --runs is one of these arguments.
Exit plan_command(const RunArguments& arguments);

}  // namespace cli

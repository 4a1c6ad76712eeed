// SPDX-License-Identifier: Apache-2.0
// sixstep run --runs: the series of drives that each scenario's [[spread]] describes.
#pragma once
#include <vector>

#include "faces/cli/job.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

Exit series_command(const RunArguments& arguments, const std::vector<Job>& jobs);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/job.hpp"

namespace cli {

struct RunArguments;

/// Several files and one page, nothing else.
bool compares(const RunArguments& arguments);

/// sixstep run A B .. --html FILE: runs them all and lays them over each other on one page.
Exit compare_command(const RunArguments& arguments, const std::vector<Job>& jobs);

/// What is wrong with comparing these: too many for a page.
base::Problems check_comparison(const RunArguments& arguments);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/job.hpp"

namespace cli {

struct RunArguments;

/// Several files and one page, nothing else; or one that runs on the host and on a chip (lays_over); or one with a board's log.
bool compares(const RunArguments& arguments);

/// --on names a map of a firmware of one's own.
bool names_own_firmware(const RunArguments& arguments);
/// --on names a chip that runs a program of its own.
bool on_a_chip(const RunArguments& arguments);
/// One file on a chip that is no copy of the host's drive: what both do is laid over each other.
bool lays_over(const RunArguments& arguments);

/// sixstep run A B .. --html FILE: runs them all and lays them over each other on one page. With --compare LOG a board's log lies over
/// the one run, on the page, where one is wanted, and in numbers.
Exit compare_command(const RunArguments& arguments, const std::vector<Job>& jobs);

/// What is wrong with comparing these: too many for a page, or more than a log's.
base::Problems check_comparison(const RunArguments& arguments);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/job.hpp"

namespace cli {

struct RunArguments;

/// Whether runs are compared. This is the case for one run with a board's log. It is also the case for
/// several files if --html is the only output, and for one file if lays_over() is true.
bool compares(const RunArguments& arguments);

/// Whether --on names a map of a user's own firmware.
bool names_own_firmware(const RunArguments& arguments);
/// Whether --on names a chip whose program is not the host's drive.
bool on_a_chip(const RunArguments& arguments);
/// Whether one file runs on the host and on a chip with another program than the host's drive, so that the
/// page overlays both results.
bool lays_over(const RunArguments& arguments);

/// `sixstep run A B .. --html FILE`: runs all files and overlays them on one page. With --compare LOG,
/// compares the only run with a board's log, in numbers and, if --html is given, on the page.
Exit compare_command(const RunArguments& arguments, const std::vector<Job>& jobs);

/// Problems of a comparison: too many runs for a page, or more than one run with a log.
base::Problems check_comparison(const RunArguments& arguments);

}  // namespace cli

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "report/comparison.hpp"

namespace report {

/// The colour of a run's curves, by the run's index.
const char* run_style(std::size_t place);

/// The JSON that report.js draws: for each quantity, a chart with all runs, and below it a chart with the
/// differences from the first run.
std::string comparison_data(const std::vector<ComparedRun>& runs);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "report/comparison.hpp"

namespace report {

/// The colour of a run's curves, by its place.
const char* run_style(std::size_t place);

/// The JSON that report.js draws: each quantity of all runs in one chart, and below it the differences from
/// the first run.
std::string comparison_data(const std::vector<ComparedRun>& runs);

}  // namespace report

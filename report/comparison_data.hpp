// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "report/comparison.hpp"

namespace report {

/// Of a run, by its place: the colour of its curves.
const char* run_style(std::size_t place);

/// What report.js draws: each quantity of all runs in one chart, and below it the differences to the first.
std::string comparison_data(const std::vector<ComparedRun>& runs);

}  // namespace report

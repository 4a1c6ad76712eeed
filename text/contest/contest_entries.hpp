// SPDX-License-Identifier: Apache-2.0
// The scenarios of a comparison of controllers, read as if a file had been written for each.
#pragma once
#include <vector>

#include "sixstep/analysis/contest/contest.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {

/// The common scenario with the keys of each row, as --set would have them. Where this motor or board does not let a controller be,
/// its entry has the Problems. `resolve` finds the motor.
std::vector<analysis::ContestEntry> contest_entries(
    const analysis::ContestBench& bench, const Resolve& resolve,
    std::span<const analysis::Contestant> all = analysis::contestants());

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Makes the scenario of each controller in a comparison of controllers.
#pragma once
#include <vector>

#include "sixstep/analysis/contest/contest.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {

/// Reads the common scenario once per row of `all`, with the keys of that row applied as by --set. An entry
/// has Problems if the controller is impossible with this motor or board. `resolve` returns the motor's sheet
/// by its name.
std::vector<analysis::ContestEntry> contest_entries(
    const analysis::ContestBench& bench, const Resolve& resolve,
    std::span<const analysis::Contestant> all = analysis::contestants());

}  // namespace text

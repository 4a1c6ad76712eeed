// SPDX-License-Identifier: Apache-2.0
// Prints the difference between a board's log and its simulation.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "text/rooms.hpp"

namespace text {

/// One line that names the compared logs, one line per column, then the notes on the log. `name` is the log's
/// name.
std::string trace_comparison_text(const std::string& name,
                                  const std::vector<analysis::TraceComparison>& columns, double shift_s,
                                  const std::vector<std::string>& notes);

}  // namespace text

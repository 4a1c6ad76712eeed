// SPDX-License-Identifier: Apache-2.0
// How far a board's log lies from its simulation, for people.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/identification/log/trace_comparison.hpp"
#include "text/rooms.hpp"

namespace text {

/// A line that says what is compared, then one for each column, then what is to be known of the log. `name` is the log's.
std::string trace_comparison_text(const std::string& name,
                                  const std::vector<analysis::TraceComparison>& columns, double shift_s,
                                  const std::vector<std::string>& notes);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// How far a board's log lies from its simulation, for people.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/bench/log/laid_over.hpp"
#include "text/rooms.hpp"

namespace text {

/// A line that says what is compared, then one for each column, then what is to be known of the log. `name` is the log's.
std::string laid_over_text(const std::string& name, const std::vector<analysis::LaidOver>& columns,
                           double shift_s, const std::vector<std::string>& notes);

}  // namespace text

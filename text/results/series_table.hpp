// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "sixstep/analysis/statistics/series.hpp"
#include "text/rooms.hpp"

namespace text {

/// Many runs for the terminal: the spread of each figure, the number of runs that meet each requirement,
/// failures, and the command that repeats one run. An interrupted plan also shows the planned number of runs.
std::string series_table(const std::string& name, const analysis::Series& series, const analysis::Plan& plan);

// Parts of the table, for callers that print the figures in another form. One line each: the number of
// stopped runs, the number of refused runs, and for each requirement the first run that misses it.
std::string casualties_text(const analysis::Series& series, const analysis::Plan& plan);
/// The first part of casualties_text(): the number of stopped or refused runs, and the reason of the first.
std::string stopped_text(const analysis::Series& series, const analysis::Plan& plan);
/// Each remark with the runs that have it, one line each. Numbers in a remark come from the first of these
/// runs.
std::string remarks_text(const analysis::Series& series, const analysis::Plan& plan);
/// The last line: "1000 drives, seed 1: all hold every requirement".
std::string series_sum(const analysis::Series& series, const analysis::Plan& plan);
/// The options that repeat only run `number`: "--only 12".
std::string repeats_text(const analysis::Plan& plan, std::size_t number);

}  // namespace text

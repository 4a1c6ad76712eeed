// SPDX-License-Identifier: Apache-2.0
// What the columns of a plan's table are called, in its CSV and in its store alike.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/rooms.hpp"

namespace text {

/// Columns that every table of a plan has: these before those of its own, those behind them.
inline constexpr std::string_view columns_before[] = {"run", "end", "passed"};
inline constexpr std::string_view columns_behind[] = {"problem", "digest"};

/// The table's own columns with their units: keys, strayed values, figures. What acts in a name is shown (escape.hpp); no two are
/// alike, whatever labels are, for one that is taken gets a number.
std::vector<std::string> column_names(const analysis::PlanColumns& columns);

}  // namespace text

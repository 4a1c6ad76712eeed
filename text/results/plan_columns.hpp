// SPDX-License-Identifier: Apache-2.0
// Names the columns of a plan's table, in its CSV and in its store.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "text/rooms.hpp"

namespace text {

/// Columns that every plan's table has. columns_before precede the plan's own columns; columns_behind follow
/// them.
inline constexpr std::string_view columns_before[] = {"run", "end", "passed"};
inline constexpr std::string_view columns_behind[] = {"problem", "digest"};

/// The table's own columns with units: keys, values of the spread, figures. Control characters are made
/// visible (escape.hpp). All names differ: a repeated name gets a number.
std::vector<std::string> column_names(const analysis::PlanColumns& columns);

}  // namespace text

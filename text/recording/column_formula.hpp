// SPDX-License-Identifier: Apache-2.0
// Reads a formula such as "speed=erpm*2*pi/60/7": a column of a recording times constants becomes a column of
// a trace.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct ColumnFormula {
  std::string name;    ///< left side: time, or a column of a trace
  std::string column;  ///< heading of the column in the recording, or its position ("column 3")
  double factor = 1.0;
  bool scaled = false;  ///< true: the formula has constants, and the unit in the heading is ignored
};

/// Reads a formula. Constants are numbers and pi, multiplied or divided, before or after the column. A
/// Problem's `where` is "columns".
base::Result<ColumnFormula> column_formula(std::string_view text);

}  // namespace text

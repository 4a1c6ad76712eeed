// SPDX-License-Identifier: Apache-2.0
// Reads "speed=erpm*2*pi/60/7": a column of a recording, times constants, as a column of a trace.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct ColumnFormula {
  std::string name;    ///< its meaning: time, or a column of a trace
  std::string column;  ///< heading or place in the recording
  double factor = 1.0;
  bool scaled = false;  ///< the formula has constants; then the unit in the heading is ignored
};

/// Constants are numbers and pi, multiplied or divided, before or after the column. A Problem's `where` is
/// "columns".
base::Result<ColumnFormula> column_formula(std::string_view text);

}  // namespace text

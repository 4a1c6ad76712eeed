// SPDX-License-Identifier: Apache-2.0
// "speed=erpm*2*pi/60/7": which column of a recording is what, times constants.
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct ColumnFormula {
  std::string name;    ///< what it is: time, or a column of a trace
  std::string column;  ///< heading, or place, in the recording
  double factor = 1.0;
  bool scaled =
      false;  ///< with constants: then the numbers count as they stand, whatever unit their heading says
};

/// Constants are numbers and pi, multiplied or divided, before the column or behind it. The Problem is of the place "columns".
base::Result<ColumnFormula> column_formula(std::string_view text);

}  // namespace text

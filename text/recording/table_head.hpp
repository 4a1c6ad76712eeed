// SPDX-License-Identifier: Apache-2.0
// Finds names and units of a table's columns in the lines above its rows.
#pragma once
#include <string>
#include <vector>

#include "text/recording/recording.hpp"

namespace text {

struct LinesAbove {
  const std::vector<std::string>& lines;    ///< preamble and headings
  const std::vector<std::string>& remarks;  ///< lines with '#' or '%' as the first character
  char separator;
  std::size_t cells_before = 0;  ///< number of cells before the row's own first cell
};

/// Sets columns, clock and has_headings. Returns the number of cells in the line of headings, 0 if there is
/// none.
std::size_t take_head(const LinesAbove& above, std::size_t cells, Recording& out);

}  // namespace text

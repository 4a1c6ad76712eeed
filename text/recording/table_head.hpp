// SPDX-License-Identifier: Apache-2.0
// Names and units of a table's columns, from the lines above its rows.
#pragma once
#include <string>
#include <vector>

#include "text/recording/recording.hpp"

namespace text {

struct LinesAbove {
  const std::vector<std::string>& lines;    ///< preamble and headings
  const std::vector<std::string>& remarks;  ///< lines that begin with '#' or '%'
  char separator;
  std::size_t cells_before = 0;  ///< of the row's own: what stands beside it
};

/// Fills columns, clock and has_headings; the number of cells that the line of headings has, 0 where there is none.
std::size_t take_head(const LinesAbove& above, std::size_t cells, Recording& out);

}  // namespace text

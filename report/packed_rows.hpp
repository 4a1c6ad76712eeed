// SPDX-License-Identifier: Apache-2.0
// Packs every row of a run into the page, if the packed rows are small enough. Close-ups then show every row
// also where the chart shows an envelope.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace report {

/// The packed rows. Values are counts of 1/65533 of their column's range. Times are counts of a picosecond,
/// or of a coarser unit if the time between two rows exceeds 4 ms. Both are stored as differences from row to
/// row, in planes of bytes of equal significance, compressed by zlib.
struct PackedRows {
  struct Column {
    double low = 0.0, step = 0.0;  ///< value = low + step * count; the count 65535 is "no number"
  };
  std::size_t rows = 0;
  double start_s = 0.0, tick_s = 0.0;
  std::vector<Column> columns{};
  std::string bytes{};  ///< compressed: four planes of the times, then two planes of each column
};

/// Empty if the packed rows exceed `most_bytes`, or if compression is not available.
std::optional<PackedRows> packed_rows(const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes);

}  // namespace report

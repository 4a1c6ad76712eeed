// SPDX-License-Identifier: Apache-2.0
// Packs every row of a run whose rows then fit into the page. Close-ups thus show every row if an envelope
// replaces the rows otherwise.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace report {

/// The packed rows. Columns are in 65535 steps of their range. Times are in whole picoseconds, or in a
/// coarser unit if the time between rows exceeds 4.29 ms. Both are stored as differences from row to row, in
/// planes of bytes of equal weight, compressed by zlib.
struct PackedRows {
  struct Column {
    double low = 0.0, step = 0.0;  ///< value = low + step * count; the count 65535 is "no number"
  };
  std::size_t rows = 0;
  double start_s = 0.0, tick_s = 0.0;
  std::vector<Column> columns{};
  std::string bytes{};  ///< compressed: 4 planes of the times, then 2 of each column
};

/// Empty if the compressed rows exceed `most_bytes`, or if no compression is available.
std::optional<PackedRows> packed_rows(const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Every row of a run small enough to send: for the close looks at what an envelope stands for otherwise.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace report {

/// Columns in 65535 steps of their range, times in whole picoseconds (more where a gap is longer than 4.29
/// ms), both as differences from row to row, byte by byte of equal weight, compressed (zlib).
struct PackedRows {
  struct Column {
    double low = 0.0, step = 0.0;  ///< value = low + step * count; the count 65535 is "no number"
  };
  std::size_t rows = 0;
  double start_s = 0.0, tick_s = 0.0;
  std::vector<Column> columns{};
  std::string bytes{};  ///< compressed: 4 planes of the times, then 2 of each column
};

/// Empty where the compressed rows are larger than `most_bytes`, or nothing can be compressed.
std::optional<PackedRows> packed_rows(const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes);

}  // namespace report

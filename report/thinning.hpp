// SPDX-License-Identifier: Apache-2.0
// Reduces the number of rows without a visible change of the picture: no peak is lost.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace report {

struct Interval {
  double from = 0.0, to = 0.0;
  bool holds(double t) const { return from <= t && t <= to; }
};

using Curves = std::vector<std::span<const double>>;

struct Thinned {
  std::vector<std::size_t> rows;  ///< numbers of the selected rows, rising
  bool complete = true;           ///< false: an envelope replaces the rows outside the kept intervals
};

/// The rows that draw these curves over one time axis. Rows without effect on the drawing are left out. If
/// more than `full` rows remain, time is divided into equal buckets. Each bucket keeps the first, lowest,
/// highest and last row of each curve, at most `cap` rows in total. Within the intervals `keep`, every row is
/// kept.
Thinned thinned(std::span<const double> time, const Curves& curves, std::span<const Interval> keep,
                std::size_t cap, std::size_t full);

/// Selects from these rows the first and the last row, and the lowest and the highest row of each curve, in
/// each of `buckets` equal intervals of time: at most 2 + 2 N rows per interval for N curves.
std::vector<std::size_t> envelope(std::span<const double> time, const std::vector<std::size_t>& rows,
                                  const Curves& curves, std::size_t buckets);

}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Finds the time of each row of a recording.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "text/recording/columns.hpp"

namespace text {

/// The column of time by its heading or its unit; without headings the first of several columns. Null if
/// there is none.
const RecordedColumn* time_column(const Recording& recording);

struct Times {
  std::vector<double> t_s;            ///< rising
  std::vector<std::size_t> left_out;  ///< rows with the same time as the next row
  const RecordedColumn* column = nullptr;
};

/// Finds the times. `notes` lists the assumptions. Problems: no time, a time that does not rise, a
/// contradiction to the preamble.
/// - With an interval: the interval, which must not contradict a column of time or the preamble's rate.
/// - Without an interval: the column of time, whose unit the preamble's rate may determine; else the
///   preamble's rate.
/// - If a time occurs twice, because a simulator writes an event as two rows, the later row is used.
base::Result<Times> times_of(const Recording& recording, std::optional<double> interval_s, Notes& notes);

/// Like times_of(), for values that are already times in s.
base::Result<Times> rising_times(const Recording& recording, std::vector<double> t_s,
                                 const RecordedColumn& column, Notes& notes);

/// Like rising_times(), with a given interval, which only restores digits that the values do not have.
base::Result<Times> times_at_interval(const Recording& recording, std::vector<double> t_s,
                                      const RecordedColumn& column, double interval_s, Notes& notes);

/// The values without the values of the left-out rows.
template <class Value>
std::vector<Value> without_rows(std::vector<Value> values, const std::vector<std::size_t>& left_out) {
  std::size_t to = 0, next = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (next < left_out.size() && left_out[next] == n)
      ++next;
    else
      values[to++] = values[n];
  }
  values.resize(to);
  return values;
}

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// When each row of a recording was taken.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "text/recording/columns.hpp"

namespace text {

/// By its heading or its unit; the first of several columns without headings. Null where there is none.
const RecordedColumn* time_column(const Recording& recording);

struct Times {
  std::vector<double> t_s;            ///< rising
  std::vector<std::size_t> left_out;  ///< rows that the next one stands at the instant of
  const RecordedColumn* column = nullptr;
};

/// Of the column that says the time, whose unit the preamble's rate may say; or of the preamble's rate, where there is none; or so far apart
/// as an interval that is given, which must not contradict a column of time or a preamble's rate. Where an instant stands twice, as simulators write an event, the later row counts. `notes` gets what was
/// taken for what. Problems: no time, a time that does not rise, one that contradicts the preamble.
base::Result<Times> times_of(const Recording& recording, std::optional<double> interval_s, Notes& notes);

/// The same of values that are the times already.
base::Result<Times> rising_times(const Recording& recording, std::vector<double> t_s,
                                 const RecordedColumn& column, Notes& notes);

/// The same beside an interval that is given: it says what digits the values lack, and nothing else.
base::Result<Times> times_at_interval(const Recording& recording, std::vector<double> t_s,
                                      const RecordedColumn& column, double interval_s, Notes& notes);

/// Of the rows that count.
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

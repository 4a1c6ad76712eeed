// SPDX-License-Identifier: Apache-2.0
// A recorded run.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace sixstep::study {

/// A trace column: name with unit suffix as in the CSV header, unit and frame in words.
struct Column {
  std::string name;   // "i_a_A"
  std::string unit;   // "A"
  std::string frame;  // "phase, into the motor"
  std::string meaning;
  double per_turning = 1.0;  // factor from the rotary motor's unit to the linear motor's, such as 1000 mm per
                             // rad
};

struct TimeSpan {
  double from_s = 0.0, to_s = 0.0;
};

/// Column-major: values[c][row]. Rows are in time order; at a jump both sides are present, with equal times.
struct Trace {
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;
  bool every_event = false;  // true: rows at every event; false: rows on a grid
  /// Intervals in which all rows are kept, in time order; empty: the whole run. Outside of them an envelope
  /// replaces the rows: each short interval keeps only the rows where a column is lowest or highest.
  std::vector<TimeSpan> whole{};
  std::size_t left_out = 0;  // number of rows that the envelope replaces
};

}  // namespace sixstep::study

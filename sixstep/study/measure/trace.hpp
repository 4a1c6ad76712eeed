// SPDX-License-Identifier: Apache-2.0
// A Trace is a recorded run.
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
  double per_turning =
      1.0;  // of a linear motor's column: its number over the turning motor's, 1000 mm for a rad
};

struct TimeSpan {
  double from_s = 0.0, to_s = 0.0;
};

/// Column-major: values[c][row]. Rows are in time order; at a jump both sides stand, with equal times.
struct Trace {
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;
  bool every_event = false;  // else on a grid
  /// Where every row stands, rising; empty: everywhere. Elsewhere an envelope stands for the rows: of each
  /// short stretch those where a column is lowest or highest.
  std::vector<TimeSpan> whole{};
  std::size_t left_out = 0;  // rows that an envelope stands for
};

}  // namespace sixstep::study

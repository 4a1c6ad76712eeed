// SPDX-License-Identifier: Apache-2.0
// What a recorded run looks like.
#pragma once
#include <string>
#include <vector>

namespace sixstep::study {

/// A trace column: name with unit suffix as in the CSV header, unit and frame in words.
struct Column {
  std::string name;   // "i_a_A"
  std::string unit;   // "A"
  std::string frame;  // "phase, into the motor"
  std::string meaning;
};

/// Column-major: values[c][row]. Rows are in time order; at a jump both sides stand, with equal times.
struct Trace {
  std::vector<Column> columns;
  std::vector<std::vector<double>> values;
  bool every_event = false;  // else on a grid
};

}  // namespace sixstep::study

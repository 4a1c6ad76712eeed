// SPDX-License-Identifier: Apache-2.0
// Groups rows into stays: the time of each code between two changes.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"

namespace sixstep::analysis {

/// A code and the time for which it lasted. It began at some instant of [came_after_s, came_before_s],
/// between the last row of the code before and the first row of this code.
struct Stay {
  std::uint8_t code = 0;
  double came_after_s = 0.0, came_before_s = 0.0;
  double left_s = 0.0;  ///< first row of the next stay; for the last stay the log's last row

  double duration_s() const { return left_s - came_before_s; }
};

/// Stays of the log: a new stay begins at the first row and at each change of code. If each row is a change,
/// the times are exact.
std::vector<Stay> stays_of(const HallLog& log);
bool rows_are_changes(const HallLog& log);

}  // namespace sixstep::analysis

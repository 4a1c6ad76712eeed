// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_runs.hpp"

namespace sixstep::analysis {

bool rows_are_changes(const HallLog& log) {
  std::size_t changes = 0;
  for (std::size_t n = 1; n < log.codes.size(); ++n)
    if (log.codes[n] != log.codes[n - 1]) ++changes;
  return log.voltages == RecordedVoltages::none && log.codes.size() > 4 &&
         10 * changes > 7 * (log.codes.size() - 1);
}

std::vector<Stay> stays_of(const HallLog& log) {
  const bool exact = rows_are_changes(log);
  std::vector<Stay> stays;
  for (std::size_t n = 0; n < log.codes.size(); ++n) {
    if (n > 0 && log.codes[n] == log.codes[n - 1]) continue;
    if (n > 0) stays.back().left_s = log.t_s[n];
    stays.push_back({log.codes[n], exact || n == 0 ? log.t_s[n] : log.t_s[n - 1], log.t_s[n], 0.0});
  }
  if (!stays.empty()) stays.back().left_s = log.t_s.back();
  return stays;
}

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_log.hpp"

#include "sixstep/analysis/identification/monotonic.hpp"

namespace sixstep::analysis {

base::Problems check(const HallLog& log) {
  const std::size_t rows = log.t_s.size();
  if (rows < 2)
    return {{.where = "time",
             .value = std::to_string(rows) + " rows",
             .limit = "are too few",
             .cure = "record the Hall lines while the shaft turns"}};
  if (base::Problems wrong = check_times(log.t_s); !wrong.empty()) return wrong;
  if (log.codes.size() != rows)
    return {{.where = "hall",
             .value = std::to_string(log.codes.size()) + " codes",
             .limit = "must have one value for each of " + std::to_string(rows) + " times",
             .cure = "give columns of equal length"}};
  for (std::size_t n = 0; n < rows; ++n)
    if (log.codes[n] > 7)
      return {{.where = "hall",
               .value = std::to_string(log.codes[n]),
               .limit = "in row " + std::to_string(n + 1) + " must be a code of three bits, 0 to 7",
               .cure = "compute the code as 4 H1 + 2 H2 + H3"}};
  if (log.voltages == RecordedVoltages::none) return {};
  const bool lines = log.voltages == RecordedVoltages::lines;
  const char* const names[2][3] = {{"u_a", "u_b", "u_c"}, {"u_ab", "u_bc", "u_ca"}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == 2 && lines && log.u_V[k].empty()) continue;
    if (base::Problems wrong = check_column(names[lines ? 1 : 0][k], log.u_V[k], rows); !wrong.empty())
      return wrong;
  }
  return {};
}

}  // namespace sixstep::analysis

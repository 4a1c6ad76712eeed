// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/emf_record.hpp"

#include "sixstep/analysis/identification/monotonic.hpp"

namespace sixstep::analysis {

base::Problems check(const EmfRecord& record) {
  constexpr std::size_t fewest_rows = 16;
  if (record.channels.empty() || record.channels.size() > most_emf_channels)
    return {{.where = "channels",
             .value = std::to_string(record.channels.size()),
             .limit = "must be 1 to " + std::to_string(most_emf_channels) + " voltages",
             .cure = "name the voltage columns"}};
  if (record.t_s.size() < fewest_rows)
    return {{.where = "time",
             .value = std::to_string(record.t_s.size()) + " rows",
             .limit = "are too few",
             .cure = "record at least a hundred rows per period, and at least two periods"}};
  if (base::Problems wrong = check_times(record.t_s); !wrong.empty()) return wrong;
  for (const EmfChannel& c : record.channels)
    if (base::Problems wrong = check_column(c.name, c.u_V, record.t_s.size()); !wrong.empty()) return wrong;
  return {};
}

}  // namespace sixstep::analysis

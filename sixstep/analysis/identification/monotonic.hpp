// SPDX-License-Identifier: Apache-2.0
// Checks times and columns of a recording.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sixstep/base/problem.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {

/// A Problem if times are not finite or do not rise.
inline base::Problems check_times(const std::vector<double>& t_s) {
  for (std::size_t n = 0; n < t_s.size(); ++n)
    if (!std::isfinite(t_s[n]) || (n > 0 && !(t_s[n] > t_s[n - 1])))
      return {{.where = "time",
               .value = base::written(t_s[n]),
               .limit = "in row " + std::to_string(n + 1) + " does not rise",
               .cure = "give the rows in the order in which they were recorded"}};
  return {};
}

/// A Problem if the column does not have one finite number for each time.
inline base::Problems check_column(const std::string& name, const std::vector<double>& values,
                                   std::size_t rows) {
  if (values.size() != rows)
    return {{.where = name,
             .value = std::to_string(values.size()) + " values",
             .limit = "must have one value for each of " + std::to_string(rows) + " times",
             .cure = "give columns of equal length"}};
  const auto wrong = std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
  if (wrong == values.end()) return {};
  return {{.where = name,
           .value = base::written(*wrong),
           .limit = "in row " + std::to_string(wrong - values.begin() + 1) + " is not a number",
           .cure = "remove such rows"}};
}

}  // namespace sixstep::analysis

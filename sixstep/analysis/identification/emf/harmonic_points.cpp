// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/harmonic_points.hpp"

#include <algorithm>

namespace sixstep::analysis {

HarmonicPoints harmonic_points(const EmfRecord& record, double periods) {
  constexpr double per_period = 220.0, fewest = 8192.0, most = 200'000.0;
  const std::size_t rows = record.t_s.size();
  const double wanted = std::clamp(per_period * periods, fewest, most);
  HarmonicPoints out;
  out.averaged = std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(rows) / wanted));
  out.averaged_s = (record.t_s.back() - record.t_s.front()) / static_cast<double>(rows - 1);
  const auto means = [&](const std::vector<double>& x) {
    std::vector<double> mean;
    for (std::size_t n = 0; n + out.averaged <= rows; n += out.averaged) {
      double sum = 0.0;
      for (std::size_t k = n; k < n + out.averaged; ++k) sum += x[k] - x[n];
      mean.push_back(x[n] + sum / static_cast<double>(out.averaged));
    }
    return mean;
  };
  out.t_s = means(record.t_s);
  for (const EmfChannel& c : record.channels) out.u_V.push_back(means(c.u_V));
  return out;
}

double left_by_averaging(const HarmonicPoints& points, double rad_s) {
  const double y = 0.5 * rad_s * points.averaged_s, n = static_cast<double>(points.averaged);
  return points.averaged == 1 ? 1.0 : base::sin(n * y) / (n * base::sin(y));
}

}  // namespace sixstep::analysis

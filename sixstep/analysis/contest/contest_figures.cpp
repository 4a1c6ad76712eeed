// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/contest_figures.hpp"

namespace sixstep::analysis {

std::vector<double> contest_values_of(std::span<const double> gauges) {
  const auto of = [&](Gauge gauge) {
    return gauge == Gauge::none ? 0.0 : gauges[static_cast<std::size_t>(gauge)];
  };
  std::vector<double> out;
  for (const ContestFigure& f : contest_figures)
    out.push_back(of(f.sum[0]) + of(f.sum[1]) + of(f.sum[2]) - of(f.less));
  return out;
}

}  // namespace sixstep::analysis

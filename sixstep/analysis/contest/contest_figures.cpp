// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/contest_figures.hpp"

namespace sixstep::analysis {

ContestValues contest_values_of(const GaugeValues& gauges) {
  const auto of = [&](Gauge gauge) {
    return gauge == Gauge::none ? 0.0 : gauges[static_cast<std::size_t>(gauge)];
  };
  ContestValues out{};
  for (std::size_t f = 0; f < out.size(); ++f) {
    const ContestFigure& figure = contest_figures[f];
    out[f] = of(figure.sum[0]) + of(figure.sum[1]) + of(figure.sum[2]) - of(figure.less);
  }
  return out;
}

}  // namespace sixstep::analysis

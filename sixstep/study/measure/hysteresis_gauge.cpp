// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/hysteresis_gauge.hpp"

#include <algorithm>

namespace sixstep::study {

void HysteresisGauge::segment(const SegmentView& g, double s) {
  for (int which = 0; which < 2; ++which) {
    if (!g.modulator.comparator(which).armed) continue;
    const auto& y = g.plant.expansion();
    const plant::PerLeg<double> w = g.modulator.pair->comparator_weights(which);
    Series c{};
    for (int j = 0; j <= y.degree; ++j) c[j] = w[0] * y.i[0][j] + w[1] * y.i[1][j] + w[2] * y.i[2][j];
    const rig::BoardCommand& command = g.modulator.pair->command();
    // The key includes the sign of the reference, because a reversal changes which current is compared.
    const double key = g.setpoint < 0.0 ? -command.off_above_A : command.off_above_A;
    part(watched_[which], g, c, {command.on_below_A, command.off_above_A, key}, s);
  }
}

void HysteresisGauge::part(Watched& watched, const SegmentView& g, const Series& c, const Limits& limits,
                           double s) {
  const plant::Expansion<double>& y = g.plant.expansion();
  if (limits.key != watched.key) watched.excused_above = watched.excused_below = true;
  if (g.plant.sector() != watched.sector) watched.excused_below = true;
  watched.key = limits.key;
  watched.sector = g.plant.sector();
  if (const Clip seen = clipped(window_, g.t_s, y.h, s); seen.from <= seen.to) {
    if (std::isnan(figures_.excess_A)) figures_ = {0.0, 0.0};
    const series::Extremes<double> e =
        series::extremes(series::restricted(c, y.degree, seen.from, seen.to), y.degree);
    if (!watched.excused_above) figures_.excess_A = std::max(figures_.excess_A, e.high - limits.upper);
    if (!watched.excused_below) figures_.deficit_A = std::max(figures_.deficit_A, limits.lower - e.low);
  }
  const double last = series::evaluate(series::restricted(c, y.degree, 0.0, s), y.degree, 1.0);
  if (last <= limits.upper) watched.excused_above = false;
  if (last >= limits.lower && last <= limits.upper) watched.excused_below = false;
}

}  // namespace sixstep::study

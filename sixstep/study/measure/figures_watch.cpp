// SPDX-License-Identifier: Apache-2.0
// The functions of the figures that are called at each segment. Only these functions are compiled for speed
// (CMakeLists.txt).
#include "sixstep/study/measure/figures.hpp"

namespace sixstep::study {

namespace {

void watch_with(Gauge& gauge, Signal signal, const SegmentView& g, double s) {
  const double h = g.plant.expansion().h;
  const Clip seen = clipped(gauge.window(), g.t_s, h, s);
  if (seen.empty()) return;
  if (gauge.holds([&] { return signal_bounds(g, signal); })) return;
  for_each_piece(g, signal, seen.from, seen.to, [&](const Piece& y, double from, double to) {
    gauge.part(y.c, y.degree, g.t_s + from * h, (to - from) * h);
  });
}

/// A reference can have a million steps. Therefore only gauges with an open window are called.
void watch_with(Gauges& gauges, const Measure& m, std::size_t& behind, const SegmentView& g, double s) {
  while (behind < gauges.size() && gauges[behind].window().to_s < g.t_s) ++behind;
  const double end_s = g.t_s + g.plant.expansion().h;
  const auto begun = [&](std::size_t n) { return n < gauges.size() && gauges[n].window().from_s <= end_s; };
  if (!m.sampled) {
    for (std::size_t n = behind; begun(n); ++n) watch_with(gauges[n], m.signal, g, s);
  } else if (g.ticked) {
    const double value = signal_now(g, m.signal);
    for (std::size_t n = behind; begun(n); ++n) gauges[n].sample(g.t_s, value);
  }
}

void watch_with(auto& gauge, const Measure&, std::size_t&, const SegmentView& g, double s) {
  gauge.segment(g, s);
}

}  // namespace

void Figures::watch(const SegmentView& g, double s) {
  for (Figure& figure : figures_)
    std::visit([&](auto& gauge) { watch_with(gauge, figure.measure, figure.behind, g, s); }, figure.taken_by);
}

}  // namespace sixstep::study

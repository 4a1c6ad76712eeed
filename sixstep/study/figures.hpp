// SPDX-License-Identifier: Apache-2.0
// All figures of merit of a run: one gauge per measure and window, fed segment by segment; then verdicts.
#pragma once
#include "sixstep/study/compile.hpp"
#include "sixstep/study/gauge.hpp"
#include "sixstep/study/hysteresis_gauge.hpp"

namespace sixstep::study {

class Figures {
 public:
  Figures(const Scenario& scenario, const std::vector<Level>& levels);

  template <class Rig>
  void segment(const Rig& rig, double s);

  void judge(const Scenario& scenario, Outcome& outcome) const;

 private:
  struct Figure {
    Measure measure;
    std::vector<Gauge> gauges;  ///< several: one per step of the reference; the worst counts
    std::int64_t turn_ons_before = 0, turn_ons_after = 0;
    double last_s = 0.0;
  };
  template <class Rig>
  void feed(Figure& figure, const Rig& rig, double s);
  template <class Rig>
  void feed_magnitude(Gauge& gauge, const Rig& rig, double from, double to);
  template <class Rig>
  void feed_part(Gauge& gauge, const Rig& rig, const Series& c, double from, double to);
  template <class Rig>
  void count_switching(Figure& figure, const Rig& rig, double s);
  double value(const Figure& figure) const;

  std::vector<Figure> figures_;  ///< requirements first, then comparisons
  HysteresisGauge hysteresis_;
  bool watches_hysteresis_ = false;
};

/// Shown for a measure without a label: "settling time of current".
std::string figure_name(const Measure& measure);
std::string figure_unit(const Measure& measure);

template <class Rig>
void Figures::segment(const Rig& rig, double s) {
  if (watches_hysteresis_) hysteresis_.segment(rig, s);
  for (Figure& figure : figures_) {
    if (figure.measure.metric == MetricKind::switching_frequency)
      count_switching(figure, rig, s);
    else if (figure.measure.metric != MetricKind::band_excess &&
             figure.measure.metric != MetricKind::band_deficit)
      feed(figure, rig, s);
  }
}

template <class Rig>
void Figures::count_switching(Figure& figure, const Rig& rig, double s) {
  const double from = figure.measure.from_s.value_or(0.0);
  const double to = figure.measure.to_s.value_or(std::numeric_limits<double>::infinity());
  const double now = rig.now().seconds();
  if (now < from) figure.turn_ons_before = rig.modulator().turn_ons();
  if (now < to) {
    figure.turn_ons_after = rig.modulator().turn_ons();
    figure.last_s = std::fmin(now + rig.plant().expansion().h * s, to);
  }
}

template <class Rig>
void Figures::feed(Figure& figure, const Rig& rig, double s) {
  const double t0 = rig.now().seconds(), h = rig.plant().expansion().h;
  if (figure.measure.sampled) {
    if (!rig.ticked()) return;
    const double value = signal_series(rig, figure.measure.signal, {1, 1, 1})[0];
    for (Gauge& gauge : figure.gauges) gauge.sample(t0, value);
    return;
  }
  for (Gauge& gauge : figure.gauges) {
    const Window& window = gauge.window();
    const double from = window.from_s > t0 ? (window.from_s - t0) / h : 0.0;
    const double to = window.to_s - t0 < h ? std::fmin(s, (window.to_s - t0) / h) : s;
    if (!(from < to)) continue;
    if (gauge.seeks_extremes() && gauge.holds(signal_bounds(rig, figure.measure.signal))) continue;
    if (figure.measure.signal == Signal::current_magnitude)
      feed_magnitude(gauge, rig, from, to);
    else
      feed_part(gauge, rig, signal_series(rig, figure.measure.signal, {}), from, to);
  }
}

template <class Rig>
void Figures::feed_part(Gauge& gauge, const Rig& rig, const Series& c, double from, double to) {
  const auto& y = rig.plant().expansion();
  const double t0 = rig.now().seconds();
  if (from == 0.0 && to == 1.0)  // most segments
    gauge.part(c, y.degree, t0, y.h);
  else
    gauge.part(series::restricted(c, y.degree, from, to), y.degree, t0 + from * y.h, (to - from) * y.h);
}

/// Half the sum of magnitudes: split where a phase current changes sign.
template <class Rig>
void Figures::feed_magnitude(Gauge& gauge, const Rig& rig, double from, double to) {
  const auto& y = rig.plant().expansion();
  const std::vector<double> cuts = magnitude_cuts(y, from, to);
  for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
    plant::PerLeg<double> sign{};
    const double middle = (cuts[n] + cuts[n + 1]) / 2;
    for (int k = 0; k < 3; ++k) sign[k] = series::evaluate(y.i[k], y.degree, middle) < 0 ? -1.0 : 1.0;
    feed_part(gauge, rig, signal_series(rig, Signal::current_magnitude, sign), cuts[n], cuts[n + 1]);
  }
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/figures.hpp"

#include <algorithm>

namespace sixstep::study {

namespace {

bool concerns_step(MetricKind kind) {
  return kind == MetricKind::reach_time || kind == MetricKind::settling_time || kind == MetricKind::overshoot;
}

/// A window per reference step inside the measure's own window; the step goes from the level before to the
/// new one. For reaching a square's level the whole level counts, not the part of the reversal: the stricter
/// reading of "98 %".
std::vector<Gauge> step_gauges(const Measure& m, const std::vector<Level>& levels, Window window,
                               bool square) {
  std::vector<Gauge> gauges;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const double from = levels[n].at_s, to = n + 1 < levels.size() ? levels[n + 1].at_s : window.to_s;
    const double before = n == 0 ? 0.0 : levels[n - 1].value;
    if (from < window.from_s || !(from < window.to_s) || levels[n].value == before) continue;
    const bool whole = square && m.metric == MetricKind::reach_time;
    gauges.emplace_back(m, Window{from, std::min(to, window.to_s)}, levels[n].value,
                        whole ? 0.0 : m.start.value_or(before));
  }
  return gauges;
}

const char* metric_word(MetricKind kind) {
  switch (kind) {
    case MetricKind::final_value:
      return "final";
    case MetricKind::mean:
      return "mean";
    case MetricKind::rms:
      return "rms";
    case MetricKind::maximum:
      return "maximum of";
    case MetricKind::minimum:
      return "minimum of";
    case MetricKind::peak_to_peak:
      return "peak-to-peak";
    case MetricKind::overshoot:
      return "overshoot of";
    case MetricKind::reach_time:
      return "time to reach,";
    case MetricKind::settling_time:
      return "settling time of";
    case MetricKind::band_excess:
      return "excess above the band of";
    case MetricKind::band_deficit:
      return "shortfall below the band of";
    case MetricKind::switching_frequency:
      return "switching frequency";
  }
  return "";
}

const char* signal_word(Signal signal) {
  switch (signal) {
    case Signal::current:
      return "motor current";
    case Signal::phase_a:
      return "current of phase a";
    case Signal::phase_b:
      return "current of phase b";
    case Signal::phase_c:
      return "current of phase c";
    case Signal::current_magnitude:
      return "half the sum of current magnitudes";
    case Signal::speed:
      return "speed";
    case Signal::position:
      return "position";
    case Signal::torque:
      return "torque";
    case Signal::bus_voltage:
      return "bus voltage";
    case Signal::bus_current:
      return "bus current";
  }
  return "";
}

}  // namespace

std::string figure_name(const Measure& m) {
  if (!m.label.empty()) return m.label;
  if (m.metric == MetricKind::switching_frequency) return metric_word(m.metric);
  return std::string(metric_word(m.metric)) + " " + signal_word(m.signal);
}

std::string figure_unit(const Measure& m) {
  switch (m.metric) {
    case MetricKind::reach_time:
    case MetricKind::settling_time:
      return "s";
    case MetricKind::switching_frequency:
      return "Hz";
    case MetricKind::band_excess:
    case MetricKind::band_deficit:
      return "A";
    default:
      return unit_of(m.signal);
  }
}

Figures::Figures(const Scenario& scenario, const std::vector<Level>& levels) {
  const auto add = [&](const Measure& m) {
    Figure figure{.measure = m, .gauges = {}};
    const Window window{m.from_s.value_or(0.0), m.to_s.value_or(scenario.duration_s)};
    const bool square = scenario.reference.shape == Shape::square;
    if (concerns_step(m.metric) && !m.level)
      figure.gauges = step_gauges(m, levels, window, square);
    else
      figure.gauges.emplace_back(m, window, m.level.value_or(0.0), m.start);
    watches_hysteresis_ =
        watches_hysteresis_ || m.metric == MetricKind::band_excess || m.metric == MetricKind::band_deficit;
    figures_.push_back(std::move(figure));
  };
  for (const Requirement& r : scenario.require) add(r.measure);
  for (const Comparison& c : scenario.compare) add(c.measure);
}

/// The worst over the steps; NaN, which meets no requirement, where the run ended before the window.
double Figures::value(const Figure& figure) const {
  const Measure& m = figure.measure;
  if (m.metric == MetricKind::band_excess) return hysteresis_.figures().excess_A;
  if (m.metric == MetricKind::band_deficit) return hysteresis_.figures().deficit_A;
  if (m.metric == MetricKind::switching_frequency)
    return static_cast<double>(figure.turn_ons_after - figure.turn_ons_before) /
           (figure.last_s - m.from_s.value_or(0.0));
  double worst = -std::numeric_limits<double>::infinity();
  for (const Gauge& gauge : figure.gauges) {
    const std::optional<double> v = gauge.value();
    if (!v) return std::numeric_limits<double>::quiet_NaN();
    worst = std::max(worst, *v);
  }
  return figure.gauges.empty() ? std::numeric_limits<double>::quiet_NaN() : worst;
}

void Figures::judge(const Scenario& scenario, Outcome& outcome) const {
  std::size_t n = 0;
  for (const Requirement& r : scenario.require) {
    const double v = value(figures_[n++]);
    const bool ok = v == v && (!r.min || v >= *r.min) && (!r.max || v <= *r.max);
    outcome.verdicts.push_back({figure_name(r.measure), figure_unit(r.measure), v, r.min, r.max, ok});
  }
  for (const Comparison& c : scenario.compare)
    outcome.comparisons.push_back(
        {figure_name(c.measure), figure_unit(c.measure), value(figures_[n++]), c.value, c.source});
}

}  // namespace sixstep::study

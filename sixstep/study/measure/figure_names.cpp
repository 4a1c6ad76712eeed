// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/figures.hpp"

namespace sixstep::study {

namespace {

/// What stands before the signal; alone where the figure has none.
const char* metric_words(MetricKind kind) {
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
    case MetricKind::ripple_rms:
      return "rms ripple of";
    case MetricKind::overshoot:
      return "overshoot of";
    case MetricKind::reach_time:
      return "time to reach,";
    case MetricKind::rise_time:
      return "rise time of";
    case MetricKind::settling_time:
      return "settling time of";
    case MetricKind::steady_error:
      return "steady error of";
    case MetricKind::largest_error:
      return "largest error of";
    case MetricKind::thd:
      return "THD of";
    case MetricKind::energy:
      return "energy of";
    case MetricKind::efficiency:
      return "efficiency";
    case MetricKind::band_excess:
      return "excess above the band of";
    case MetricKind::band_deficit:
      return "shortfall below the band of";
    case MetricKind::switching_frequency:
      return "switching frequency";
  }
  return "";
}

}  // namespace

std::string figure_name(const Measure& m) {
  if (!m.label.empty()) return m.label;
  if (m.metric == MetricKind::efficiency) return metric_words(m.metric);
  const std::string words = metric_words(m.metric), phrase(fact_of(m.signal).phrase);
  if (m.metric == MetricKind::switching_frequency) return is_gate(m.signal) ? words + " of " + phrase : words;
  constexpr std::string_view power = "power ";  // "power from the bus" is "energy from the bus" over time
  if (m.metric == MetricKind::energy && phrase.starts_with(power))
    return "energy " + phrase.substr(power.size());
  return words + " " + phrase;
}

}  // namespace sixstep::study

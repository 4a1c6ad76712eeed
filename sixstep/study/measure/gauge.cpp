// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/gauge.hpp"

namespace sixstep::study {

namespace {

AnyGauge gauge_for(const Measure& m, const Step& step) {
  switch (m.metric) {
    case MetricKind::final_value:
      return FinalValue();
    case MetricKind::mean:
      return Mean();
    case MetricKind::steady_error:
      return SteadyError(step.level);
    case MetricKind::rms:
      return Rms();
    case MetricKind::ripple_rms:
      return RippleRms();
    case MetricKind::maximum:
      return ExtremeGauge(Maximum{});
    case MetricKind::minimum:
      return ExtremeGauge(Minimum{});
    case MetricKind::peak_to_peak:
      return ExtremeGauge(PeakToPeak{});
    case MetricKind::largest_error:
      return ExtremeGauge(LargestError{step.level});
    case MetricKind::overshoot:
      return ExtremeGauge(Overshoot{step});
    case MetricKind::reach_time:
      return ReachTime(step, m.fraction);
    case MetricKind::rise_time:
      return RiseTime(step);
    case MetricKind::settling_time:
      return SettlingTime(step, m.band);
    case MetricKind::thd:
    case MetricKind::energy:
    case MetricKind::efficiency:
    case MetricKind::band_excess:
    case MetricKind::band_deficit:
    case MetricKind::switching_frequency:
    case MetricKind::switching_loss:
    case MetricKind::commutation_error:
    case MetricKind::commutation_error_rms:
      break;
  }
  return NoGauge();
}

}  // namespace

Gauge::Gauge(const Measure& measure, Window window, double level, std::optional<double> start)
    : gauge_(gauge_for(measure, {level, start})), window_(window), sampled_(measure.sampled) {}

void Gauge::see(double value) {
  numbers_ = numbers_ && value - value == 0.0;
  seen_ = true;
}

void Gauge::part(const Series& c, int degree, double t0, double length) {
  if (sampled_) return;
  see(c[0]);
  std::visit([&](auto& gauge) { gauge.part(c, degree, t0, length); }, gauge_);
}

void Gauge::sample(double t, double value) {
  if (!sampled_ || t < window_.from_s || !(t < window_.to_s)) return;
  see(value);
  std::visit([&](auto& gauge) { gauge.sample(t, value); }, gauge_);
}

std::optional<double> Gauge::value() const {
  if (!seen_ || !numbers_) return std::nullopt;
  const double v = std::visit([&](const auto& gauge) { return gauge.value(window_.from_s); }, gauge_);
  if (std::holds_alternative<NoGauge>(gauge_)) return std::nullopt;
  return v;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/gauge.hpp"

namespace sixstep::study {

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

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/gauge.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/series/quadrature.hpp"

namespace sixstep::study {

double Gauge::step_height(double first) {
  if (!start_) start_ = first;
  return std::fabs(level_ - *start_);
}

void Gauge::part(const Series& c, int degree, double t0, double length) {
  if (measure_.sampled) return;
  if (!seen_) step_height(c[0]);
  seen_ = true;
  switch (measure_.metric) {
    case MetricKind::final_value:
      last_ = series::evaluate(c, degree, 1.0);
      return;
    case MetricKind::mean:
      integral_ += length * series::whole_integral(c, degree);
      seconds_ += length;
      return;
    case MetricKind::rms:
      integral_ += length * series::product_integral(c, c, degree, 1.0);
      seconds_ += length;
      return;
    case MetricKind::maximum:
    case MetricKind::minimum:
    case MetricKind::peak_to_peak:
    case MetricKind::overshoot: {
      // Most segments cannot move the extremes at all.
      const double reach = series::magnitude_of(c, degree) - std::fabs(c[0]);
      if (holds({c[0] - reach, c[0] + reach})) return;
      const series::Extremes<double> e = series::extremes(c, degree);
      highest_ = std::max(highest_, e.high);
      lowest_ = std::min(lowest_, e.low);
      return;
    }
    case MetricKind::reach_time:
      return reach_part(c, degree, t0, length);
    case MetricKind::settling_time:
      return settle_part(c, degree, t0, length);
    default:
      return;
  }
}

void Gauge::reach_part(const Series& c, int degree, double t0, double length) {
  if (reached_) return;
  const double target = *start_ + measure_.fraction * (level_ - *start_);
  Series missing = c;  // positive until the target is reached
  for (double& v : missing) v *= -sign();
  missing[0] += sign() * target;
  if (missing[0] <= 0.0) {
    reached_ = t0;
  } else if (const auto root = series::first_root(missing, degree, 1.0, 0.0)) {
    reached_ = t0 + *root * length;
  }
}

void Gauge::settle_part(const Series& c, int degree, double t0, double length) {
  const double band = measure_.band * step_height(c[0]);
  Series above = c, below = c;  // both >= 0 while outside on that side
  above[0] -= level_ + band;
  for (double& v : below) v = -v;
  below[0] += level_ - band;
  const auto outside = [&](double s) {
    return series::evaluate(above, degree, s) > 0.0 || series::evaluate(below, degree, s) > 0.0;
  };
  outside_now_ = outside(1.0);
  if (outside_now_) {
    outside_until_ = t0 + length;
    return;
  }
  // Every crossing of a limit is an end of an excursion or its begin; the latest is where the last one ended.
  const double scale = series::magnitude_of(c, degree);
  for (const Series* side : {&above, &below})
    series::for_each_sign_change(
        *side, degree, scale, [&](double s) { outside_until_ = std::max(outside_until_, t0 + s * length); });
  if (outside(0.0)) outside_until_ = std::max(outside_until_, t0);
}

void Gauge::sample(double t, double value) {
  if (!measure_.sampled || t < window_.from_s || !(t < window_.to_s)) return;
  const double height = step_height(value);
  seen_ = true;
  last_ = value;
  integral_ += measure_.metric == MetricKind::rms ? value * value : value;
  seconds_ += 1.0;
  highest_ = std::max(highest_, value);
  lowest_ = std::min(lowest_, value);
  if (!reached_ && sign() * (value - *start_ - measure_.fraction * (level_ - *start_)) >= 0.0) reached_ = t;
  // Settled from the first sample on after which every one lies inside.
  const bool outside = std::fabs(value - level_) > measure_.band * height;
  if (!outside && outside_now_) outside_until_ = t;
  outside_now_ = outside;
}

std::optional<double> Gauge::value() const {
  if (!seen_) return std::nullopt;
  constexpr double never = std::numeric_limits<double>::infinity();
  switch (measure_.metric) {
    case MetricKind::final_value:
      return last_;
    case MetricKind::mean:
      return integral_ / seconds_;
    case MetricKind::rms:
      return std::sqrt(integral_ / seconds_);
    case MetricKind::maximum:
      return highest_;
    case MetricKind::minimum:
      return lowest_;
    case MetricKind::peak_to_peak:
      return highest_ - lowest_;
    case MetricKind::overshoot:
      return std::max(0.0, sign() > 0 ? highest_ - level_ : level_ - lowest_);
    case MetricKind::reach_time:
      return reached_ ? *reached_ - window_.from_s : never;
    case MetricKind::settling_time:
      return outside_now_ ? never : std::max(0.0, outside_until_ - window_.from_s);
    default:
      return std::nullopt;
  }
}

}  // namespace sixstep::study

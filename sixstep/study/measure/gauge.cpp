// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/gauge.hpp"

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
  numbers_ = numbers_ && c[0] - c[0] == 0.0;
  if (!seen_) step_height(c[0]);
  seen_ = true;
  switch (measure_.metric) {
    case MetricKind::final_value:
      last_ = series::evaluate(c, degree, 1.0);
      return;
    case MetricKind::mean:
    case MetricKind::steady_error:
    case MetricKind::rms:
    case MetricKind::ripple_rms:
      return integrate_part(c, degree, length);
    case MetricKind::maximum:
    case MetricKind::minimum:
    case MetricKind::peak_to_peak:
    case MetricKind::overshoot:
    case MetricKind::largest_error:
      return widen_part(c, degree);
    case MetricKind::reach_time:
    case MetricKind::rise_time:
      return reach_part(c, degree, t0, length);
    case MetricKind::settling_time:
      return settle_part(c, degree, t0, length);
    default:
      return;
  }
}

void Gauge::integrate_part(const Series& c, int degree, double length) {
  if (measure_.metric == MetricKind::ripple_rms) {
    const double mean = series::whole_integral(c, degree);
    Series about = c;
    about[0] -= mean;
    return merge(mean, length * series::product_integral(about, about, degree, 1.0), length);
  }
  integral_ += length * (measure_.metric == MetricKind::rms ? series::product_integral(c, c, degree, 1.0)
                                                            : series::whole_integral(c, degree));
  seconds_ += length;
}

/// Two stretches into one (Chan, Golub, LeVeque 1983): no difference of large squares, so that a ripple of a
/// millionth of its mean keeps its digits.
void Gauge::merge(double mean, double squares, double length) {
  const double all = seconds_ + length;
  if (!(all > 0.0)) return;
  const double apart = mean - mean_;
  mean_ += apart * (length / all);
  squares_ += squares + apart * apart * (seconds_ * (length / all));
  seconds_ = all;
}

void Gauge::widen_part(const Series& c, int degree) {
  // Most segments cannot move the extremes at all.
  const double reach = series::magnitude_of(c, degree) - std::fabs(c[0]);
  if (holds({c[0] - reach, c[0] + reach})) return;
  const series::Extremes<double> e = series::extremes(c, degree);
  highest_ = std::max(highest_, e.high);
  lowest_ = std::min(lowest_, e.low);
}

/// When the part of the way from start to level is made, if within this part.
std::optional<double> Gauge::crossing(double fraction, const Series& c, int degree, double t0,
                                      double length) const {
  const double target = *start_ + fraction * (level_ - *start_);
  Series missing = c;  // positive until the target is reached
  for (double& v : missing) v *= -sign();
  missing[0] += sign() * target;
  if (missing[0] <= 0.0) return t0;
  const double root = series::first_root(missing, degree, 1.0, 0.0);
  return root <= 1.0 ? std::optional(t0 + root * length) : std::nullopt;
}

void Gauge::reach_part(const Series& c, int degree, double t0, double length) {
  const bool rise = measure_.metric == MetricKind::rise_time;
  if (rise && !begun_) begun_ = crossing(rise_from, c, degree, t0, length);
  if (!reached_) reached_ = crossing(rise ? rise_to : measure_.fraction, c, degree, t0, length);
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
  numbers_ = numbers_ && value - value == 0.0;
  seen_ = true;
  last_ = value;
  if (measure_.metric == MetricKind::ripple_rms) {
    merge(value, 0.0, 1.0);
  } else {
    integral_ += measure_.metric == MetricKind::rms ? value * value : value;
    seconds_ += 1.0;
  }
  highest_ = std::max(highest_, value);
  lowest_ = std::min(lowest_, value);
  const auto made = [&](double part) {
    return sign() * (value - *start_ - part * (level_ - *start_)) >= 0.0;
  };
  const bool rise = measure_.metric == MetricKind::rise_time;
  if (!begun_ && made(rise_from)) begun_ = t;
  if (!reached_ && made(rise ? rise_to : measure_.fraction)) reached_ = t;
  // Settled from the first sample on after which every one lies inside.
  const bool outside = std::fabs(value - level_) > measure_.band * height;
  if (!outside && outside_now_) outside_until_ = t;
  outside_now_ = outside;
}

std::optional<double> Gauge::value() const {
  if (!seen_ || !numbers_) return std::nullopt;
  constexpr double never = std::numeric_limits<double>::infinity();
  switch (measure_.metric) {
    case MetricKind::final_value:
      return last_;
    case MetricKind::mean:
      return integral_ / seconds_;
    case MetricKind::steady_error:
      return level_ - integral_ / seconds_;
    case MetricKind::rms:
      return std::sqrt(integral_ / seconds_);
    case MetricKind::ripple_rms:
      return std::sqrt(squares_ / seconds_);
    case MetricKind::maximum:
      return highest_;
    case MetricKind::minimum:
      return lowest_;
    case MetricKind::peak_to_peak:
      return highest_ - lowest_;
    case MetricKind::overshoot:
      return std::max(0.0, sign() > 0 ? highest_ - level_ : level_ - lowest_);
    case MetricKind::largest_error:
      return std::max(highest_ - level_, level_ - lowest_);
    case MetricKind::reach_time:
      return reached_ ? *reached_ - window_.from_s : never;
    case MetricKind::rise_time:
      return begun_ && reached_ ? *reached_ - *begun_ : never;
    case MetricKind::settling_time:
      return outside_now_ ? never : std::max(0.0, outside_until_ - window_.from_s);
    default:
      return std::nullopt;
  }
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/step_gauges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/series/first_root.hpp"

namespace sixstep::study {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

double Step::height() const { return std::fabs(level - *start); }

std::optional<double> Step::crossing(double fraction, const Series& c, int degree, double t0,
                                     double length) const {
  const double target = *start + fraction * (level - *start);
  Series missing = c;  // difference to the target, positive until the signal reaches the target
  for (double& v : missing) v *= -sign();
  missing[0] += sign() * target;
  if (missing[0] <= 0.0) return t0;
  const double root = series::first_root(missing, degree, 1.0, 0.0);
  return root <= 1.0 ? std::optional(t0 + root * length) : std::nullopt;
}

void ReachTime::part(const Series& c, int degree, double t0, double length) {
  step_.begin(c[0]);
  if (!reached_) reached_ = step_.crossing(fraction_, c, degree, t0, length);
}
void ReachTime::sample(double t, double value) {
  step_.begin(value);
  if (!reached_ && step_.made(fraction_, value)) reached_ = t;
}
double ReachTime::value(double from_s) const { return reached_ ? *reached_ - from_s : never; }

void RiseTime::part(const Series& c, int degree, double t0, double length) {
  step_.begin(c[0]);
  if (!begun_) begun_ = step_.crossing(rise_from, c, degree, t0, length);
  if (!reached_) reached_ = step_.crossing(rise_to, c, degree, t0, length);
}
void RiseTime::sample(double t, double value) {
  step_.begin(value);
  if (!begun_ && step_.made(rise_from, value)) begun_ = t;
  if (!reached_ && step_.made(rise_to, value)) reached_ = t;
}
double RiseTime::value(double) const { return begun_ && reached_ ? *reached_ - *begun_ : never; }

void SettlingTime::part(const Series& c, int degree, double t0, double length) {
  step_.begin(c[0]);
  const double band = band_ * step_.height();
  Series above = c, below = c;  // distances from the band's two limits, positive while the signal is outside
  above[0] -= step_.level + band;
  for (double& v : below) v = -v;
  below[0] += step_.level - band;
  const auto outside = [&](double s) {
    return series::evaluate(above, degree, s) > 0.0 || series::evaluate(below, degree, s) > 0.0;
  };
  outside_now_ = outside(1.0);
  if (outside_now_) {
    outside_until_ = t0 + length;
    return;
  }
  // Every crossing of a limit begins or ends an excursion; the last excursion ends at the latest crossing.
  const double scale = series::magnitude_of(c, degree);
  for (const Series* side : {&above, &below})
    series::for_each_sign_change(
        *side, degree, scale, [&](double s) { outside_until_ = std::max(outside_until_, t0 + s * length); });
  if (outside(0.0)) outside_until_ = std::max(outside_until_, t0);
}
void SettlingTime::sample(double t, double value) {
  step_.begin(value);
  const bool outside = std::fabs(value - step_.level) > band_ * step_.height();
  if (!outside && outside_now_) outside_until_ = t;
  outside_now_ = outside;
}
double SettlingTime::value(double from_s) const {
  return outside_now_ ? never : std::max(0.0, outside_until_ - from_s);
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/distributions.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// 95 % of a normal distribution lie within this many standard deviations of its mean, 2.5 % beyond on each
/// side.
constexpr double z_95 = 1.959963984540054;

double normal_density(double x) { return base::exp(-0.5 * x * x) / std::sqrt(2.0 * base::pi); }

/// The argument between `low` and `high` at which the rising function `below` reaches `p`, by bisection.
template <class Below>
double where(Below below, double p, double low, double high) {
  for (int n = 0; n < 200 && high - low > 1e-10 * (std::fabs(low) + std::fabs(high)); ++n) {
    const double middle = 0.5 * (low + high);
    (below(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Probability that a vector of the given true length is measured as at most r long, with standard deviation
/// 1 in each coordinate: Rice's distribution, as the integral over the coordinate along the vector.
double length_below(double r, double length) {
  if (r <= 0.0) return 0.0;
  constexpr int steps = 60;  // error 1e-9: the sum converges as for a periodic function
  const double from = std::max(-r, length - 9.0), to = std::min(r, length + 9.0);
  if (from >= to) return r < length ? 0.0 : 1.0;
  // With x = middle + half sin(a), the integrand is smooth in a, although it has a square root at the ends.
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double a = base::pi * ((n + 0.5) / steps - 0.5);
    const base::SinCos at = base::sin_cos(a);
    const double x = middle + half * at.sin;
    const double across = 2.0 * normal_cdf(std::sqrt(std::max(0.0, r * r - x * x))) - 1.0;
    sum += normal_density(x - length) * across * half * at.cos;
  }
  return sum * base::pi / steps;
}

}  // namespace

double normal_cdf(double x) {
  if (x < 0.0) return 1.0 - normal_cdf(-x);
  if (x > 9.0) return 1.0;
  if (x > 4.0) {  // Laplace's continued fraction of the tail
    double fraction = x;
    for (int k = 60; k > 0; --k) fraction = x + k / fraction;
    return 1.0 - normal_density(x) / fraction;
  }
  double term = x, sum = x;  // 1/2 + density (x + x^3/3 + x^5/(3 5) + ..)
  for (int k = 1; std::fabs(term) > 1e-17 * sum && k < 200; ++k) sum += term *= x * x / (2 * k + 1);
  return 0.5 + normal_density(x) * sum;
}

double student_95(double degrees_of_freedom) {
  const double n = std::max(degrees_of_freedom, 3.0), z = z_95, q = z * z;
  const double g1 = (q + 1.0) * z / 4.0, g2 = ((5.0 * q + 16.0) * q + 3.0) * z / 96.0,
               g3 = (((3.0 * q + 19.0) * q + 17.0) * q - 15.0) * z / 384.0,
               g4 = ((((79.0 * q + 776.0) * q + 1482.0) * q - 1920.0) * q - 945.0) * z / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

Interval mixture_95(std::span<const Component> mixture) {
  double mean = 0.0, low = 0.0, high = 0.0;
  bool first = true;
  for (const Component& c : mixture) {
    mean += c.weight * c.mean;
    const double a = c.mean - 9.0 * c.deviation, b = c.mean + 9.0 * c.deviation;
    low = first ? a : std::min(low, a);
    high = first ? b : std::max(high, b);
    first = false;
  }
  const auto below = [&](double x) {
    double sum = 0.0;
    for (const Component& c : mixture)
      sum += c.weight *
             (c.deviation > 0.0 ? normal_cdf((x - c.mean) / c.deviation) : static_cast<double>(x >= c.mean));
    return sum;
  };
  return {mean, where(below, 0.025, low, high), where(below, 0.975, low, high)};
}

Interval length_95(double length, double deviation) {
  if (!(deviation > 0.0)) return {length, length, length};
  const double r = length / deviation;
  if (r > 30.0) return around(length, z_95 * deviation);
  // The longer the true vector is, the smaller is the probability of a measured length up to r.
  const auto longer = [&](double p) {
    if (length_below(r, 0.0) <= p) return 0.0;
    return where([&](double a) { return 1.0 - length_below(r, a); }, 1.0 - p, 0.0, r + 10.0);
  };
  // A length that is by chance far below its noise does not bound the true length; the upper bound is at
  // least r + 1.
  return {length, longer(0.975) * deviation, std::max(longer(0.025), r + 1.0) * deviation};
}

Interval length_95(double length, double deviation, double degrees_of_freedom) {
  return length_95(length, deviation * student_95(degrees_of_freedom) / z_95);
}

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/emf_shape.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

constexpr double thirty_deg = base::pi / 6.0;

/// The harmonics, each rotated by angle(order).
template <class Angle>
ShapeHarmonics turned(const ShapeHarmonics& shape, Angle angle) {
  ShapeHarmonics out = shape;
  for (std::size_t n = 0; n < shape.size(); ++n) {
    const base::SinCos by = base::sin_cos(angle(static_cast<int>(n) + 1));
    out.re[n] = shape.re[n] * by.cos - shape.im[n] * by.sin;
    out.im[n] = shape.re[n] * by.sin + shape.im[n] * by.cos;
  }
  return out;
}

void drop_thirds(ShapeHarmonics& shape) {
  for (std::size_t n = 2; n < shape.size(); n += 3) shape.re[n] = shape.im[n] = 0.0;
}

/// e_a - e_b = Re E_h (1 - exp(-j h 120 deg)) exp(j h y); E_h: harmonic of order h of a phase, y: angle. The
/// bracket is sqrt 3 exp(+-j 30 deg), + for h = 1, 4, 7. The line's own angle, which is 0 at its
/// fundamental's peak, is y + 30 deg.
double line_ahead(int order) { return order % 3 == 1 ? thirty_deg * (1 - order) : -thirty_deg * (1 + order); }

}  // namespace

double ShapeHarmonics::at(double x_rad) const {
  const base::SinCos one = base::sin_cos(x_rad);
  double c = 1.0, s = 0.0, sum = 0.0;
  for (std::size_t n = 0; n < size(); ++n) {
    const double next = c * one.cos - s * one.sin;
    s = s * one.cos + c * one.sin;
    c = next;
    sum += re[n] * c - im[n] * s;
  }
  return sum;
}

double ShapeHarmonics::rms() const {
  double square = 0.0;
  for (std::size_t n = 0; n < size(); ++n) square += 0.5 * (re[n] * re[n] + im[n] * im[n]);
  return std::sqrt(square);
}

ShapeHarmonics seen_backward(ShapeHarmonics seen) {
  // The back-EMF is e = K w f(y) with the speed w < 0, the constant K and the shape f. Time runs with x = -y
  // - 180 deg. The fundamental is then positive at its peak again.
  for (std::size_t n = 0; n < seen.size(); ++n) {
    const bool even = n % 2 == 1;
    if (even) seen.re[n] = -seen.re[n];
    if (!even) seen.im[n] = -seen.im[n];
  }
  return seen;
}

ShapeHarmonics phase_of_line(const ShapeHarmonics& line) {
  ShapeHarmonics out = turned(line, [](int order) { return -line_ahead(order); });
  drop_thirds(out);
  return out;
}

ShapeHarmonics line_of_phase(const ShapeHarmonics& phase) {
  ShapeHarmonics out = turned(phase, line_ahead);
  drop_thirds(out);
  return out;
}

WavePeak wave_peak(const ShapeHarmonics& shape) {
  const std::size_t count = shape.size();
  double high = 0.0;
  for (std::size_t n = 2 * count / 3; n < count; ++n)
    high += std::sqrt(shape.re[n] * shape.re[n] + shape.im[n] * shape.im[n]);
  const ShapePeak sum = peak_of(shape);
  // Least sum of high harmonics of a shape with a corner. For such a shape, the last third of 25 harmonics
  // contains at least 0.6 % of the fundamental; for a round shape, almost nothing.
  constexpr double least_corner = 3e-3;
  if (high < least_corner) return {sum};
  ShapeHarmonics mean = shape;
  for (std::size_t n = 0; n < count; ++n) {
    const double x = base::pi * static_cast<double>(n + 1) / static_cast<double>(count + 1);
    mean.re[n] *= base::sin(x) / x;
    mean.im[n] *= base::sin(x) / x;
  }
  const ShapePeak smooth = peak_of(mean);
  const double gap = std::fmax(sum.value - smooth.value, 0.0);
  constexpr double sine_flat_deg = 36.4;  // 2 arccos 0.95
  if (smooth.flat_deg > 1.1 * sine_flat_deg)
    return {{smooth.value, smooth.x_rad, sum.flat_deg}, 0.5 * gap, gap};
  return {sum, 1.5 * gap, 1.25 * gap};
}

ShapePeak peak_of(const ShapeHarmonics& shape) {
  constexpr int steps = 1440;
  constexpr double step = 2.0 * base::pi / steps, flat_part = 0.95;
  std::vector<double> values(steps);
  int top = 0;
  for (int n = 0; n < steps; ++n) {
    values[static_cast<std::size_t>(n)] = shape.at(n * step);
    if (std::fabs(values[static_cast<std::size_t>(n)]) > std::fabs(values[static_cast<std::size_t>(top)]))
      top = n;
  }
  const auto value = [&](int n) { return values[static_cast<std::size_t>((n % steps + steps) % steps)]; };
  const double sign = value(top) < 0.0 ? -1.0 : 1.0;
  const double y0 = sign * value(top - 1), y1 = sign * value(top), y2 = sign * value(top + 1);
  const double bend = y0 - 2.0 * y1 + y2, aside = bend < 0.0 ? 0.5 * (y0 - y2) / bend : 0.0;
  ShapePeak out{y1 - 0.25 * (y0 - y2) * aside, (top + aside) * step, 0.0};
  // A ripple on a flat top may dip below the 95 % line; the width therefore counts all values above the line.
  for (const double v : values)
    if (sign * v >= flat_part * out.value) out.flat_deg += 360.0 / steps;
  return out;
}

}  // namespace sixstep::analysis

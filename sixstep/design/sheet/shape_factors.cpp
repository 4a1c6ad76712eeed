// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/sheet/shape_factors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
namespace {

/// Mean of f_p - f_n over a sector for a shape of peak 1 (model.md 1): torque per ampere of the driven pair
/// divided by K_e. By symmetry it is twice the mean of one phase's shape over 60 degrees from the middle of
/// its top. For a trapezoid with ramps through zero at 90 degrees, and h = 90 - w/2 degrees from top to zero:
///   w >= 120:  2
///   w < 120:   (2/60) (w/2 + integral of (90 - x)/h over w/2..60) = (90 - h/2 - 450/h)/30
/// Sine: (6/pi) sin 60 = 3 sqrt(3)/pi = 1.65399
double sector_mean(BackEmfShape shape, double flat_deg) {
  if (shape == BackEmfShape::sine) return 3.0 * std::sqrt(3.0) / base::pi;
  if (flat_deg >= 120.0) return 2.0;
  const double h = 90.0 - flat_deg / 2.0;
  return (90.0 - h / 2.0 - 450.0 / h) / 30.0;
}

/// The trapezoid at x degrees from the middle of its positive top.
double trapezoid_wave(double x_deg, double flat_deg) {
  const double turns = std::floor(x_deg / 360.0 + 0.5);
  const double x = std::abs(x_deg - 360.0 * turns), h = 90.0 - flat_deg / 2.0;
  return std::clamp((90.0 - x) / h, -1.0, 1.0);
}

/// Peak and mean square of f(x) - f(x - 120) over half a turn. The difference is linear between the corners
/// of both terms: its peak is therefore at a corner, and Simpson's rule is exact for its square.
void line_to_line(double flat_deg, ShapeFactors& out) {
  std::array<double, 6> corners = {0.0, 180.0};
  std::size_t count = 2;
  for (const double shift : {0.0, 120.0})
    for (const double corner : {flat_deg / 2.0, -flat_deg / 2.0}) {
      const double x = corner + shift;
      corners[count++] = x - 180.0 * std::floor(x / 180.0);
    }
  std::sort(corners.begin(), corners.end());
  const auto line = [&](double x) {
    return trapezoid_wave(x, flat_deg) - trapezoid_wave(x - 120.0, flat_deg);
  };
  double square = 0.0;
  for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
    const double a = line(corners[n]), b = line(corners[n + 1]), middle = (a + b) / 2.0;
    square += (a * a + 4.0 * middle * middle + b * b) / 6.0 * (corners[n + 1] - corners[n]);
    out.line_peak = std::max({out.line_peak, std::abs(a), std::abs(b)});
  }
  out.line_rms = std::sqrt(square / 180.0);
}

}  // namespace

ShapeFactors shape_factors(BackEmfShape shape, double flat_deg) {
  ShapeFactors out;
  out.sector_mean = sector_mean(shape, flat_deg);
  if (shape == BackEmfShape::sine) {
    out.line_peak = std::sqrt(3.0);
    out.line_rms = std::sqrt(1.5);
    out.phase_rms = std::sqrt(0.5);
    out.phase_peak = 1.0;
    out.fundamental = 1.0;
    return out;
  }
  line_to_line(flat_deg, out);
  // A ramp from 0 to 1 over h degrees has the mean square 1/3. Over a quarter turn the mean square is (w/2 +
  // h/3)/90 with the flat width w, degrees, and h = 90 - w/2.
  const double half_flat = flat_deg / 2.0, h_deg = 90.0 - half_flat, h = h_deg / 180.0 * base::pi;
  out.phase_rms = std::sqrt((half_flat + h_deg / 3.0) / 90.0);
  out.phase_peak = 1.0;
  out.fundamental = 4.0 / base::pi * base::sin(h) / h;
  return out;
}

ShapeFactors harmonic_factors(std::span<const double> orders, std::span<const double> sizes) {
  ShapeFactors out = shape_factors(BackEmfShape::sine, 120.0);
  double phase_square = 0.5, line_square = 1.5;
  for (std::size_t n = 0; n < orders.size(); ++n) {
    const double order = orders[n], c = sizes[n], third = order * base::pi / 3.0;
    out.sector_mean += c * (base::sin(third) + base::sin(2.0 * third)) / third;
    phase_square += c * c / 2.0;
    if (std::fmod(order, 3.0) != 0.0) line_square += 1.5 * c * c;
  }
  out.phase_rms = std::sqrt(phase_square);
  out.line_rms = std::sqrt(line_square);
  // The shapes are symmetric about their middle: half a turn is searched for their peaks, in 4096 steps.
  const auto phase = [&](double x) {
    double v = base::cos(x);
    for (std::size_t n = 0; n < orders.size(); ++n) v += sizes[n] * base::cos(orders[n] * x);
    return v;
  };
  out.line_peak = out.phase_peak = 0.0;
  for (int n = 0; n < 4096; ++n) {
    const double x = base::pi * n / 4096.0;
    out.line_peak = std::max(out.line_peak, std::abs(phase(x) - phase(x - 2.0 * base::pi / 3.0)));
    out.phase_peak = std::max(out.phase_peak, std::abs(phase(x)));
  }
  return out;
}

}  // namespace sixstep::design

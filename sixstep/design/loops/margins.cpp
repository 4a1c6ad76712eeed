// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/margins.hpp"

#include <array>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
namespace {

/// Real roots of a v^2 - 2 b v + c = 0, without cancellation; roots that do not exist are empty.
std::array<std::optional<double>, 2> roots(double a, double b, double c) {
  const double square = b * b - a * c;
  if (square < 0.0) return {};
  const double far = b + (b < 0.0 ? -std::sqrt(square) : std::sqrt(square));
  std::array<std::optional<double>, 2> found;
  if (far != 0.0) found[0] = c / far;
  if (a != 0.0) found[1] = far / a;
  return found;
}

/// L on the unit circle as a function of v = 1 - cos(w T_s), which keeps its digits for a loop that is slow
/// compared with the sampling.
struct OpenLoop {
  ZohPlant plant;
  PiGains gains;
  bool delayed;

  struct Point {
    double turn, size, phase;  ///< w T_s, |L|, and arg L in (-2 pi, 0]
  };

  Point at(double v) const {
    const double sine = std::sqrt(v * (2.0 - v)), cosine = 1.0 - v;
    const double turn = base::atan2(sine, cosine);
    const double K_i = gains.d1 + gains.d0, p = 1.0 + plant.a0;
    const double top = plant.b0 * std::sqrt(K_i * K_i - 2.0 * gains.d1 * gains.d0 * v);
    const double bottom = std::sqrt((p * p - 2.0 * plant.a0 * v) * 2.0 * v);
    double phase = base::atan2(gains.d1 * sine, K_i - gains.d1 * v)  // d1 z + d0
                   - base::atan2(sine, p - v)                        // z + a0
                   - base::atan2(sine, -v)                           // z - 1
                   - (delayed ? turn : 0.0);
    while (phase > 0.0) phase -= 2.0 * base::pi;
    while (phase <= -2.0 * base::pi) phase += 2.0 * base::pi;
    return {turn, top / bottom, phase};
  }
};

/// Finds where L is real, in addition to z = -1: Im(N conj D) = 0, divided by sin(w T_s). N and D are
/// numerator and denominator of L; c = cos(w T_s), p = a0 - 1, q = -a0, m = 1 if delayed.
///   m = 0: 2 d0 c = d1 (q - 1) - d0 p
///   m = 1: 4 d0 c^2 + 2 (d1 + d0 p) c + d1 p + d0 (q - 1) = 0
std::optional<double> gain_margin(const OpenLoop& loop) {
  const auto [d1, d0] = loop.gains;
  const double p = loop.plant.a0 - 1.0, q = -loop.plant.a0;
  std::array<std::optional<double>, 2> cosines;
  if (loop.delayed)
    cosines = roots(4.0 * d0, -(d1 + d0 * p), d1 * p + d0 * (q - 1.0));
  else if (d0 != 0.0)
    cosines[0] = (d1 * (q - 1.0) - d0 * p) / (2.0 * d0);
  double largest = 0.0;  // |L| on the negative real axis
  const auto look = [&](double v) {
    const OpenLoop::Point point = loop.at(v);
    if (std::abs(point.phase + base::pi) < 0.5 && point.size < 1.0 && point.size > largest)
      largest = point.size;
  };
  look(2.0);
  for (const std::optional<double>& c : cosines)
    if (c && *c > -1.0 && *c < 1.0) look(1.0 - *c);
  if (largest == 0.0) return std::nullopt;
  return 1.0 / largest;
}

}  // namespace

// Crossover, |N|^2 = |D|^2 in v = 1 - cos(w T_s): b0^2 (K_i^2 - 2 d1 d0 v) = ((1 + a0)^2 - 2 a0 v) 2 v, K_i =
// d1 + d0.
std::optional<Margins> margins(const ZohPlant& plant, const PiGains& gains, double period_s, bool delayed) {
  const double p = 1.0 + plant.a0, K_i = gains.d1 + gains.d0, square = plant.b0 * plant.b0;
  const OpenLoop loop{plant, gains, delayed};
  std::optional<Margins> least;
  for (const std::optional<double>& v :
       roots(4.0 * plant.a0, p * p + square * gains.d1 * gains.d0, square * K_i * K_i)) {
    if (!v || !(*v > 0.0 && *v < 2.0)) continue;
    const OpenLoop::Point point = loop.at(*v);
    const double phase_rad = base::pi + point.phase;
    if (least && least->phase_rad <= phase_rad) continue;
    least = Margins{.crossover_rad_s = point.turn / period_s,
                    .phase_rad = phase_rad,
                    .gain = std::nullopt,
                    .delay_s = phase_rad / point.turn * period_s};
  }
  if (least) least->gain = gain_margin(loop);
  return least;
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/step_errors.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// Mean error of a value u by rounding to steps; u, noise and result are in steps.
double mean_error(double u, double noise) {
  double sum = 0.0;
  for (int n = 1; n <= 8; ++n) {
    const double left = base::exp(-0.5 * base::turn_rad * base::turn_rad * n * n * noise * noise);
    if (left < 1e-6) break;
    sum += (n % 2 == 0 ? 1.0 : -1.0) / (base::pi * n) * left * base::sin(base::turn_rad * n * u);
  }
  return sum;
}

}  // namespace

StepErrors step_errors(const Converted& c) {
  constexpr int angles = 720, places = 8;
  const std::size_t harmonics = (c.unknowns.size() - 1) / 2;
  StepErrors out{std::vector<double>(harmonics), 0.0};
  const double noise = c.noise_V / c.step_V;
  if (!(c.step_V > 0.0) || base::exp(-0.5 * base::turn_rad * base::turn_rad * noise * noise) < 1e-6)
    return out;
  std::vector<double> cos(harmonics * angles), sin(harmonics * angles), u(angles, c.unknowns[0]);
  for (std::size_t m = 0; m < angles; ++m)
    for (std::size_t h = 0; h < harmonics; ++h) {
      const base::SinCos at =
          base::sin_cos(base::turn_rad * static_cast<double>(m * (h + 1) % angles) / angles);
      cos[h * angles + m] = at.cos;
      sin[h * angles + m] = at.sin;
      u[m] += c.unknowns[2 * h + 1] * at.cos + c.unknowns[2 * h + 2] * at.sin;
    }
  const auto top = static_cast<std::size_t>(std::max_element(u.begin(), u.end()) - u.begin());
  std::vector<double> error(angles);
  for (int place = 0; place < places; ++place) {
    for (std::size_t m = 0; m < angles; ++m)
      error[m] = mean_error(u[m] / c.step_V + static_cast<double>(place) / places, noise) * c.step_V;
    double at_top = 0.0;
    for (std::size_t h = 0; h < harmonics; ++h) {
      double a = 0.0, b = 0.0;
      for (std::size_t m = 0; m < angles; ++m) {
        a += error[m] * cos[h * angles + m] * 2.0 / angles;
        b += error[m] * sin[h * angles + m] * 2.0 / angles;
      }
      at_top += a * cos[h * angles + top] + b * sin[h * angles + top];
      out.harmonics_V[h] += 0.5 * (a * a + b * b) / places;
    }
    out.peak_V += at_top * at_top / places;
  }
  for (double& square : out.harmonics_V) square = std::sqrt(square);
  out.peak_V = std::sqrt(out.peak_V);
  return out;
}

}  // namespace sixstep::analysis

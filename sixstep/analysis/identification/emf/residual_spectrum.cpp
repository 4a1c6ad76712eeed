// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/residual_spectrum.hpp"

#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

void turn_by(double& c, double& s, double by_c, double by_s) {
  const double next = c * by_c - s * by_s;
  s = s * by_c + c * by_s;
  c = next;
}

}  // namespace

void ResidualSpectrum::take(double phase, double residual) {
  ++points_;
  const base::SinCos one = base::sin_cos(phase), step = base::sin_cos(phase / periods_);
  double c = 1.0, s = 0.0;
  for (std::size_t h = 0; h < harmonics_; ++h) {
    turn_by(c, s, one.cos, one.sin);
    double above_c = c, above_s = s, below_c = c, below_s = s;
    for (std::size_t k = 0; k < ordinates; ++k) {
      Sum &above = sums_[(2 * h) * ordinates + k], &below = sums_[(2 * h + 1) * ordinates + k];
      turn_by(above_c, above_s, step.cos, step.sin);
      turn_by(below_c, below_s, step.cos, -step.sin);
      above.re += residual * above_c, above.im += residual * above_s;
      below.re += residual * below_c, below.im += residual * below_s;
    }
  }
}

double ResidualSpectrum::variance(std::size_t harmonic) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 2 * ordinates; ++k) {
    if (!counts(harmonic, k)) continue;
    const Sum& s = sums_[2 * harmonic * ordinates + k];
    sum += s.re * s.re + s.im * s.im;
    ++count;
  }
  return sum / static_cast<double>(points_) / static_cast<double>(count) / left_part();
}

double ResidualSpectrum::degrees_of_freedom(std::size_t harmonic) const {
  double count = 0.0;
  for (std::size_t k = 0; k < 2 * ordinates; ++k) count += counts(harmonic, k) ? 2.0 : 0.0;
  return count * left_part();
}

bool ResidualSpectrum::counts(std::size_t harmonic, std::size_t ordinate) const {
  const double order =
      static_cast<double>(harmonic + 1) - static_cast<double>(ordinate % ordinates + 1) / periods_;
  return ordinate < ordinates || order > 0.5 / periods_;
}

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// Computes the noise of a fit's residual near each harmonic.
#pragma once
#include <cstddef>
#include <vector>

namespace sixstep::analysis {

/// Power of the residual at a few orders near each harmonic. The fit does not contain these orders.
class ResidualSpectrum {
 public:
  static constexpr std::size_t ordinates = 6;  ///< on each side of a harmonic, at intervals of 1/periods

  ResidualSpectrum(std::size_t harmonics, double periods)
      : periods_(periods), sums_(harmonics * 2 * ordinates), harmonics_(harmonics) {}

  /// Adds one residual, with the fundamental's phase at its time.
  void take(double phase, double residual);

  /// Variance of white noise with the same power near the harmonic as the residual; 0 is the fundamental.
  double variance(std::size_t harmonic) const;
  double degrees_of_freedom(std::size_t harmonic) const;

 private:
  struct Sum {
    double re = 0.0, im = 0.0;
  };
  /// Fraction of the ordinates' power that remains after the fit, which removes the fraction 1/periods.
  double left_part() const { return 1.0 - 1.0 / periods_; }
  /// True if an ordinate is used: below the fundamental, the ordinates end at the offset (order 0).
  bool counts(std::size_t harmonic, std::size_t ordinate) const;

  double periods_;
  std::vector<Sum> sums_;  // for each harmonic the ordinates above it, then the ordinates below it
  std::size_t harmonics_, points_ = 0;
};

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// The linear equivalent of a tracking loop. It is computed from its poles exp(s T), without the design's
// formulas.
#pragma once
#include <cmath>
#include <complex>

#include "sixstep/control/sensing/tracking.hpp"

namespace sixstep::control {

class SecondOrder {
 public:
  /// x is w_n T, with the natural frequency w_n and the period T. The damping is at most 1; for 1, the two
  /// poles are kept slightly apart.
  SecondOrder(double x, double damping)
      : z_(std::exp(
            std::complex<double>(-damping * x, x * std::sqrt(std::fmax(1 - damping * damping, 1e-8))))) {}

  double K_p() const { return 1 - std::norm(z_); }
  double K_i() const { return std::norm(1.0 - z_); }
  TrackingConfig config() const { return {FixedGain<std::int32_t>(K_p()), FixedGain<std::int32_t>(K_i())}; }

  /// The error n ticks after a step of 1: e[0] = 1, e[1] = 1 - K_p - K_i, and e[n] = Re(b z^n) with the pole
  /// z and the factor b.
  double error(int n) const { return (start() * std::pow(z_, n)).real(); }

  /// Largest effect of rounding on the error, in units of the angle. Each tick adds half a unit to the speed
  /// and half a unit to the error. Each of these two additions decays like a step. The speed is also rounded
  /// by 2^-17, and this rounding accumulates until the loop corrects it.
  double rounding() const {
    double sum = 0, speed_sum = 0, moved = 0;
    std::complex<double> z = 1;
    for (; std::abs(z) > 1e-6; z *= z_) {
      sum += std::fabs((start() * z).real());
      moved += (start() * z).real();
      speed_sum += std::fabs(moved);
    }
    return sum + speed_sum / 131072 + 1;
  }

 private:
  std::complex<double> start() const { return {1.0, (z_.real() - 1 + K_p() + K_i()) / z_.imag()}; }
  std::complex<double> z_;
};

}  // namespace sixstep::control

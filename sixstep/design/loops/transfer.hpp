// SPDX-License-Identifier: Apache-2.0
// Linear sampled systems as ratios of polynomials. They are computed from a state space with zero-order hold,
// connected in series, closed, checked for stability, and evaluated on the unit circle. They describe the
// drive between PWM and ADC while no limit acts. The variable is delta = z - 1 instead of z: a loop that
// settles in a second has poles at a distance of 1e-4 from z = 1; with several such poles, a polynomial in z
// would lose them by rounding (Middleton, Goodwin).
#pragma once
#include <array>
#include <vector>

namespace sixstep::design {

/// A complex number. std::complex is not used, because it calls the C library for magnitude and angle.
struct Complex {
  double re = 0.0, im = 0.0;

  friend Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator*(Complex a, Complex b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator/(Complex a, Complex b) {
    const double n = b.square();
    return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
  }
  double square() const { return re * re + im * im; }
  double size() const;
  double angle_rad() const;  ///< in [-pi, pi]
};

/// Coefficients of a polynomial in delta = z - 1, the constant first.
using Polynomial = std::vector<double>;

Polynomial product(const Polynomial& a, const Polynomial& b);
Polynomial sum(const Polynomial& a, const Polynomial& b);

/// num(z - 1)/den(z - 1). The leading coefficient of den is not 0, and num has no higher degree than den.
struct Transfer {
  Polynomial num{1.0}, den{1.0};

  /// Value at z = exp(j turn), turn = w T_s in rad.
  Complex at(double turn) const;
};

/// a and b in series.
Transfer series(const Transfer& a, const Transfer& b);
/// Delay of whole periods: z^-periods.
Transfer delay(int periods);
/// The closed loop L/(1 + L).
Transfer closed(const Transfer& loop);

/// True if all roots have |z| < 1, by z = (1 + w)/(1 - w) and Routh's scheme, which computes no root. It is
/// for the degrees of a drive: above a degree of some twenty the result is only rounding.
bool is_stable(const Polynomial& denominator);
/// 1 - |z| of the largest root: the fraction of a disturbance that decays per period. Computed by bisection
/// with is_stable(). Negative for an unstable system.
double slowest_decay(const Polynomial& denominator);

/// x' = A x + B u with at most four states, sampled with zero-order hold: transfer from u to the state
/// `output`. late_s is less than a period: an input begins to act late_s after its sample; until then the
/// input before it acts.
struct Linear {
  int states = 0;
  std::array<std::array<double, 4>, 4> A{};
  std::array<double, 4> B{};
};
Transfer sampled(const Linear& system, int output, double period_s, double late_s = 0.0);

}  // namespace sixstep::design

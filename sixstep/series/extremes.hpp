// SPDX-License-Identifier: Apache-2.0
// Finds all sign changes and the extremes of a polynomial over [0, 1], for figures of merit. The run loop
// does not use these functions.
#pragma once
#include <algorithm>
#include <cmath>

#include "sixstep/series/first_root.hpp"

namespace sixstep::series {

/// Sum of the coefficients' magnitudes: an upper bound of |y| over [0, 1].
template <class Real>
Real magnitude_of(const Coefficients<Real>& c, int degree) {
  Real sum = 0;
  for (int j = 0; j <= degree; ++j) sum += std::fabs(c[j]);
  return sum;
}

/// Calls visit(s) at every sign change in (0, 1), in ascending order. `scale` is the typical magnitude of the
/// polynomial; it determines the rounding level.
template <class Real, class Visit>
void for_each_sign_change(const Coefficients<Real>& c, int degree, Real scale, Visit&& visit) {
  const Real noise = Real(1e-15) * scale;
  Real begin = 0;
  for (int round = 0; round < 4 * max_degree && begin < 1; ++round) {
    Coefficients<Real> q = restricted(c, degree, begin, Real(1));
    const Leading lead = leading(q, degree, noise);
    if (lead.sign == 0) return;
    if (lead.sign < 0)
      for (Real& v : q) v = -v;
    const Real root = first_root(q, degree, Real(1), noise);
    if (root > 1) return;
    const Real at = begin + root * (1 - begin);
    if (at > 0 && at < 1) visit(at);
    begin = std::max(at, std::nextafter(begin, Real(2)));
  }
}

template <class Real>
struct Extremes {
  Real low, high;
};

/// Lowest and highest value over [0, 1], from the ends and the derivative's sign changes.
template <class Real>
Extremes<Real> extremes(const Coefficients<Real>& c, int degree) {
  const Real a = c[0], b = evaluate(c, degree, Real(1));
  Extremes<Real> e{std::min(a, b), std::max(a, b)};
  Coefficients<Real> slope{};
  for (int j = 1; j <= degree; ++j) slope[j - 1] = static_cast<Real>(j) * c[j];
  for_each_sign_change(slope, degree - 1, magnitude_of(slope, degree), [&](Real s) {
    const Real v = evaluate(c, degree, s);
    e = {std::min(e.low, v), std::max(e.high, v)};
  });
  return e;
}

}  // namespace sixstep::series

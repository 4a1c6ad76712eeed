// SPDX-License-Identifier: Apache-2.0
// Taylor coefficients of one segment as a function of s in [0, 1], the elapsed fraction of the segment's
// length h. Coefficient j of y is (h^j/j!) d^j y/dt^j. All series of a segment have the same degree.
#pragma once
#include <array>

namespace sixstep::series {

/// With degree 16 a segment of about half a time constant is exact to rounding. A higher degree costs time
/// and does not allow longer segments (model.md 12).
inline constexpr int max_degree = 16;

template <class Real>
using Coefficients = std::array<Real, max_degree + 1>;

/// y(s) - y(0). y(0) is omitted so that a compensated sum can add the increment.
template <class Real>
inline Real increment(const Coefficients<Real>& c, int degree, Real s) {
  Real sum = 0;
  for (int j = degree; j >= 1; --j) sum = (sum + c[j]) * s;
  return sum;
}

template <class Real>
inline Real evaluate(const Coefficients<Real>& c, int degree, Real s) {
  return c[0] + increment(c, degree, s);
}

/// Coefficient n of the product of two series (Cauchy); n is a compile-time constant and the sum is unrolled.
/// The newest coefficients are added last, so that a recurrence can sum all others while it still computes
/// the newest.
template <int n, class Real>
inline Real product_term(const Coefficients<Real>& a, const Coefficients<Real>& b) {
  if constexpr (n == 0) {
    return a[0] * b[0];
  } else {
    Real even = 0, odd = 0;
#pragma GCC unroll 32
    for (int j = 1; j < n; ++j) (j % 2 == 0 ? even : odd) += a[j] * b[n - j];
    return (even + odd) + (a[0] * b[n] + a[n] * b[0]);
  }
}

/// Coefficient n >= 1 of (a - a[0]) b. This sum does not depend on the newest coefficient of b, so that a
/// recurrence need not wait for it. The sum begins with a product, because an addition to zero would be an
/// additional operation in the chain.
template <int n, class Real>
inline Real increment_product_term(const Coefficients<Real>& a, const Coefficients<Real>& b) {
  if constexpr (n == 1) {
    return a[1] * b[0];
  } else if constexpr (n == 2) {
    return a[1] * b[1] + a[2] * b[0];
  } else {
    Real even = a[2] * b[n - 2], odd = 0;
    if constexpr (n > 3) odd = a[3] * b[n - 3];
#pragma GCC unroll 32
    for (int j = 4; j < n; ++j) (j % 2 == 0 ? even : odd) += a[j] * b[n - j];
    if constexpr (n > 3)
      return (even + a[1] * b[n - 1]) + (odd + a[n] * b[0]);
    else
      return (even + a[1] * b[n - 1]) + a[n] * b[0];
  }
}

/// Half of coefficient n >= 2 of (a - a[0])^2: each pair of factors is added once.
template <int n, class Real>
inline Real half_increment_square_term(const Coefficients<Real>& a) {
  Real sum = n % 2 == 0 ? a[n / 2] * a[n / 2] * Real(0.5) : a[n / 2] * a[n / 2 + 1];
#pragma GCC unroll 32
  // mutant: (n - 1) / 2 - n % 2 => (n - 1) / 2
  for (int j = (n - 1) / 2 - n % 2; j >= 1; --j) sum += a[j] * a[n - j];
  return sum;
}

/// Coefficient n of the product of two series, for an n that is not a compile-time constant.
template <class Real>
inline Real product_term(const Coefficients<Real>& a, const Coefficients<Real>& b, int n) {
  Real sum = 0;
  for (int j = 0; j <= n; ++j) sum += a[j] * b[n - j];
  return sum;
}

/// Integral of y over s from 0 to `to`, in units of h.
template <class Real>
inline Real integral(const Coefficients<Real>& c, int degree, Real to) {
  Real sum = 0;
  for (int j = degree; j >= 0; --j) sum = sum * to + c[j] / static_cast<Real>(j + 1);
  return sum * to;
}

/// Integral of the product of two polynomials over s from 0 to `to`, in units of h. The result is exact to
/// rounding, because all 2 degree + 1 terms are summed.
template <class Real>
inline Real product_integral(const Coefficients<Real>& a, const Coefficients<Real>& b, int degree, Real to) {
  Real sum = 0;
  // mutant: 2 * degree => 2 * degree - 1
  for (int n = 2 * degree; n >= 0; --n) {
    Real term = 0;
    const int first = n > degree ? n - degree : 0;
    const int last = n < degree ? n : degree;
    for (int j = first; j <= last; ++j) term += a[j] * b[n - j];
    sum = sum * to + term / static_cast<Real>(n + 1);
  }
  return sum * to;
}

/// The polynomial over [from, to], as a function of a new s from 0 to 1 (Taylor shift, then scaling).
template <class Real>
inline Coefficients<Real> restricted(Coefficients<Real> c, int degree, Real from, Real to) {
  if (from != 0)
    for (int level = 0; level < degree; ++level)
      // mutant: j >= level => j > level
      for (int j = degree - 1; j >= level; --j) c[j] += from * c[j + 1];
  Real power = 1;
  for (int j = 0; j <= degree; ++j, power *= to - from) c[j] *= power;
  return c;
}

/// Adds dy to the running sum y and stores the rounding error in `low` (Kahan), so that a million segments
/// lose no digits.
template <class Real>
inline void add_compensated(Real& y, Real& low, Real dy) {
  const Real term = dy + low;
  const Real sum = y + term;
  // mutant: term - (sum - y) => dy - (sum - y)
  low = term - (sum - y);
  y = sum;
}

/// A running sum with its rounding error.
template <class Real>
struct CompensatedSum {
  Real value = 0, low = 0;
  void add(Real by) { add_compensated(value, low, by); }
  void set(Real to) { value = to, low = 0; }
};

}  // namespace sixstep::series

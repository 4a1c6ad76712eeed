// SPDX-License-Identifier: Apache-2.0
// Solves a first-order lag over one segment exactly: dx/dt = (u - x)/tau with u a polynomial in s (model.md 4).
//
//   x(s) - x(0) = w_0 (u_0 - x(0)) + sum_(j >= 1) w_j u_j s^j
//   w_j = z integral_0^1 exp(-z (1 - r)) r^j dr,   z = s h/tau
//
// x: output, u: input, h: length of the segment. tau: time constant of the lag. Each w_j is in [0, 1], so
// that no digits cancel, even if the segment is a billionth of tau, or tau a billionth of the segment. The
// weights are the same for all inputs with the same tau.
#pragma once
#include "sixstep/base/elementary.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::series {

using LagWeights = Coefficients<double>;

/// Weights w_0 to w_degree. An infinite z means no lag, and all weights are 1. Integration by parts results
/// in the recurrence w_j = 1 - (j/z) w_(j-1). In the order of increasing j, the recurrence reduces its error
/// if j <= z; in decreasing order, if j > z. The function therefore computes upwards to z. From a high order
/// with an initial guess it computes downwards, until the error of the guess is negligible.
inline LagWeights lag_weights(double z, int degree) {
  LagWeights w{};
  const int up = z < degree ? static_cast<int>(z) : degree;
  int last = -1;  // highest order that was computed upwards
  if (up > 0) {
    w[0] = 1 - base::exp(-z);
    for (int j = 1; j <= up; ++j) w[j] = 1 - j / z * w[j - 1];
    last = up;
  }
  if (last == degree) return w;
  // The initial guess has a relative error of 1e-3. n steps from the guess down to the degree d multiply this
  // error by z^n/((d + 1)...(d + n)), which is below 1e-18 for all z < d <= 16.
  const int from = max_degree + 10 + static_cast<int>(2.5 * z);
  double next = z / (z + from + 1);
  for (int j = from; j > last + 1; --j) {
    if (j <= degree) w[j] = next;
    next = z / j * (1 - next);
  }
  w[last + 1] = next;
  return w;
}

/// Change of a lag's output from x at the segment's start to the output at the fraction s. `w`: weights for z
/// = s h/tau.
template <class Real>
inline double lag_increment(const Coefficients<Real>& u, int degree, double s, const LagWeights& w,
                            double x) {
  double sum = 0;
  for (int j = degree; j >= 1; --j) sum = (sum + w[j] * static_cast<double>(u[j])) * s;
  // mutant: static_cast<double>(u[0]) - x => static_cast<double>(u[0])
  return w[0] * (static_cast<double>(u[0]) - x) + sum;
}

}  // namespace sixstep::series

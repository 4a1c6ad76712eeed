// SPDX-License-Identifier: Apache-2.0
// Finds the first instant at which a guard becomes negative. The root is exact to rounding, and no root is
// missed. The search tries a cheap bound first, then Newton's method if the guard is strictly monotone, else
// Bernstein subdivision.
#pragma once
#include <array>
#include <cmath>

#include "sixstep/series/polynomial.hpp"

namespace sixstep::series {

/// Result for a guard that does not become negative: a value beyond the end of every segment. A std::optional
/// would cost 2 % of the run loop's time.
template <class Real>
inline constexpr Real no_root = 2;

/// The first coefficient of a guard that exceeds `noise`: its index `order` and its sign, which is the sign
/// of the guard just after the start. If no coefficient exceeds `noise`, `order` is degree + 1 and `sign` 0.
struct Leading {
  int order = 0;
  int sign = 0;
};

template <class Real>
inline Leading leading(const Coefficients<Real>& c, int degree, Real noise) {
  for (int j = 0; j <= degree; ++j) {
    if (c[j] > noise) return {j, 1};
    if (c[j] < -noise) return {j, -1};
  }
  return {degree + 1, 0};
}

namespace detail {

/// Bounds that show whether a polynomial falls, rises or has no zero in [0, length].
template <class Real>
struct Outline {
  Real at_end = 0, tail = 0;  ///< value at `length`; sum of |q_j| length^j over j >= 1
  Real slope_rest = 0;        ///< sum_{j >= 2} j |q_j| length^(j-1)
};

/// Outline for the length 1, which needs no products.
template <class Real>
Outline<Real> outline(const Real* q, int n) {
  Outline<Real> of;
  for (int j = n; j >= 2; --j) {
    of.tail += std::fabs(q[j]);
    of.at_end += q[j];
    of.slope_rest += of.tail;
  }
  // mutant: of.slope_rest += of.tail; => nothing
  of.slope_rest += of.tail;  // term j has now been added j times
  of.tail += std::fabs(q[1]);
  of.at_end = q[0] + (q[1] + of.at_end);
  return of;
}

template <class Real>
Outline<Real> outline(const Real* q, int n, Real length) {
  if (length == 1) return outline(q, n);
  Outline<Real> of;
  for (int j = n; j >= 1; --j) {
    const Real size = std::fabs(q[j]);
    of.tail = (of.tail + size) * length;
    of.at_end = (of.at_end + q[j]) * length;
    // mutant: static_cast<Real>(j) => static_cast<Real>(j - 1)
    if (j >= 2) of.slope_rest = (of.slope_rest + static_cast<Real>(j) * size) * length;
  }
  of.at_end += q[0];
  return of;
}

/// Value and the first two derivatives of a polynomial at one point.
template <class Real>
struct Local {
  Real value = 0, slope = 0, bend = 0;  ///< bend: half the second derivative
};

/// Evaluates c at s. Even and odd powers are separate, c(s) = e(s^2) + s o(s^2), so that two chains of half
/// the length are computed in parallel.
template <class Real>
inline Local<Real> local(const Real* c, int degree, Real s) {
  const Real t = s * s;
  Local<Real> e, o;
  const auto append = [t](Local<Real>& of, Real next) {
    of.bend = of.bend * t + of.slope;
    of.slope = of.slope * t + of.value;
    of.value = of.value * t + next;
  };
  int j = degree;
  if (j % 2 == 0) e.value = c[j--];
  if (j > 0) {
    o.value = c[j];
    for (j -= 2; j > 0; j -= 2) {
      append(e, c[j + 1]);
      append(o, c[j]);
    }
    append(e, c[0]);
  }
  // mutant: 2 * (s * e.slope + t * o.slope) => 2 * s * e.slope
  return {e.value + s * o.value, o.value + 2 * (s * e.slope + t * o.slope),
          // mutant: 4 * (t * o.bend) => Real(0)
          e.slope + 4 * (t * e.bend) + s * (3 * o.slope + 4 * (t * o.bend))};
}

/// Finds the only root in (low, high], where c(low) > 0 >= c(high). Newton's method starts from `guess`. A
/// step that would leave the interval is replaced by a bisection. The last step includes the curvature; its
/// relative error is about 2 (bend/slope step)^2.
template <class Real>
Real bracketed_root(const Real* c, int degree, Real low, Real high, Real guess) {
  // If the step and the correction by the curvature are smaller than this, another step would change only the
  // rounding error.
  constexpr Real small = Real(sizeof(Real) > 8 ? 3e-7L : 4e-6L);
  const Real last_step = small * (high - low);
  Real s = guess > low && guess < high ? guess : low + (high - low) / 2;
  for (int round = 0; round < 200; ++round) {
    const auto [value, slope, bend] = local(c, degree, s);
    (value > 0 ? low : high) = s;
    const Real inverse = 1 / slope, step = -value * inverse, newton = s + step;
    const bool inside = slope < 0 && newton >= low && newton <= high;
    const Real turn = bend * inverse * step;
    // mutant: turn * step => Real(0)
    // mutant: std::fabs(step) <= last_step && std::fabs(turn) <= small => std::fabs(step) <= 1e-2
    if (inside && std::fabs(step) <= last_step && std::fabs(turn) <= small) return newton - turn * step;
    Real next = newton;
    if (!inside || newton == low || newton == high) {
      next = low + (high - low) / 2;
      if (next <= low || next >= high) return next;
    }
    s = next;
  }
  return s;
}

/// The root of a falling, nearly linear polynomial, exact to fourth order. From this value one Newton step
/// suffices. Formula: reversion of a series, Abramowitz and Stegun 3.6.25.
template <class Real>
Real near_root(const Real* c, int degree) {
  const Real inverse = 1 / c[1], straight = -c[0] * inverse;
  if (degree < 4) return straight;
  const Real p = c[2] * inverse, q = c[3] * inverse, r = c[4] * inverse, pp = p * p;
  const Real near = 1 - straight * p, far = (2 * pp - q) - straight * (5 * p * (pp - q) + r);
  return straight * (near + straight * straight * far);
}

template <class Real>
Coefficients<Real> to_bernstein(const Real* c, int degree, Real length) {
  // b_i = sum_{j <= i} C(i, j)/C(degree, j) c_j length^j, by repeated differences, without stored binomials.
  Coefficients<Real> scaled{}, b{};
  Real power = 1, choose = 1;
  for (int j = 0; j <= degree; ++j) {
    scaled[j] = c[j] * power / choose;
    power *= length;
    choose = choose * static_cast<Real>(degree - j) / static_cast<Real>(j + 1);
  }
  for (int i = 0; i <= degree; ++i) {
    Real sum = 0, binomial = 1;
    for (int j = 0; j <= i; ++j) {
      sum += binomial * scaled[j];
      binomial = binomial * static_cast<Real>(i - j) / static_cast<Real>(j + 1);
    }
    b[i] = sum;
  }
  return b;
}

template <class Real>
int sign_changes(const Coefficients<Real>& b, int degree) {
  int changes = 0;
  bool positive = b[0] > 0;
  for (int i = 1; i <= degree; ++i) {
    const bool now = b[i] > 0;
    changes += now != positive;
    positive = now;
  }
  return changes;
}

/// Splits the interval in the middle by de Casteljau's algorithm: `b` becomes the left half, and the right
/// half is returned.
template <class Real>
Coefficients<Real> split_half(Coefficients<Real>& b, int degree) {
  Coefficients<Real> right{};
  for (int level = 0; level < degree; ++level) {
    right[degree - level] = b[degree];
    for (int i = degree; i > level; --i) b[i] = (b[i - 1] + b[i]) / 2;
  }
  right[0] = b[degree];
  return right;
}

/// Finds the first root in [0, length] by halving, the left part first. The number of sign changes of a
/// piece's coefficients is 0 if the piece contains no root, 1 if it contains one root (Descartes). A piece
/// that is too narrow for another split touches zero within rounding, and counts as the root.
template <class Real>
Real subdivide(const Real* c, int degree, Real length) {
  constexpr int depth_limit = 50;
  struct Piece {
    Coefficients<Real> b;
    Real low, high;
    int depth;
  };
  std::array<Piece, depth_limit + 2> stack;
  int top = 0;
  stack[top++] = {to_bernstein(c, degree, length), Real(0), length, 0};
  while (top > 0) {
    Piece piece = stack[--top];
    const int changes = sign_changes(piece.b, degree);
    if (changes == 0) {
      if (!(piece.b[0] > 0)) return piece.low;
      continue;
    }
    if (changes == 1 && piece.b[0] > 0) return bracketed_root(c, degree, piece.low, piece.high, piece.low);
    if (piece.depth >= depth_limit) return piece.low;
    const Real middle = piece.low + (piece.high - piece.low) / 2;
    const Coefficients<Real> right = split_half(piece.b, degree);
    stack[top++] = {right, middle, piece.high, piece.depth + 1};
    stack[top++] = {piece.b, piece.low, middle, piece.depth + 1};
  }
  return no_root<Real>;
}

}  // namespace detail

/// Upper bound of |y(s) - y(0)| over [0, 1]. The sums of even and odd terms are separate, so that the
/// processor computes them in parallel.
template <class Real>
inline Real tail_bound(const Coefficients<Real>& c, int degree) {
  Real even = 0, odd = 0;
  // mutant: j <= degree => j < degree
  for (int j = 2; j <= degree; j += 2) even += std::fabs(c[j]);
  for (int j = 1; j <= degree; j += 2) odd += std::fabs(c[j]);
  return even + odd;
}

/// True if a guard is certainly above zero in [0, 1]. The function uses the guard's first two terms, which
/// are a straight line, and a bound `rest` of the sum of all other terms. In one case both ends of the line
/// are far enough from zero. In the other case the line rises from zero so steeply that the other terms
/// cannot make the guard fall. False means: not decided.
template <class Real>
inline bool stays_above(Real start, Real slope, Real rest, Real noise) {
  const Real lowest = slope < 0 ? start + slope : start, margin = rest + 2 * noise;
  return lowest > margin || (2 * start > -noise && slope > margin);
}

/// First s in [0, length], length <= 1, at which the polynomial becomes negative. The result is 0 if the
/// polynomial is negative just after the start, and no_root if it never becomes negative. `noise` is the
/// rounding level of the guard. Leading coefficients below it count as zero and are divided out. A segment
/// that starts at the event therefore does not repeat the event.
template <class Real>
Real first_root(const Coefficients<Real>& c, int degree, Real length, Real noise) {
  // The most frequent case first: the value at the start is larger than the sum of all other terms.
  if (c[0] > noise && c[0] > tail_bound(c, degree)) return no_root<Real>;

  const Leading start = leading(c, degree, noise);
  if (start.sign == 0) return no_root<Real>;
  if (start.sign < 0) return Real(0);
  const Real* q = c.data() + start.order;
  const int n = degree - start.order;
  if (n == 0) return no_root<Real>;

  const auto [at_end, tail, slope_rest] = detail::outline(q, n, length);
  if (q[0] > tail) return no_root<Real>;
  if (q[1] > slope_rest) return no_root<Real>;  // strictly rising
  if (-q[1] > slope_rest) {                     // strictly falling: one root or none
    if (at_end > 0) return no_root<Real>;
    return detail::bracketed_root(q, n, Real(0), length, detail::near_root(q, n));
  }
  return detail::subdivide(q, n, length);
}

}  // namespace sixstep::series

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/transfer.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
namespace {

Complex value(const Polynomial& p, Complex delta) {
  Complex sum;
  for (std::size_t n = p.size(); n-- > 0;) sum = sum * delta + Complex{p[n], 0.0};
  return sum;
}

/// Matrix of the states and the held input, of at most 5 x 5.
using Square = std::array<std::array<double, 5>, 5>;

Square times(const Square& a, const Square& b) {
  Square c{};
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t column = 0; column < 5; ++column) c[row][column] += a[row][k] * b[k][column];
  return c;
}

/// exp(M) - 1. The series is summed for M/2^n, and the result is doubled n times by E -> 2 E + E^2. With a
/// norm below 1/16 the error of twelve terms is (1/16)^13/13!, far below rounding.
Square exponential_minus_one(Square m) {
  double norm = 0.0;
  for (const auto& row : m) {
    double sum = 0.0;
    for (const double x : row) sum += std::fabs(x);
    norm = std::max(norm, sum);
  }
  int halvings = 0;
  for (; norm > 1.0 / 16.0 && halvings < 60; norm /= 2.0) ++halvings;
  const double scale = 1.0 / static_cast<double>(1LL << halvings);
  for (auto& row : m)
    for (double& x : row) x *= scale;
  Square e{};
  for (int n = 12; n >= 1; --n) {  // M (1 + M/2 (1 + M/3 ..)) by Horner
    for (std::size_t k = 0; k < 5; ++k) e[k][k] += 1.0;
    e = times(m, e);
    for (auto& row : e)
      for (double& x : row) x /= n;
  }
  for (int n = 0; n < halvings; ++n) {
    const Square square = times(e, e);
    for (std::size_t row = 0; row < 5; ++row)
      for (std::size_t k = 0; k < 5; ++k) e[row][k] = 2.0 * e[row][k] + square[row][k];
  }
  return e;
}

/// Coefficients of det(delta - E) by Faddeev and LeVerrier, the constant first.
Polynomial characteristic(const Square& e, int states) {
  Polynomial p(static_cast<std::size_t>(states) + 1);
  p.back() = 1.0;
  Square m{};
  const auto size = static_cast<std::size_t>(states);
  for (int k = 1; k <= states; ++k) {
    const auto index = static_cast<std::size_t>(states - k);
    for (std::size_t n = 0; n < size; ++n) m[n][n] += p[index + 1];
    Square next{};
    double trace = 0.0;
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t column = 0; column < size; ++column)
        for (std::size_t n = 0; n < size; ++n) next[row][column] += e[row][n] * m[n][column];
      trace += next[row][row];
    }
    p[index] = -trace / k;
    m = next;
  }
  return p;
}

/// True if all roots have a negative real part: Routh's scheme then has no change of sign.
bool is_hurwitz(Polynomial p) {
  if (p.back() < 0.0)
    for (double& x : p) x = -x;
  while (p.size() > 1) {
    const std::size_t n = p.size() - 1;
    if (!(p[n] > 0.0 && p[n - 1] > 0.0)) return false;
    const double ratio = p[n] / p[n - 1];
    for (std::size_t k = n - 1; k >= 2; k -= 2) {  // p_(n-2) -= ratio p_(n-3), p_(n-4) -= ratio p_(n-5), ..
      p[k - 1] -= ratio * p[k - 2];
      if (k == 2 || k == 3) break;
    }
    p.pop_back();
  }
  return true;
}

}  // namespace

double Complex::size() const { return std::sqrt(square()); }
double Complex::angle_rad() const { return base::atan2(im, re); }

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1);
  for (std::size_t n = 0; n < a.size(); ++n)
    for (std::size_t k = 0; k < b.size(); ++k) c[n + k] += a[n] * b[k];
  return c;
}

Polynomial sum(const Polynomial& a, const Polynomial& b) {
  Polynomial c(std::max(a.size(), b.size()));
  for (std::size_t n = 0; n < a.size(); ++n) c[n] += a[n];
  for (std::size_t n = 0; n < b.size(); ++n) c[n] += b[n];
  return c;
}

// At z = exp(j t), t = turn: exp(j t) - 1 = -2 sin^2(t/2) + j sin t, which has no cancellation.
Complex Transfer::at(double turn) const {
  const double half = base::sin(turn / 2.0);
  const Complex delta{-2.0 * half * half, base::sin(turn)};
  return value(num, delta) / value(den, delta);
}

Transfer series(const Transfer& a, const Transfer& b) {
  return {product(a.num, b.num), product(a.den, b.den)};
}

Transfer delay(int periods) {
  Transfer t;
  for (int n = 0; n < periods; ++n) t.den = product(t.den, {1.0, 1.0});
  return t;
}

Transfer closed(const Transfer& loop) { return {loop.num, sum(loop.num, loop.den)}; }

// With delta = 2 w/(1 - w), all roots of sum p_k (2 w)^k (1 - w)^(n - k) must be in the left half plane.
bool is_stable(const Polynomial& denominator) {
  const std::size_t n = denominator.size() - 1;
  Polynomial in_w(n + 1), power{1.0};
  for (std::size_t k = n + 1; k-- > 0;) {  // power = (1 - w)^(n - k)
    double scale = denominator[k];
    for (std::size_t doubling = 0; doubling < k; ++doubling) scale *= 2.0;
    for (std::size_t m = 0; m < power.size(); ++m) in_w[k + m] += scale * power[m];
    power = product(power, {1.0, -1.0});
  }
  return in_w.back() != 0.0 && is_hurwitz(in_w);
}

// Roots with |z| < r are roots with |z/r| < 1, for which delta = r delta' - (1 - r).
double slowest_decay(const Polynomial& denominator) {
  const auto inside = [&](double decay) {
    const Polynomial shifted{-decay, 1.0 - decay};
    Polynomial p{denominator.back()};
    for (std::size_t n = denominator.size() - 1; n-- > 0;) p = sum(product(p, shifted), {denominator[n]});
    return is_stable(p);
  };
  double low = 0.0, high = 1.0;  // inside(low), not inside(high)
  if (!inside(0.0)) {
    for (high = 0.0, low = -1e-9; !inside(low) && low > -0x1p60; low *= 2.0) high = low;
  }
  for (int n = 0; n < 200; ++n) {
    const double middle = low + (high - low) / 2.0;
    if (!(middle > low && middle < high)) break;
    (inside(middle) ? low : high) = middle;
  }
  return low;
}

namespace {

/// exp([A B; 0 0] t) - 1: the change of the states in a time t while the input is held.
Square step_of(const Linear& system, double time_s) {
  const auto n = static_cast<std::size_t>(system.states);
  Square m{};
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t k = 0; k < n; ++k) m[row][k] = system.A[row][k] * time_s;
    m[row][n] = system.B[row] * time_s;
  }
  return exponential_minus_one(m);
}

/// Numerator of C (delta - E)^-1 x over the denominator `den`, from C (delta - E)^-1 x = sum C E^(k-1) x
/// delta^-k. E is `step`, and x is the last column of `held`.
Polynomial numerator(const Square& step, const Square& held, const Polynomial& den, int output) {
  const std::size_t n = den.size() - 1;
  std::array<double, 5> x{};
  for (std::size_t row = 0; row < n; ++row) x[row] = held[row][n];
  Polynomial num(n, 0.0);
  for (std::size_t k = 1; k <= n; ++k) {
    const double g = x[static_cast<std::size_t>(output)];
    for (std::size_t power = k; power <= n; ++power) num[power - k] += g * den[power];
    std::array<double, 5> next{};
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t c = 0; c < n; ++c) next[row] += step[row][c] * x[c];
    x = next;
  }
  return num;
}

}  // namespace

// G(t) is the change of the states by an input during a time t. x' = E x + (G(T) - G(T - late)) u/z + G(T -
// late) u. Over the denominator z den, the numerator is the numerator of G(T) plus z - 1 times the numerator
// of G(T - late).
Transfer sampled(const Linear& system, int output, double period_s, double late_s) {
  const Square step = step_of(system, period_s);
  Transfer t;
  t.den = characteristic(step, system.states);
  t.num = numerator(step, step, t.den, output);
  if (!(late_s > 0.0)) return t;
  const Polynomial fresh = numerator(step, step_of(system, period_s - late_s), t.den, output);
  t.num = sum(t.num, product(fresh, {0.0, 1.0}));
  t.den = product(t.den, {1.0, 1.0});
  return t;
}

}  // namespace sixstep::design

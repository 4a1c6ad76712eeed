// SPDX-License-Identifier: Apache-2.0
// first_root() is compared with constructed roots, and with the roots on a plain grid. It is also tested with
// the critical cases of a simulator: a start on the boundary, a root at the end, and a polynomial that
// touches zero.
#include "sixstep/series/first_root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::series;
using Poly = Coefficients<double>;
using Exact = std::array<long double, max_degree + 1>;

constexpr double eps = 0x1p-52;
constexpr std::uint32_t seed = 20240917;

/// Multiplies the polynomial c by (s - root), in long double.
void multiply_root(Exact& c, int& degree, long double root) {
  ++degree;
  for (int j = degree; j >= 1; --j) c[j] = c[j - 1] - root * c[j];
  c[0] *= -root;
}

/// Multiplies the polynomial c by (s - centre)^2 + offset^2, which has no real root.
void multiply_pair(Exact& c, int& degree, long double centre, long double offset) {
  const Exact before = c;
  degree += 2;
  for (int j = 0; j <= degree; ++j) {
    c[j] = before[j] * (centre * centre + offset * offset);
    if (j >= 1) c[j] -= 2 * centre * before[j - 1];
    if (j >= 2) c[j] += before[j - 2];
  }
}

long double value_of(const Exact& c, int degree, long double s) {
  long double v = 0;
  for (int j = degree; j >= 0; --j) v = v * s + c[j];
  return v;
}

long double magnitude(const Exact& c, int degree) {
  long double sum = 0;
  for (int j = 0; j <= degree; ++j) sum += std::fabs(c[j]);
  return sum;
}

Poly rounded(const Exact& c, int degree) {
  Poly p{};
  for (int j = 0; j <= degree; ++j) p[j] = static_cast<double>(c[j]);
  return p;
}

/// A polynomial of degree up to 14 that is positive on [0, 1].
Exact random_positive(std::mt19937_64& random, int& degree) {
  std::uniform_real_distribution<long double> unit(0, 1);
  Exact c{};
  c[0] = 1;
  degree = 0;
  const int wanted = static_cast<int>(random() % 15);
  while (degree < wanted) {
    if (degree + 2 <= wanted && random() % 2 == 0)
      multiply_pair(c, degree, 2 * unit(random) - 0.5L, 0.05L + unit(random));
    else
      multiply_root(c, degree, random() % 2 == 0 ? -0.05L - 3 * unit(random) : 1.05L + 3 * unit(random));
  }
  if (c[0] < 0)
    for (auto& v : c) v = -v;
  return c;
}

/// Bound of the rounding errors of the coefficients, of the Bernstein form and of an evaluation. Each error
/// is at most degree * eps times the sum of the coefficients' magnitudes, which is a bound of every summed
/// term.
double value_error(const Exact& c, int degree) {
  return 4.0 * (degree + 1) * eps * static_cast<double>(magnitude(c, degree));
}

struct Planted {
  Exact exact{};
  int degree = 0;
  double a = 0, delta = 0, rest_at_a = 0, depth = 0;
};

Planted plant_pair(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Planted p;
  p.delta = std::exp(std::log(1e-7) + unit(random) * std::log(0.5 / 1e-7));
  p.a = 0.001 + unit(random) * (0.998 - p.delta);
  p.exact = random_positive(random, p.degree);
  p.rest_at_a = static_cast<double>(value_of(p.exact, p.degree, p.a));
  const long double half = 0.5L * p.delta, middle = p.a + half;
  p.depth = static_cast<double>(value_of(p.exact, p.degree, middle) * half * half);
  multiply_root(p.exact, p.degree, p.a);
  multiply_root(p.exact, p.degree, static_cast<long double>(p.a) + p.delta);
  return p;
}

TEST(Pitfall09_FirstRootSafely, FindsTheFirstOfEveryPlantedClosePair) {
  std::mt19937_64 random{seed};
  int resolvable = 0;
  for (int n = 0; resolvable < 200000; ++n) {
    ASSERT_LT(n, 2000000);
    const Planted p = plant_pair(random);
    const double error = value_error(p.exact, p.degree);
    if (p.depth <= 2 * error) continue;  // rounding may raise such a dip above zero
    ++resolvable;
    const auto root = first_root(rounded(p.exact, p.degree), p.degree, 1.0, 0.0);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " polynomial " << n << " degree " << p.degree
                                      << " a " << p.a << " delta " << p.delta);
    ASSERT_LE(root, 1.0);
    // With x = s - a, the first solution of x (x - delta) g = +-error is within 2 error/(g delta) of 0. The
    // tolerance is twice this bound, because the remaining factor g varies.
    ASSERT_NEAR(root, p.a, 4 * error / (p.rest_at_a * p.delta) + eps);
  }
}

TEST(FirstRoot, FindsNoneWherePositiveThroughout) {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 50000; ++n) {
    int degree = 0;
    const Exact c = random_positive(random, degree);
    long double least = c[0];
    for (int k = 0; k <= 200; ++k) least = std::min(least, value_of(c, degree, k / 200.0L));
    if (least < 100 * value_error(c, degree)) continue;
    EXPECT_GT(first_root(rounded(c, degree), degree, 1.0, 0.0), 1.0)
        << "seed " << seed << " polynomial " << n << " degree " << degree;
  }
}

TEST(FirstRoot, ClearsWhateverTheOutlineClears) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int cleared = 0, cleared_on_zero = 0;
  for (int n = 0; n < 50000; ++n) {
    const int degree = 3 + n % 12;
    Coefficients<double> c{};
    const double noise = 1e-14;
    double rest = 0.0;
    for (int j = 2; j <= degree; ++j) rest += std::fabs(c[j] = any(random) * std::pow(0.3, j));
    c[1] = any(random);
    c[0] = n % 3 == 0 ? 0.4 * noise * any(random) : any(random);
    if (!stays_above(c[0], c[1], rest, noise)) continue;
    ++cleared;
    cleared_on_zero += n % 3 == 0;
    ASSERT_EQ(first_root(c, degree, 1.0, noise), no_root<double>) << "seed " << seed << " polynomial " << n;
    ASSERT_GT(leading(c, degree, noise).sign, 0) << "seed " << seed << " polynomial " << n;
  }
  EXPECT_GT(cleared, 1000);
  EXPECT_GT(cleared_on_zero, 1000);
}

TEST(FirstRoot, AgreesWithANaiveGrid) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr int grid = 1000;
  int found = 0;
  for (int n = 0; n < 20000; ++n) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " polynomial " << n);
    const int degree = 1 + static_cast<int>(random() % max_degree);
    const double length = n % 3 == 0 ? 0.37 : 1.0;
    Poly c{};
    Exact exact{};
    for (int j = 0; j <= degree; ++j) exact[j] = c[j] = any(random);
    exact[0] = c[0] = std::fabs(c[0]) * (n % 2 == 0 ? 1.0 : 0.1);
    const double error = value_error(exact, degree);
    const auto root = first_root(c, degree, length, 0.0);
    const double end = std::min(root, length);
    if (root != no_root<double>) {
      ++found;
      EXPECT_NEAR(static_cast<double>(value_of(exact, degree, root)), 0.0, error);
      EXPECT_LE(root, length);
    }
    for (int k = 0; k <= grid && length * k / grid < end; ++k) {
      const double s = length * k / grid;
      ASSERT_GE(static_cast<double>(value_of(exact, degree, s)), -error) << s << " before " << end;
    }
  }
  EXPECT_GT(found, 5000);  // the sample is large enough
}

TEST(FirstRoot, NegativeStartIsNow) {
  EXPECT_EQ(first_root<double>({-1.0, 5.0}, 1, 1.0, 1e-15), 0.0);
  EXPECT_EQ(first_root<double>({0.0, -1.0}, 1, 1.0, 1e-15), 0.0);
  EXPECT_EQ(first_root<double>({0.0, 0.0, 0.0, -1e-9}, 3, 1.0, 1e-15), 0.0);
  EXPECT_EQ(first_root<double>({5e-16, -1.0}, 1, 1.0, 1e-15), 0.0) << "noise at the start counts as zero";
}

TEST(Pitfall03_RestartOnABoundary, IsNoEvent) {
  // The polynomial s (1/2 - s) rises from zero and returns to zero at 1/2.
  EXPECT_EQ(first_root<double>({0.0, 0.5, -1.0}, 2, 1.0, 1e-15), 0.5);
  // A leg that starts to conduct with i = di/dt = 0, as s^2 (1/4 - s).
  EXPECT_EQ(first_root<double>({0.0, 0.0, 0.25, -1.0}, 3, 1.0, 1e-15), 0.25);
  // A start from rest on a sector edge, with theta ~ t^3. The lower coefficients contain rounding noise.
  EXPECT_EQ(first_root<double>({-3e-16, 2e-16, -1e-16, 1.0}, 3, 1.0, 1e-15), no_root<double>);
  const auto root = first_root<double>({-3e-16, 2e-16, -1e-16, 0.5, -1.0}, 4, 1.0, 1e-15);
  EXPECT_NEAR(root, 0.5, 2 * eps);
}

TEST(FirstRoot, RestOnZeroIsNoEvent) {
  EXPECT_EQ(first_root<double>({0.0, 0.0, 0.0}, 2, 1.0, 1e-15), no_root<double>);
  EXPECT_EQ(first_root<double>({9e-16, -9e-16, 9e-16}, 2, 1.0, 1e-15), no_root<double>);
}

TEST(FirstRoot, RootsOutsideTheSegmentAreIgnored) {
  EXPECT_EQ(first_root<double>({0.2, 1.0}, 1, 1.0, 1e-15), no_root<double>) << "root at -0.2";
  EXPECT_EQ(first_root<double>({0.02, 0.3, 1.0}, 2, 1.0, 1e-15), no_root<double>) << "roots at -0.1 and -0.2";
  EXPECT_EQ(first_root<double>({1.5, -1.0}, 1, 1.0, 1e-15), no_root<double>) << "root at 1.5";
  EXPECT_EQ(first_root<double>({0.5, -1.0}, 1, 0.4, 1e-15), no_root<double>)
      << "root behind the length asked";
  EXPECT_EQ(first_root<double>({0.5, -1.0}, 1, 0.6, 1e-15), 0.5);
}

TEST(FirstRoot, RootAtTheEndCounts) {
  EXPECT_EQ(first_root<double>({1.0, -1.0}, 1, 1.0, 1e-15), 1.0);
  // For (1 - s)(s^2 - s + 1/2), Newton's method without bracketing does not converge safely.
  const auto curved = first_root<double>({0.5, -1.5, 2.0, -1.0}, 3, 1.0, 1e-15);
  EXPECT_GE(curved, 1.0 - 16 * eps);  // within the segment the polynomial is not negative
}

TEST(FirstRoot, ATouchIsFoundOrPassedButNeverElsewhere) {
  // The polynomial (s - 1/2)^2 is not negative anywhere, except by rounding.
  const auto touch = first_root<double>({0.25, -1.0, 1.0}, 2, 1.0, 1e-15);
  if (touch != no_root<double>) {
    EXPECT_NEAR(touch, 0.5, std::sqrt(4 * eps));
  }
}

TEST(FirstRoot, SignChangeOfALongDoubleToo) {
  const auto root = first_root<long double>({1.0L, -3.0L, 2.0L}, 2, 1.0L, 1e-18L);
  EXPECT_NEAR(static_cast<double>(root - 0.5L), 0.0, 1e-18);
}

TEST(Leading, NamesTheFirstRealCoefficient) {
  EXPECT_EQ(leading<double>({1e-16, -2.0, 1.0}, 2, 1e-15).order, 1);
  EXPECT_EQ(leading<double>({1e-16, -2.0, 1.0}, 2, 1e-15).sign, -1);
  EXPECT_EQ(leading<double>({1e-16, 0.0, 0.0}, 2, 1e-15).order, 3);
  EXPECT_EQ(leading<double>({1e-16, 0.0, 0.0}, 2, 1e-15).sign, 0);
}

}  // namespace SIXSTEP_TEST_FILE

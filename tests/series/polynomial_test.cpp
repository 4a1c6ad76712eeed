// SPDX-License-Identifier: Apache-2.0
#include "sixstep/series/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/series/extremes.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::series;
using Poly = Coefficients<double>;

constexpr double eps = 0x1p-52;
constexpr std::uint32_t seed = 7;

Poly random_poly(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> any(-1, 1);
  Poly c{};
  for (int j = 0; j <= degree; ++j) c[j] = any(random);
  return c;
}

TEST(Polynomial, ValueIncrementAndProduct) {
  const Poly c{1.0, -2.0, 3.0}, d{2.0, 0.5, -1.0};
  EXPECT_EQ(evaluate(c, 2, 0.5), 0.75);
  EXPECT_EQ(increment(c, 2, 0.5), -0.25);
  EXPECT_EQ(product_term(c, d, 0), 2.0);
  EXPECT_EQ(product_term(c, d, 1), 0.5 - 4.0);
  EXPECT_EQ(product_term(c, d, 2), -1.0 - 1.0 + 6.0);
}

TEST(Polynomial, IntegralsAreExact) {
  const Poly c{1.0, -2.0, 3.0}, d{2.0, 0.5, -1.0};
  EXPECT_EQ(integral(c, 2, 1.0), 1.0 - 1.0 + 1.0);
  EXPECT_EQ(integral(c, 2, 0.5), 0.5 - 0.25 + 0.125);
  // The product (1 - 2s + 3s^2)(2 + s/2 - s^2) is 2 - 3.5 s + 4 s^2 + 3.5 s^3 - 3 s^4.
  EXPECT_NEAR(product_integral(c, d, 2, 1.0), 2 - 3.5 / 2 + 4.0 / 3 + 3.5 / 4 - 3.0 / 5, 8 * eps * 8);
}

TEST(Polynomial, ProductIntegralAgreesWithItsOwnPrimitive) {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 1000; ++n) {
    const int degree = static_cast<int>(random() % 9);  // the product's degree does not exceed the highest
                                                        // degree
    const Poly a = random_poly(random, degree), b = random_poly(random, degree);
    Poly ab{};
    for (int j = 0; j <= 2 * degree; ++j)
      for (int k = std::max(0, j - degree); k <= std::min(j, degree); ++k) ab[j] += a[k] * b[j - k];
    EXPECT_NEAR(product_integral(a, b, degree, 0.7), integral(ab, 2 * degree, 0.7), 64 * eps * 9)
        << "seed " << seed << " pair " << n;
  }
}

TEST(Polynomial, RestrictedIsTheSameCurve) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 2000; ++n) {
    const int degree = static_cast<int>(random() % (max_degree + 1));
    const Poly c = random_poly(random, degree);
    double from = unit(random), to = unit(random);
    if (from > to) std::swap(from, to);
    if (n % 5 == 0) from = 0;
    const Poly r = restricted(c, degree, from, to);
    for (const double s : {0.0, 0.25, 0.5, 1.0}) {
      // Bound on the terms of the Taylor shift. The sum of |c_j| (from + (to - from) s)^j, expanded
      // binomially, is at most the sum of |c_j| to^j.
      const double scale = magnitude_of(c, degree);
      EXPECT_NEAR(evaluate(r, degree, s), evaluate(c, degree, from + (to - from) * s),
                  4 * (degree + 1) * eps * scale)
          << "seed " << seed << " polynomial " << n;
    }
  }
}

TEST(Polynomial, WholeSegmentIsRestrictedToItself) {
  const Poly c{1.0, -2.0, 3.0, 0.1};
  EXPECT_EQ(restricted(c, 3, 0.0, 1.0), c);
}

TEST(Pitfall11_CompensatedSums, LoseNothingInAMillionSteps) {
  double y = 1000.0, low = 0.0, plain = 1000.0;
  const double step = 1.0 / 3.0 * 1e-9;
  for (int n = 0; n < 1000000; ++n) {
    add_compensated(y, low, step);
    plain += step;
  }
  const double exact = 1000.0 + 1e6 * step;
  EXPECT_NEAR(y, exact, 2 * eps * 1000.0);
  EXPECT_GT(std::fabs(plain - exact), 100 * eps * 1000.0) << "the plain sum is no worse: test says nothing";
}

/// The Chebyshev polynomial T_n, shifted to [0, 1]. Its n roots and n + 1 extremes are known.
Poly chebyshev(int n) {
  Poly before{1.0}, now{-1.0, 2.0};
  for (int k = 1; k < n; ++k) {
    Poly next{};
    for (int j = 0; j <= k; ++j) {
      next[j] -= 2 * now[j];
      next[j + 1] += 4 * now[j];
    }
    for (int j = 0; j < k; ++j) next[j] -= before[j];
    before = now;
    now = next;
  }
  return now;
}

TEST(SignChanges, AllRootsOfAChebyshevPolynomialInOrder) {
  constexpr double pi = 3.14159265358979323846;
  for (const int degree : {1, 3, 6, 9}) {
    const Poly c = chebyshev(degree);
    std::vector<double> roots;
    for_each_sign_change(c, degree, magnitude_of(c, degree), [&](double s) { roots.push_back(s); });
    ASSERT_EQ(roots.size(), static_cast<std::size_t>(degree));
    for (int k = 0; k < degree; ++k) {
      const double x = std::cos(pi * (degree - k - 0.5) / degree), s = (x + 1) / 2;
      const double slope = 2 * degree / std::sqrt(1 - x * x);  // |dT_n/ds| at the roots
      EXPECT_NEAR(roots[k], s, 8 * (degree + 1) * eps * magnitude_of(c, degree) / slope) << degree;
    }
  }
}

TEST(SignChanges, ATouchIsNoneAndANegativeStartIsSearchedToo) {
  int count = 0;
  for_each_sign_change<double>({-0.5, 1.0}, 1, 1.0, [&](double s) {
    ++count;
    EXPECT_EQ(s, 0.5);
  });
  EXPECT_EQ(count, 1);
  for_each_sign_change<double>({0.26, -1.0, 1.0}, 2, 2.0, [&](double) { ++count; });
  EXPECT_EQ(count, 1);
  for_each_sign_change<double>({0.0, 0.0}, 1, 1.0, [&](double) { ++count; });
  EXPECT_EQ(count, 1);
}

TEST(Extremes, OfAChebyshevPolynomialAreOne) {
  for (const int degree : {2, 5, 8}) {
    const Poly c = chebyshev(degree);
    const Extremes<double> e = extremes(c, degree);
    EXPECT_NEAR(e.high, 1.0, 4 * (degree + 1) * eps * magnitude_of(c, degree));
    EXPECT_NEAR(e.low, -1.0, 4 * (degree + 1) * eps * magnitude_of(c, degree));
  }
}

TEST(Extremes, OfAMonotoneCurveAreItsEnds) {
  const Extremes<double> e = extremes<double>({2.0, -1.0, -1.0}, 2);
  EXPECT_EQ(e.low, 0.0);
  EXPECT_EQ(e.high, 2.0);
  const Extremes<double> flat = extremes<double>({2.0}, 0);
  EXPECT_EQ(flat.low, 2.0);
  EXPECT_EQ(flat.high, 2.0);
}

TEST(Extremes, NoSampleOfTheCurveLiesOutside) {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 3000; ++n) {
    const int degree = 1 + static_cast<int>(random() % max_degree);
    const Poly c = random_poly(random, degree);
    const Extremes<double> e = extremes(c, degree);
    const double error = 8 * (degree + 1) * eps * magnitude_of(c, degree);
    double low = 1e300, high = -1e300;
    for (int k = 0; k <= 500; ++k) {
      const double v = evaluate(c, degree, k / 500.0);
      low = std::min(low, v);
      high = std::max(high, v);
    }
    EXPECT_GE(low, e.low - error) << "seed " << seed << " polynomial " << n;
    EXPECT_LE(high, e.high + error);
    // A grid of 1/500 misses an extreme by at most |y''|/8/500^2, and this is at most 16*15*sum/8/250000.
    EXPECT_NEAR(low, e.low, 240.0 / 8 / 250000 * magnitude_of(c, degree) * 4);
  }
}

}  // namespace SIXSTEP_TEST_FILE

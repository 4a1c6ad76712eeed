// SPDX-License-Identifier: Apache-2.0
#include "sixstep/series/quadrature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::series;
using Poly = Coefficients<double>;

constexpr double eps = 0x1p-52;
constexpr std::uint32_t seed = 11;

/// Integral of s^power over [0, 1] by the Gauss rule.
template <int points>
long double power_integral(int power) {
  long double sum = 0;
  for (int k = 0; k < points; ++k)
    sum += gauss<points>.weight[k] * std::pow(gauss<points>.node[k], static_cast<long double>(power));
  return sum;
}

/// The rule's error for s^(2 points): (points!)^4/((2 points + 1) ((2 points)!)^2).
long double first_error(int points) {
  long double root = 1;  // (points!)^2 / (2 points)!
  for (int k = 1; k <= points; ++k) root *= static_cast<long double>(k) / (points + k);
  return root * root / (2 * points + 1);
}

template <int points>
void expect_gauss() {
  // Literals of 21 digits have errors of at most 5e-22. The relative error of a node's power s^j is j times
  // this error. A sum in long double has 8 terms.
  const long double tolerance = 64 * 0x1p-63L;
  for (int j = 0; j < 2 * points; ++j)
    EXPECT_NEAR(static_cast<double>(power_integral<points>(j) * (j + 1) - 1), 0.0,
                static_cast<double>(tolerance * (j + 1)))
        << points << " points, s^" << j;
  const int beyond = 2 * points;
  const long double missed = 1.0L / (beyond + 1) - power_integral<points>(beyond);
  EXPECT_NEAR(static_cast<double>(missed / first_error(points)), 1.0,
              static_cast<double>(tolerance / first_error(points)))
      << "no more is promised: " << points;
  EXPECT_LT(first_error(points), 1.5708L * std::pow(4.0L, -beyond)) << "points_for() counts on it";
}

TEST(Gauss, IsExactUpToItsDegreeAndMissesTheNextByWhatTheoryKnows) {
  expect_gauss<3>();
  expect_gauss<4>();
  expect_gauss<5>();
  expect_gauss<6>();
  expect_gauss<7>();
  expect_gauss<8>();
}

TEST(Gauss, LiteralsAreTheDoublesNearestToThem) {
  // The conversion of a literal to double must not depend on whether long double has 64 or 113 bits. The
  // values are therefore not near a tie.
  const auto far_from_tie = [](long double v) {
    const double d = static_cast<double>(v);
    const long double ulp = std::nextafter(d, 2.0) - d;
    return std::fabs(std::fabs((v - d) / ulp) - 0.5L) > 0x1p-9L;
  };
  for (const int degree : {6, 8, 10, 12, 14, 16})
    with_points_for(degree, [&]<int points>() {
      EXPECT_EQ(points, degree / 2);
      for (const long double v : gauss<points>.node) EXPECT_TRUE(far_from_tie(v)) << static_cast<double>(v);
      for (const long double v : gauss<points>.weight) EXPECT_TRUE(far_from_tie(v)) << static_cast<double>(v);
    });
}

/// The Taylor series of a solution, as the solver has it: c_j = a_j x^j/j! with |a_j| <= 1. The last term is
/// at the level of rounding.
Poly solution_series(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> any(-1, 1);
  double rate = 0x1p-53;
  for (int j = 1; j <= degree; ++j) rate *= j;
  rate = std::pow(rate, 1.0 / degree);
  Poly c{};
  double term = 1;
  for (int j = 0; j <= degree; ++j, term *= rate / j) c[j] = any(random) * term;
  return c;
}

TEST(Gauss, AFewPointsAreEnoughForProductsOfSolutions) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 20000; ++n) {
    const int degree = 7 + static_cast<int>(random() % 10);
    const Poly a = solution_series(random, degree), b = solution_series(random, degree);
    const double to = n % 2 == 0 ? 1.0 : unit(random);
    const double sum = with_points_for(degree, [&]<int points>() {
      const auto s = nodes_up_to<points>(to);
      return to * weighted_sum<points>(values_at<points>(a, degree, s), values_at<points>(b, degree, s));
    });
    // Each value has an error of at most 4 eps, because the terms fall quickly. Products and sums add as much
    // again. The scale is 1.
    EXPECT_NEAR(sum, product_integral(a, b, degree, to), 16 * eps) << "seed " << seed << " pair " << n;
  }
}

/// Value of a series, computed as in the solver. If the degree needs this number of points, even and odd
/// powers are evaluated separately. For an odd degree, the highest even power is zero.
template <int points, class Real>
Real fitting_value(const Coefficients<Real>& c, int degree, Real x) {
  constexpr int most = 2 * points;
  if (degree < most - 1) {
    Real value = c[degree];
    for (int j = degree - 1; j >= 0; --j) value = value * x + c[j];
    return value;
  }
  Real even = degree == most ? c[most] : Real(0), odd = c[most - 1];
  for (int j = most - 2; j >= 0; j -= 2) even = even * (x * x) + c[j];
  for (int j = most - 3; j >= 1; j -= 2) odd = odd * (x * x) + c[j];
  return even + odd * x;
}

/// SIMD instructions compute two numbers at once. Each number must have the bits of a separate computation.
/// With an odd number of points, no sum may include the unused lane.
template <int points, class Real>
void expect_bits_of_single_numbers(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  Coefficients<Real> a{}, b{};
  for (int j = 0; j <= max_degree; ++j)
    a[j] = static_cast<Real>(any(random)), b[j] = static_cast<Real>(any(random));
  const int degree = static_cast<int>(random() % (max_degree + 1));
  const auto to = static_cast<Real>(any(random));
  const auto s = nodes_up_to<points>(to);
  const auto v = values_at<points>(a, degree, s), u = values_at<points>(b, degree, s), both = u - to * v;
  Real sum = 0, products = 0;
  for (int k = 0; k < points; ++k) {
    const Real at = to * static_cast<Real>(gauss<points>.node[k]),
               weight = static_cast<Real>(gauss<points>.weight[k]);
    Real value = a[degree], other = b[degree];
    for (int j = degree - 1; j >= 0; --j) value = value * at + a[j], other = other * at + b[j];
    EXPECT_EQ(s[k], at);
    EXPECT_EQ(v[k], value) << points << " points, node " << k;
    EXPECT_EQ(both[k], other - to * value);
    sum = k == 0 ? weight * value : sum + weight * value;
    products = k == 0 ? weight * (value * other) : products + weight * (value * other);
  }
  EXPECT_EQ(weighted_sum<points>(v), sum) << points;
  EXPECT_EQ(weighted_sum<points>(v, u), products) << points;
  // The weights sum to one, and the magnitudes of the values sum to at most 17. The other order of summation
  // causes a few rounding errors.
  const auto w_v = weighted<points>(v);
  const auto w_vu = w_v * u;
  const Real rounding = 17 * 17 * points * std::numeric_limits<Real>::epsilon();
  EXPECT_LE(std::fabs(total(w_v) - sum), rounding) << points;
  EXPECT_LE(std::fabs(total(w_vu) - products), rounding) << points;
  // Each total is equal to a separately computed total.
  const auto two = totals(w_vu, w_v);
  EXPECT_EQ(two[0], total(w_vu)) << points;
  EXPECT_EQ(two[1], total(w_v)) << points;
  const auto four = totals(w_v, w_vu, w_v - w_vu, w_vu * u);
  EXPECT_EQ(four.of[0], total(w_v)) << points;
  EXPECT_EQ(four.of[1], total(w_vu)) << points;
  EXPECT_EQ(four.of[2], total(w_v - w_vu)) << points;
  EXPECT_EQ(four.of[3], total(w_vu * u)) << points;
  const int fitting = std::min(degree, 2 * points);
  const auto fits = values_of_fitting<points>(b, fitting, s);
  for (int k = 0; k < points; ++k)
    EXPECT_EQ(fits[k], fitting_value<points>(b, fitting, s[k])) << points << " points, degree " << fitting;
}

template <class Real>
void expect_bits_of_single_numbers() {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 200; ++n) [&]<int... more>(std::integer_sequence<int, more...>) {
      (expect_bits_of_single_numbers<3 + more, Real>(random), ...);
    }
  (std::make_integer_sequence<int, 6>{});
}
TEST(Nodes, HaveTheBitsOfSingleNumbers) { expect_bits_of_single_numbers<double>(); }
TEST(Nodes, HaveTheBitsOfSingleNumbersInFloat) { expect_bits_of_single_numbers<float>(); }
TEST(Nodes, HaveTheBitsOfSingleNumbersInLongDouble) { expect_bits_of_single_numbers<long double>(); }

TEST(Gauss, OnePointFewerWouldNotDo) {
  // All terms of this series have one sign, as in cosh. At degree 8, four points integrate it to rounding,
  // and three points do not.
  Poly c{};
  double rate = std::pow(0x1p-53 * 40320, 1.0 / 8), term = 1;
  for (int j = 0; j <= 8; ++j, term *= rate / j) c[j] = term;
  const auto error = [&]<int points>() {
    const auto v = values_at<points>(c, 8, nodes_up_to<points>(1.0));
    return std::fabs(weighted_sum<points>(v, v) - product_integral(c, c, 8, 1.0));
  };
  EXPECT_LT(error.operator()<4>(), 16 * eps);
  EXPECT_GT(error.operator()<3>(), 64 * eps);
}

TEST(WholeIntegral, AgreesWithTheDivisions) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const int degree = static_cast<int>(random() % (max_degree + 1));
    Poly c{};
    for (int j = 0; j <= degree; ++j) c[j] = any(random);
    // Each method has two roundings per term and one per sum. The sum is at most 1 + 1/2 + .. + 1/17 < 3.5.
    EXPECT_NEAR(whole_integral(c, degree), integral(c, degree, 1.0), (degree + 3) * 3.5 * eps)
        << "seed " << seed << " polynomial " << n;
  }
  EXPECT_EQ(whole_integral<double>({1.0, -2.0, 3.0}, 2), 1.0);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/resolver_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/random.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;

// The smallest c^2 + s^2 over the whole turn is twice the lower limit. The largest c^2 + s^2 is four fifths
// of the upper limit. (c, s: cosine and sine signal.)
TEST(ResolverWatch, LimitsAreThoseOfTheWholeTurn) {
  for (const design::ResolverShows& x : {design::ResolverShows{},
                                         {.k_1 = 0.9, .k_2 = 1.3, .quadrature_rad = 0.0},
                                         {.k_1 = 1, .k_2 = 0.6, .quadrature_rad = 0.5},
                                         {.k_1 = 0.5, .k_2 = 1.5, .quadrature_rad = -0.7}}) {
    const design::ResolverLimits limits = design::resolver_limits(x);
    double least = 1e9, greatest = 0;
    constexpr int steps = 100000;
    for (int n = 0; n < steps; ++n) {
      const double phi = 2 * 3.14159265358979323846 * n / steps;
      const double c = x.k_1 * std::cos(phi), s = x.k_2 * std::sin(phi + x.quadrature_rad);
      least = std::fmin(least, c * c + s * s);
      greatest = std::fmax(greatest, c * c + s * s);
    }
    EXPECT_NEAR(limits.least_square, least / 2, 1e-8);
    EXPECT_NEAR(limits.greatest_square, greatest * 5 / 4, 1e-8);
    EXPECT_EQ(limits.in_a_row, 1) << "nothing but a fault leaves them";
  }
}

// For equal windings, the upper limit is the closer one, at a distance of sqrt(5)/2 - 1. Independent results
// exceed it with a probability below exp(-z^2/2)/2, where z is the distance in standard deviations.
TEST(ResolverWatch, SoManyInARowAsNoiseDoesNotBring) {
  const double room = std::sqrt(5.0) / 2 - 1;
  int before = 1;
  for (const double z : {8.0, 5.0, 3.0, 2.0, 1.0}) {
    const design::ResolverLimits limits = design::resolver_limits({.noise = room / z});
    const double rare = std::exp(-z * z / 2) / 2, fresh = (limits.in_a_row + 1) / 2;
    EXPECT_LE(std::pow(rare, fresh), 1e-12);
    EXPECT_GT(std::pow(rare, fresh - 1), 1e-12) << "and not more of them";
    EXPECT_GE(limits.in_a_row, before);
    before = limits.in_a_row;
    int beyond = 0;
    constexpr int results = 200000;
    for (std::uint64_t n = 0; n < results; ++n) {
      const double c = 1 + room / z * base::normal({1, 2, n}), s = room / z * base::normal({1, 3, n});
      beyond += c * c + s * s > limits.greatest_square;
    }
    // The noise perpendicular to the radius adds twice its square to the squared amplitude. The amplitude
    // increases by half of this part.
    if (z >= 3) {
      EXPECT_LE(beyond, results * rare + 5 * std::sqrt(results * rare) + 5);
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE

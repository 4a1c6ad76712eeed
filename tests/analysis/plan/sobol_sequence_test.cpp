// SPDX-License-Identifier: Apache-2.0
// Sobol's sequence is checked against its defining property and against published points.
#include "sixstep/analysis/plan/sobol_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;

/// The values are the first ten points in three dimensions that sobol.cc by Joe and Kuo prints.
TEST(SobolSequence, BeginsAsPublished) {
  const double points[10][3] = {{0, 0, 0},
                                {0.5, 0.5, 0.5},
                                {0.75, 0.25, 0.25},
                                {0.25, 0.75, 0.75},
                                {0.375, 0.375, 0.625},
                                {0.875, 0.875, 0.125},
                                {0.625, 0.125, 0.875},
                                {0.125, 0.625, 0.375},
                                {0.1875, 0.3125, 0.9375},
                                {0.6875, 0.8125, 0.4375}};
  for (std::uint32_t n = 0; n < 10; ++n)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(analysis::sobol_bits(d, n) * 0x1p-32, points[n][d]) << n << " " << d;
}

/// Each block of 2^m points that begins at a multiple of 2^m has exactly one point in each of 2^m equal
/// parts, in every dimension.
TEST(SobolSequence, EveryDimensionIsEven) {
  for (std::size_t d = 0; d < analysis::sobol_dimensions; ++d)
    for (const std::uint32_t from : {0u, 1024u, 1024u * 77u}) {
      std::set<std::uint32_t> parts;
      for (std::uint32_t n = 0; n < 1024; ++n) parts.insert(analysis::sobol_bits(d, from + n) >> 22);
      EXPECT_EQ(parts.size(), 1024u) << d;
    }
}

/// The first two dimensions have one point in every elementary rectangle of 2^-a by 2^-(m-a).
TEST(SobolSequence, TheFirstTwoDimensionsAreANet) {
  for (int a = 0; a <= 8; ++a) {
    std::set<std::uint32_t> parts;
    for (std::uint32_t n = 0; n < 256; ++n) {
      const std::uint64_t x = analysis::sobol_bits(0, n), y = analysis::sobol_bits(1, n);
      parts.insert(static_cast<std::uint32_t>((x >> (32 - a)) << (8 - a) | y >> (32 - (8 - a))));
    }
    EXPECT_EQ(parts.size(), 256u) << a;
  }
}

/// Shifted points are still evenly spread. They differ between seeds, and are never 0 or 1.
TEST(SobolSequence, ShiftedPointsAreAsEven) {
  for (const std::uint64_t seed : {1u, 2u, 99u})
    for (std::size_t d = 0; d < 8; ++d) {
      std::set<int> parts;
      for (std::uint32_t n = 0; n < 512; ++n) {
        const double u = analysis::sobol(d, n, seed);
        ASSERT_TRUE(u > 0.0 && u < 1.0);
        parts.insert(static_cast<int>(u * 512));
      }
      EXPECT_EQ(parts.size(), 512u);
    }
  EXPECT_NE(analysis::sobol(0, 5, 1), analysis::sobol(0, 5, 2));
}

/// The integral of the product of (1 + (x - 1/2)) over six dimensions is 1. With 4096 points, the error is
/// below the error of as many random points.
TEST(SobolSequence, IntegratesBetterThanChance) {
  double sum = 0.0;
  const int count = 4096;
  for (std::uint32_t n = 0; n < count; ++n) {
    double f = 1.0;
    for (std::size_t d = 0; d < 6; ++d) f *= 1.0 + (analysis::sobol(d, n, 7) - 0.5);
    sum += f;
  }
  const double deviation = std::sqrt((std::pow(13.0 / 12.0, 6) - 1.0) / count);
  EXPECT_LT(std::fabs(sum / count - 1.0), deviation / 10);
}

}  // namespace SIXSTEP_TEST_FILE

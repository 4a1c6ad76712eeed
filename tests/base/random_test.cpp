// SPDX-License-Identifier: Apache-2.0
// Compares with known results of the generator's authors. Moments must be within bounds that follow from the
// number of samples.
#include "sixstep/base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <vector>

namespace sixstep::base {
namespace SIXSTEP_TEST_FILE {

// Known answers of Random123 (kat_vectors) for philox4x32 with 10 rounds: counter, key, result.
static_assert(philox({0, 0, 0, 0}, {0, 0}) ==
              PhiloxBlock{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u});
static_assert(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}) ==
              PhiloxBlock{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu});
static_assert(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}) ==
              PhiloxBlock{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u});

// Both ends of the open interval, and the symmetry of the interval.
static_assert(open_unit(0) == 0x1p-53 && open_unit(~std::uint64_t{0}) == 1.0 - 0x1p-53);
static_assert(open_unit(0) + open_unit(~std::uint64_t{0}) == 1.0);

constexpr std::uint64_t seed = 20260101;
constexpr int count = 100000;

std::vector<double> draws(double (*draw)(const RandomPlace&), std::uint64_t stream) {
  std::vector<double> x;
  for (std::uint64_t n = 0; n < count; ++n) x.push_back(draw({seed, stream, n}));
  return x;
}
double draw_uniform(const RandomPlace& at) { return uniform(at); }

double mean_of_power(const std::vector<double>& x, double centre, int power) {
  double sum = 0.0;
  for (const double v : x) sum += std::pow(v - centre, power);
  return sum / static_cast<double>(x.size());
}

/// The mean of n draws has the standard deviation sqrt(variance/n). Its error exceeds five standard
/// deviations in one of 1.7 million means.
double five_sigma(double variance) { return 5.0 * std::sqrt(variance / count); }

TEST(Random, UniformHasItsMoments) {
  for (const std::uint64_t stream : {0u, 1u, 77u}) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", stream " + std::to_string(stream));
    const std::vector<double> x = draws(draw_uniform, stream);
    // Variances of the three powers:
    // - x: 1/12
    // - (x - 1/2)^2: 1/80 - 1/144 = 1/180
    // - (x - 1/2)^4: 1/2304 - 1/6400
    EXPECT_NEAR(mean_of_power(x, 0.0, 1), 0.5, five_sigma(1.0 / 12));
    EXPECT_NEAR(mean_of_power(x, 0.5, 2), 1.0 / 12, five_sigma(1.0 / 180));
    EXPECT_NEAR(mean_of_power(x, 0.5, 4), 1.0 / 80, five_sigma(1.0 / 2304 - 1.0 / 6400));
  }
}

TEST(Random, NormalHasItsMoments) {
  for (const std::uint64_t stream : {0u, 1u, 77u}) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", stream " + std::to_string(stream));
    const std::vector<double> x = draws(normal, stream);
    // The moments are E x^2k = (2k - 1)!!, so Var(x) = 1, Var(x^2) = 3 - 1, Var(x^3) = 15, and Var(x^4) = 105
    // - 9.
    EXPECT_NEAR(mean_of_power(x, 0.0, 1), 0.0, five_sigma(1.0));
    EXPECT_NEAR(mean_of_power(x, 0.0, 2), 1.0, five_sigma(2.0));
    EXPECT_NEAR(mean_of_power(x, 0.0, 3), 0.0, five_sigma(15.0));
    EXPECT_NEAR(mean_of_power(x, 0.0, 4), 3.0, five_sigma(96.0));
  }
}

/// The Kolmogorov-Smirnov distance D of n samples: sqrt(n) D exceeds 2.8 with the probability 2 exp(-2 2.8^2)
/// = 3e-7.
double deviation(std::vector<double> x, double (*distribution)(double)) {
  std::sort(x.begin(), x.end());
  double worst = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double below = static_cast<double>(n) / count, f = distribution(x[n]);
    worst = std::max({worst, f - below, below + 1.0 / count - f});
  }
  return worst * std::sqrt(static_cast<double>(count));
}

TEST(Random, BothFollowTheirDistribution) {
  EXPECT_LT(deviation(draws(draw_uniform, 5), [](double x) { return x; }), 2.8) << "seed " << seed;
  EXPECT_LT(deviation(draws(normal, 5), [](double x) { return std::erfc(-x / std::sqrt(2.0)) / 2; }), 2.8)
      << "seed " << seed;
}

/// Numbers of neighbouring seeds, streams and counters are independent. The product of two independent
/// centred uniform numbers has the variance 1/144.
TEST(Random, NeighboursAreNotCorrelated) {
  double by_seed = 0.0, by_stream = 0.0, by_counter = 0.0;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double x = uniform({seed, 0, n}) - 0.5;
    by_seed += x * (uniform({seed + 1, 0, n}) - 0.5);
    by_stream += x * (uniform({seed, 1, n}) - 0.5);
    by_counter += x * (uniform({seed, 0, n + 1}) - 0.5);
  }
  for (const double sum : {by_seed, by_stream, by_counter})
    EXPECT_NEAR(sum / count, 0.0, five_sigma(1.0 / 144)) << "seed " << seed;
}

TEST(Random, NothingButThePlaceDecides) {
  std::vector<double> forward, backward;
  for (std::uint64_t n = 0; n < 1000; ++n) forward.push_back(normal({seed, 3, n}));
  for (std::uint64_t n = 1000; n-- > 0;) {
    static_cast<void>(uniform({seed, 4, n}));
    backward.push_back(normal({seed, 3, n}));
  }
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(forward, backward);
}

TEST(Random, EveryBitOfThePlaceCounts) {
  std::set<std::uint64_t> seen = {random_bits({})[0]};
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t one = std::uint64_t{1} << bit;
    for (const RandomPlace& at : {RandomPlace{one, 0, 0}, RandomPlace{0, one, 0}, RandomPlace{0, 0, one}})
      EXPECT_TRUE(seen.insert(random_bits(at)[0]).second) << bit;
  }
}

/// The bits are equal on every platform, because normal() uses only base/elementary.
TEST(Random, HasTheSameBitsEverywhere) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(uniform({1, 2, 3})), 0x3fd98fbfd3f7822eu);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(normal({1, 2, 3})), 0xbfb26ab5baedb393u);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::base

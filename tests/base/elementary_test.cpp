// SPDX-License-Identifier: Apache-2.0
// Tests the guarantees of base/elementary.hpp: errors below 1 ulp, exact results where required, special
// values, and the same bits on every platform.
#include "sixstep/base/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "sixstep/base/angle.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using Wide = long double;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double max = std::numeric_limits<double>::max();
constexpr double tiny = std::numeric_limits<double>::denorm_min();

// The reference needs about ten bits more than a double.
constexpr bool has_oracle = std::numeric_limits<Wide>::digits >= 64;

/// Error of `got` against `truth`, in units of the last place (ulp) of the nearest double.
double ulps(double got, Wide truth) {
  const double nearest = static_cast<double>(truth);
  if (std::isinf(nearest) || nearest == 0.0) return got == nearest ? 0.0 : inf;
  const int exponent = std::max(std::ilogb(nearest), -1022);
  return static_cast<double>(std::abs(static_cast<Wide>(got) - truth) / std::ldexp(Wide(1), exponent - 52));
}

// The bounds below are the measured errors, rounded up. base/elementary.hpp guarantees 1 ulp.
class Elementary : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_oracle) GTEST_SKIP() << "long double is no wider than double here";
    RecordProperty("seed", static_cast<int>(seed));
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  /// A random number with an exponent from `low` to `high` and any mantissa.
  double wide(double low, double high) {
    return std::ldexp(uniform(1.0, 2.0), static_cast<int>(std::floor(uniform(low, high))));
  }
  static constexpr std::uint32_t seed = 20240607;
  static constexpr int samples = 400000;
  std::mt19937_64 random{seed};
};

TEST_F(Elementary, ExpIsWithinOneUlpOverItsWholeRange) {
  double worst = 0.0;
  for (int n = 0; n < samples; ++n) {
    for (const double x : {uniform(-708.0, 709.7), uniform(-745.1, -708.0), uniform(-1.0, 1.0),
                           -745.0 + 1454.0 * n / samples, wide(-60, 0), -wide(-60, 0)})
      worst = std::max(worst, ulps(base::exp(x), std::exp(Wide(x))));
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.8) << "seed " << seed;
}

TEST_F(Elementary, LogIsWithinOneUlpOverItsWholeRange) {
  double worst = 0.0;
  for (int n = 0; n < samples; ++n) {
    for (const double x : {wide(-1074, 1023), uniform(0.5, 2.0), 1.0 + wide(-52, -3), 1.0 - wide(-53, -3),
                           0.5 + 1.5 * n / samples})
      worst = std::max(worst, ulps(base::log(x), std::log(Wide(x))));
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.6) << "seed " << seed;
}

TEST_F(Elementary, SineAndCosineAreWithinOneUlpAtAnyAngle) {
  double worst = 0.0;
  for (int n = 0; n < samples; ++n) {
    const double nearly = std::floor(uniform(0.0, 3e6)) * (base::pi / 2);  // next to a zero of sine or cosine
    for (const double x : {uniform(-1e5, 1e5), uniform(-7.0, 7.0), wide(-40, 20), 7.0 * n / samples, nearly,
                           -std::nextafter(nearly, inf), wide(20, 62)}) {
      const base::SinCos got = base::sin_cos(x);
      worst = std::max({worst, ulps(got.sin, std::sin(Wide(x))), ulps(got.cos, std::cos(Wide(x)))});
    }
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.85) << "seed " << seed;
}

TEST_F(Elementary, Atan2IsWithinOneUlpInEveryQuadrant) {
  double worst = 0.0;
  for (int n = 0; n < samples; ++n) {
    const double a = uniform(-1.0, 1.0), b = uniform(-1.0, 1.0), e = wide(-70, 70), f = wide(-1074, 1023);
    for (const auto& [y, x] :
         {std::pair{a, b}, {a, e}, {e, b}, {a, -e}, {f, a}, {a, f}, {f, -f * e}, {f * e, f}}) {
      if (std::isinf(x) || std::isinf(y) || (x == 0.0 && y == 0.0)) continue;
      worst = std::max(worst, ulps(base::atan2(y, x), std::atan2(Wide(y), Wide(x))));
    }
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.75) << "seed " << seed;
}

TEST_F(Elementary, PowIsWithinOneUlpOverItsWholeRange) {
  double worst = 0.0;
  for (int n = 0; n < samples; ++n) {
    const double x = wide(-1074, 1023), near = 1.0 + uniform(-1e-3, 1e-3);
    for (const auto& [b, y] : {std::pair{x, uniform(-1.1, 1.1)},
                               {uniform(0.1, 10.0), uniform(-300.0, 300.0)},
                               {near, uniform(-7e5, 7e5)},
                               {uniform(0.0, 20.0), std::floor(uniform(-9.0, 9.0))}})
      worst = std::max(worst, ulps(base::pow(b, y), std::pow(Wide(b), Wide(y))));
  }
  RecordProperty("worst_ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.8) << "seed " << seed;
}

// The values are known from the literature, so no library is needed for comparison.
TEST(ElementaryHardCases, SineOfTheDoubleNextToAMultipleOfHalfPi) {
  // The double nearest to a multiple of pi/2 is 6381956970095103 * 2^797: its cosine is -4.6871659242546277e-19 (J.-M. Muller, Elementary
  // Functions, 3rd ed., section 11.5).
  EXPECT_DOUBLE_EQ(base::cos(std::ldexp(6381956970095103.0, 797)), -4.6871659242546277e-19);
  EXPECT_DOUBLE_EQ(base::sin(std::ldexp(6381956970095103.0, 797)), 1.0);
  EXPECT_DOUBLE_EQ(base::sin(base::pi), 1.2246467991473532e-16);
  EXPECT_DOUBLE_EQ(base::sin(1e22), -0.8522008497671888);
}

TEST(ElementaryHardCases, ExactResultsAreExact) {
  EXPECT_EQ(base::exp(0.0), 1.0);
  EXPECT_EQ(base::log(1.0), 0.0);
  EXPECT_EQ(base::cos(0.0), 1.0);
  EXPECT_EQ(base::exp(1.0), 2.7182818284590452353602874713527);
  for (int n = 0; n <= 22; ++n) {  // powers of ten that a double represents exactly
    double expected = 1.0;
    for (int k = 0; k < n; ++k) expected *= 10.0;
    EXPECT_EQ(base::pow(10.0, n), expected);
  }
  for (int n = -1074; n <= 1023; ++n) EXPECT_EQ(base::pow(2.0, n), std::ldexp(1.0, n)) << n;
  for (double root = 1.0; root < 4000.0; root += 1.25) {
    EXPECT_EQ(base::pow(root * root, 0.5), root);
    EXPECT_EQ(base::pow(-root, 3.0), -root * root * root);
    EXPECT_EQ(base::pow(root * root, 1.5), root * root * root);
  }
  EXPECT_EQ(base::atan2(1.0, 1.0), base::pi / 4);
  EXPECT_EQ(base::atan2(1.0, -1.0), 2.356194490192344928846982537459627163147877);
  EXPECT_EQ(base::atan2(3.0, 0.0), base::pi / 2);
}

TEST(ElementaryHardCases, OverflowAndUnderflow) {
  EXPECT_EQ(base::exp(709.782712893384), 1.7976931348622732e308);
  EXPECT_EQ(base::exp(std::nextafter(709.782712893384, inf)), inf);
  EXPECT_EQ(base::exp(-745.1332191019411), tiny);
  EXPECT_EQ(base::exp(-745.1332191019412), 0.0);  // 0.49999999999999 of the smallest subnormal
  EXPECT_EQ(base::exp(inf), inf);
  EXPECT_EQ(base::exp(-inf), 0.0);
  EXPECT_EQ(base::exp(tiny), 1.0);
  EXPECT_EQ(base::log(tiny), -744.4400719213812);
  EXPECT_EQ(base::log(inf), inf);
  EXPECT_EQ(base::log(-0.0), -inf);
  EXPECT_EQ(base::pow(max, 2.0), inf);
  EXPECT_EQ(base::pow(-max, 3.0), -inf);
  EXPECT_EQ(base::pow(tiny, 2.0), 0.0);
  EXPECT_EQ(base::pow(0.5, 1e300), 0.0);
  EXPECT_EQ(base::pow(1.5, 1e308), inf);
  EXPECT_EQ(base::pow(3.0, tiny), 1.0);
  EXPECT_EQ(base::sin(tiny), tiny);
  EXPECT_EQ(base::atan2(tiny, max), 0.0);
  EXPECT_EQ(base::atan2(tiny, -tiny), 2.356194490192344928846982537459627163147877);
}

TEST(ElementaryHardCases, SpecialValuesAreThoseOfTheStandard) {
  for (const double got : {base::exp(nan), base::log(nan), base::log(-1.0), base::log(-inf), base::sin(inf),
                           base::cos(-inf), base::sin(nan), base::atan2(nan, 1.0), base::atan2(0.0, nan),
                           base::pow(nan, 1.0), base::pow(2.0, nan), base::pow(-8.0, 1.0 / 3.0)})
    EXPECT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(nan));
  const std::vector<double> values{0.0,  -0.0, 1.0,  -1.0, 0.5,   -0.5, 2.0,  -2.0, 3.0,
                                   -3.0, inf,  -inf, tiny, -tiny, max,  -max, 2.5,  9007199254740993.0};
  for (const double x : values) {
    // std::pow() and std::atan2() are the reference, because these results are exact or special values.
    for (const double y : values) {
      const double power = std::pow(x, y), got = base::pow(x, y), angle = base::atan2(y, x);
      if (std::isnan(power)) {
        EXPECT_TRUE(std::isnan(got)) << x << '^' << y;
      } else {
        EXPECT_DOUBLE_EQ(got, power) << x << '^' << y;
        EXPECT_EQ(std::signbit(got), std::signbit(power)) << x << '^' << y;
      }
      EXPECT_DOUBLE_EQ(angle, std::atan2(y, x)) << y << ' ' << x;
      EXPECT_EQ(std::signbit(angle), std::signbit(y)) << y << ' ' << x;
    }
  }
  EXPECT_EQ(base::pow(nan, 0.0), 1.0);
  EXPECT_EQ(base::pow(1.0, nan), 1.0);
  EXPECT_TRUE(std::signbit(base::sin(-0.0)));
}

TEST(ElementaryProperties, NeighboursNeverChangePlaces) {
  // If the error is well below 1 ulp, a monotone function is monotone even between neighbouring doubles.
  for (const double start : {-700.0, -2.0, -0.3466, -1e-9, 0.3465, 1.0395, 2.0, 500.0}) {
    double x = start, last = base::exp(x);
    for (int n = 0; n < 5000; ++n) {
      x = std::nextafter(x, inf);
      const double next = base::exp(x);
      ASSERT_LE(last, next) << x;
      last = next;
    }
  }
  for (const double start : {1e-310, 0.7071067811865, 1.0 - 1e-13, 1.41421356237, 77.0, 1e300}) {
    double x = start, last = base::log(x);
    for (int n = 0; n < 5000; ++n) {
      x = std::nextafter(x, inf);
      const double next = base::log(x);
      ASSERT_LE(last, next) << x;
      last = next;
    }
  }
}

TEST(ElementaryProperties, SymmetriesHoldToTheBit) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> angle(0.0, 1e6);
  for (int n = 0; n < 10000; ++n) {
    const double x = angle(random), y = angle(random);
    const base::SinCos there = base::sin_cos(x), back = base::sin_cos(-x);
    EXPECT_EQ(there.sin, -back.sin);
    EXPECT_EQ(there.cos, back.cos);
    EXPECT_NEAR(there.sin * there.sin + there.cos * there.cos, 1.0, 4e-16);
    EXPECT_EQ(base::atan2(y, x), -base::atan2(-y, x));
    EXPECT_EQ(base::atan2(y, x), base::atan2(0.25 * y, 0.25 * x));
  }
}

/// FNV-1a hash over the bits. The least significant byte comes first, so the byte order in memory has no
/// effect.
struct Digest {
  std::uint64_t value = 0xcbf29ce484222325u;
  void add(double x) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    for (int k = 0; k < 8; ++k) value = (value ^ ((bits >> (8 * k)) & 0xffu)) * 0x100000001b3u;
  }
};

TEST(ElementaryBits, AreTheSameOnEveryCompilerAndPlatform) {
  // The arguments are computed from a 64-bit linear congruential generator with exact arithmetic only. If a
  // platform fails in this test, its compiler contracts a b + c or computes with more than double precision.
  // Check the compiler flags; never change this number.
  std::uint64_t state = 1;
  const auto next = [&state] {  // in [1, 2)
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::bit_cast<double>((state >> 12) | 0x3ff0000000000000u);
  };
  Digest digest;
  for (int n = 0; n < 20000; ++n) {
    const double u = next(), v = next(), w = 1400.0 * u - 2100.0;
    digest.add(base::exp(w));
    digest.add(base::log(u * v));
    digest.add(base::log(std::bit_cast<double>(state >> 2)));
    digest.add(base::pow(u, w));
    digest.add(base::pow(1e-5 + (v - 1.0), 20.0 * u - 30.0));
    const base::SinCos small = base::sin_cos(1e5 * (u - 1.5)),
                       large = base::sin_cos(std::bit_cast<double>(state >> 2));
    for (const double x : {small.sin, small.cos, large.sin, large.cos}) digest.add(x);
    digest.add(base::atan2(u - 1.5, v - 1.5));
  }
  EXPECT_EQ(digest.value, 10020102203770733934u);
}

}  // namespace SIXSTEP_TEST_FILE

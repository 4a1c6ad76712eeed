// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/binary_angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sixstep/control/sensing/sine.hpp"
#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr std::uint64_t turn = std::uint64_t{1} << 32;

TEST(BinaryAngle, SectorsAreThoseOfTheDefinition) {
  const auto defined = [](BinaryAngle a) { return static_cast<int>(6 * std::uint64_t{a} / turn); };
  for (std::uint8_t n = 0; n < 6; ++n) {
    const BinaryAngle begin = sector_angle(n);
    EXPECT_EQ(begin, (n * turn + 5) / 6) << "rounded up";
    for (const BinaryAngle a : {begin, begin - 1, begin + 1}) EXPECT_EQ(sector_of_angle(a), defined(a)) << a;
  }
  Drawn drawn{1};
  for (int n = 0; n < 100000; ++n) {
    const BinaryAngle a = drawn.word();
    ASSERT_EQ(sector_of_angle(a), defined(a)) << a << " of seed " << drawn.seed;
  }
}

TEST(BinaryAngle, AWayIsTheShorterOneAndLeadsThere) {
  Drawn drawn{2};
  for (int n = 0; n < 100000; ++n) {
    const BinaryAngle from = drawn.word(), to = drawn.word();
    const std::int64_t way = way_between(from, to);
    ASSERT_EQ((std::int64_t{from} + way + std::int64_t(turn)) % std::int64_t(turn), to) << drawn.seed;
    ASSERT_TRUE(way >= -std::int64_t(turn / 2) && way < std::int64_t(turn / 2)) << drawn.seed;
  }
}

TEST(BinaryAngle, ConstantsOfDegreesAreTheNearestAndWrap) {
  for (const double degrees : {0.0, 60.0, 90.0, 359.999, 360.0, 400.25, -1.0, -90.0, -719.5, 1e6})
    EXPECT_LE(
        std::fabs(std::remainder(static_cast<double>(binary_degrees(degrees)) - degrees / 360 * turn, turn)),
        // half a unit of rounding, plus the rounding of the turns in double
        0.5 + std::fabs(degrees) / 360 * 0x1p-52 * turn)
        << degrees;
  static_assert(binary_degrees(90) == quarter_turn && binary_degrees(-180) == half_turn);
}

TEST(BinaryAngle, ElectricalAnglesWrapWithThePolePairs) {
  Drawn drawn{3};
  for (int n = 0; n < 10000; ++n) {
    const BinaryAngle m = drawn.word(), offset = drawn.word();
    const auto p = static_cast<std::uint8_t>(drawn.below(256));
    ASSERT_EQ(electrical_angle(m, p, offset), (std::uint64_t{m} * p + offset) % turn) << drawn.seed;
  }
}

TEST(BinaryAngle, PartsOfATurnAreRightToTwoUnits) {
  Drawn drawn{4};
  for (int n = 0; n < 100000; ++n) {
    const std::uint32_t whole = std::max(2u, drawn.word() >> drawn.below(31));
    const std::uint32_t part = drawn.below(whole);
    const double exact = static_cast<double>(part) / whole * static_cast<double>(turn);
    const BinaryAngle angle = angle_of_parts(turn_in_parts(whole), part);
    // in units: 2 from the reciprocal, 1/2 from rounding and 1e-6 from the double
    ASSERT_LE(std::fabs(std::remainder(angle - exact, static_cast<double>(turn))), 2.5 + 1e-6)
        << part << "/" << whole << " of seed " << drawn.seed;
    const std::uint8_t bits = static_cast<std::uint8_t>(1 + drawn.below(31));
    ASSERT_EQ(angle_of_parts(turn_in_parts(1u << bits), 1), turn >> bits) << "a power of two is exact";
  }
  for (std::uint32_t part = 0; part < 4096; ++part)
    ASSERT_EQ(angle_of_parts(turn_in_parts(4096), part), part << 20);
}

TEST(BinaryAngle, UnwrappingFollowsAWalkOverManyTurns) {
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    Drawn drawn{seed};
    UnwrappedAngle state;
    std::int64_t truth = 0;
    for (int n = 0; n < 20000; ++n) {
      truth += static_cast<std::int64_t>((drawn.unit() - (seed % 2 ? 0.3 : 0.7)) * 0.7 *
                                         turn);  // below half a turn
      unwrap(state, static_cast<BinaryAngle>(static_cast<std::uint64_t>(truth)));
      ASSERT_EQ(state.turns * static_cast<std::int64_t>(turn) + state.angle, truth) << "seed " << seed;
    }
    EXPECT_GT(std::abs(state.turns), 1000) << "it went somewhere";
  }
}

TEST(BinaryAngle, QuantisingRoundsDown) {
  for (std::uint8_t bits = 1; bits <= 32; ++bits) {
    const std::uint64_t step = turn >> bits;
    for (const BinaryAngle a : {0u, 1u, 0x12345678u, 0xffffffffu}) {
      const BinaryAngle q = quantised(a, bits);
      EXPECT_EQ(q % step, 0u);
      EXPECT_TRUE(q <= a && a - q < step) << int{bits};
    }
  }
}

template <class Scalar>
class BinaryAngleIn : public ::testing::Test {};
TYPED_TEST_SUITE(BinaryAngleIn, SensingScalars);

TYPED_TEST(BinaryAngleIn, HalfTurnsAndWholeNumbersAreRoundedOnce) {
  using S = TypeParam;
  Drawn drawn{5};
  for (int n = 0; n < 10000; ++n) {
    const auto angle = static_cast<std::int32_t>(drawn.word());
    // one digit: half a digit of rounding, and half a digit more if the range of the format ends below 1
    ASSERT_NEAR(static_cast<double>(AngleTraits<S>::half_turns(angle)), angle * 0x1p-31, digit<S>())
        << drawn.seed;
    const auto x = static_cast<std::int32_t>(drawn.word()) >> drawn.below(31);
    const double gain = 0.9 / (std::fabs(x) + 1.0) * drawn.unit();
    // numbers and gains have a relative rounding error of 2^-15 or 2^-31; small gains are multiples of 2^-30
    // or 2^-62
    const double storage = is_fixed<S> ? std::ldexp(1.0, sizeof(S) == 2 ? -15 : -31) : digit<S>();
    const double least = is_fixed<S> ? std::ldexp(digit<S>(), sizeof(S) == 2 ? -30 : -62) / 2 : 0.0;
    ASSERT_NEAR(
        static_cast<double>(AngleTraits<S>::scaled(x, per_count<S>(gain))), x * gain,
        digit<S>() / 2 * (is_fixed<S> ? 1.0 : 2.0) + 2 * storage * std::fabs(x * gain) + least * std::fabs(x))
        << x << " times " << gain << " of seed " << drawn.seed;
  }
}

TYPED_TEST(BinaryAngleIn, CountingIsMultiplyingAndSaturates) {
  using S = TypeParam;
  Drawn drawn{6};
  for (int n = 0; n < 10000; ++n) {
    const std::uint32_t count = drawn.word() >> drawn.below(31);
    const auto one_time = static_cast<TickRatio<S>>(drawn.unit() * 10);
    const TickRatio<S> all = AngleTraits<S>::counted(one_time, count);
    if constexpr (is_fixed<S>) {
      const std::int64_t raw = one_time.raw, most = detail::greatest<decltype(all.raw)>;
      const bool fits = count == 0 || raw <= most / count;
      ASSERT_EQ(all.raw, fits ? raw * count : most) << drawn.seed;
    } else {
      ASSERT_EQ(all, one_time * static_cast<S>(count)) << drawn.seed;
    }
  }
}

TYPED_TEST(BinaryAngleIn, SmallAnglesInRadBecomeUnits) {
  using S = TypeParam;
  for (double rad = -1; rad <= 1; rad += 0.0117) {
    const double units = static_cast<double>(static_cast<S>(rad)) * 4294967296.0 / (2 * std::numbers::pi);
    // 31 fractional bits are rounded towards 0, and the product is rounded to a unit
    EXPECT_NEAR(angle_of_rad(static_cast<S>(rad)), units, 1.5) << rad;
  }
  EXPECT_EQ(angle_of_rad(one<S>), -angle_of_rad(-one<S>)) << "both directions alike";
}

TYPED_TEST(BinaryAngleIn, SineAndCosineAreRightToTheStatedError) {
  using S = TypeParam;
  const double cubic = std::pow(std::numbers::pi / 256, 3) / 6;
  // In fixed point, the table, two products and the range adjustment are each rounded by half a digit. If the
  // range of the format ends below 1, up to one digit is added, and the rounding before a gain adds a
  // hundredth. In floating point, the table and two sums are each rounded by at most a quarter of a digit.
  const double digits = is_fixed<S> ? 2.1 + (static_cast<double>(one<S>) < 1 ? 0.6 : 0.0) : 1.0;
  const double bound = cubic + 1e-9 + digits * digit<S>();
  double worst = 0;
  for (std::uint64_t n = 0; n < turn; n += 9973) {
    const auto angle = static_cast<BinaryAngle>(n);
    const double rad = static_cast<double>(n) / static_cast<double>(turn) * 2 * std::numbers::pi;
    const Direction<S> d = direction_of<S>(angle);
    worst = std::max({worst, std::fabs(static_cast<double>(d.cos) - std::cos(rad)),
                      std::fabs(static_cast<double>(d.sin) - std::sin(rad))});
  }
  EXPECT_LE(worst, bound);
  EXPECT_GE(worst, bound / 2) << "the bound is no wider than the error";
  std::printf("largest error %.3g, bound %.3g\n", worst, bound);
}

TEST(Sine, TheTablesEntriesAreTheSinesTo2To30) {
  for (std::uint8_t n = 0; n <= 64; ++n)
    EXPECT_NEAR(detail::sine_entry(n), std::sin(n * std::numbers::pi / 128) * 0x1p30, 1.0) << int{n};
}

}  // namespace SIXSTEP_TEST_FILE

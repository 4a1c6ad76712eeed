// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/fixed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
__extension__ typedef __int128 I128;  // g++ and clang have it on every host

/// n/d rounded to the nearest whole number; ties are rounded away from zero. This definition uses exact
/// arithmetic.
I128 rounded(I128 n, I128 d) {
  const bool negative = (n < 0) != (d < 0);
  const I128 a = n < 0 ? -n : n, b = d < 0 ? -d : d;
  const I128 q = (2 * a + b) / (2 * b);
  return negative ? -q : q;
}

template <class F>
I128 fitted(I128 x) {
  constexpr I128 high = detail::greatest<typename F::Storage>, low = detail::least<typename F::Storage>;
  return x > high ? high : x < low ? low : x;
}

template <class F>
void expect_exact(F a, F b) {
  const I128 x = a.raw, y = b.raw, unit = I128{1} << F::fraction_bits;
  ASSERT_EQ((a + b).raw, fitted<F>(x + y)) << +a.raw << ' ' << +b.raw;
  ASSERT_EQ((a - b).raw, fitted<F>(x - y)) << +a.raw << ' ' << +b.raw;
  ASSERT_EQ((a * b).raw, fitted<F>(rounded(x * y, unit))) << +a.raw << ' ' << +b.raw;
  if (y != 0) {
    ASSERT_EQ((a / b).raw, fitted<F>(rounded(x * unit, y))) << +a.raw << ' ' << +b.raw;
  }
  ASSERT_EQ((-a).raw, fitted<F>(-x));
  ASSERT_EQ(a < b, x < y);
  ASSERT_EQ(a > b, x > y);
  ASSERT_EQ(a <= b, x <= y);
  ASSERT_EQ(a >= b, x >= y);
  ASSERT_EQ(a == b, x == y);
  ASSERT_EQ(ScalarTraits<F>::half_difference(a, b).raw, fitted<F>(rounded(x - y, 2)));
}

template <int FractionBits>
void expect_all_pairs_exact() {
  using F = Fixed<std::int8_t, FractionBits>;
  for (int a = -128; a < 128; ++a)
    for (int b = -128; b < 128; ++b)
      expect_exact(F::from_raw(static_cast<std::int8_t>(a)), F::from_raw(static_cast<std::int8_t>(b)));
}

TEST(Fixed, AllPairsOfEightBitsAreExactlyRounded) {
  expect_all_pairs_exact<7>();
  expect_all_pairs_exact<4>();
  expect_all_pairs_exact<1>();
}

template <class F>
class FixedFormats : public ::testing::Test {};
using Formats = ::testing::Types<Q15, Q31, Fixed<std::int16_t, 12>, Q14, Fixed<std::int32_t, 16>,
                                 Fixed<std::int32_t, 27>>;
TYPED_TEST_SUITE(FixedFormats, Formats);

/// Random numbers. Half of them are at or near the limits of the range, where fixed point may fail.
template <class Storage>
Storage drawn(std::mt19937_64& random) {
  constexpr Storage corners[] = {0,
                                 1,
                                 -1,
                                 2,
                                 -2,
                                 detail::greatest<Storage>,
                                 detail::least<Storage>,
                                 detail::greatest<Storage> - 1,
                                 detail::least<Storage> + 1,
                                 detail::greatest<Storage> / 2,
                                 detail::greatest<Storage> / 2 + 1,
                                 detail::least<Storage> / 2};
  const std::uint64_t bits = random();
  if (bits % 3 == 0) return corners[(bits >> 8) % (sizeof corners / sizeof corners[0])];
  return static_cast<Storage>(static_cast<Storage>(bits >> 16) >> (bits >> 3) % 12);
}

TYPED_TEST(FixedFormats, DrawnPairsAreExactlyRounded) {
  using F = TypeParam;
  std::mt19937_64 random{20170517};
  for (int n = 0; n < 200000; ++n)
    expect_exact(F::from_raw(drawn<typename F::Storage>(random)),
                 F::from_raw(drawn<typename F::Storage>(random)));
}

TYPED_TEST(FixedFormats, DivisionByZeroSaturates) {
  using F = TypeParam;
  EXPECT_EQ(F(0.25) / F{}, F::max());
  EXPECT_EQ(F(-0.25) / F{}, F::min());
  EXPECT_EQ(F{} / F{}, F{});
}

TYPED_TEST(FixedFormats, ConversionRoundsToNearestAndSaturates) {
  using F = TypeParam;
  const double unit = std::ldexp(1.0, -F::fraction_bits);
  EXPECT_EQ(F(0.25).raw, 1 << (F::fraction_bits - 2));
  EXPECT_EQ(F(1.5 * unit).raw, 2);
  EXPECT_EQ(F(-1.5 * unit).raw, -2);
  EXPECT_EQ(F(1.4999 * unit).raw, 1);
  EXPECT_EQ(F(0.49999999999999994 * unit).raw, 0) << "adding a half first would round this up";
  EXPECT_EQ(F(1e30), F::max());
  EXPECT_EQ(F(-1e30), F::min());
  EXPECT_EQ(F(std::nan("")), F{});
  EXPECT_EQ(F(static_cast<double>(F(0.3))), F(0.3)) << "every number comes back";
  EXPECT_EQ(F(static_cast<double>(F::max())), F::max());
}

TYPED_TEST(FixedFormats, GainsAboveAndBelowOneRoundOnce) {
  using F = TypeParam;
  using Storage = typename F::Storage;
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> exponent(-12, 5);
  for (int n = 0; n < 20000; ++n) {
    const double wanted = (n % 2 ? 1 : -1) * std::exp2(exponent(random));
    const Gain<F> gain(wanted);
    // The mantissa is at least 2^(bits-2), so half a digit is its largest error.
    EXPECT_LE(std::fabs(static_cast<double>(gain) - wanted),
              std::fabs(wanted) * std::ldexp(1.0, 1 - detail::Widths<Storage>::bits));
    const F x = F::from_raw(drawn<Storage>(random)), y = F::from_raw(drawn<Storage>(random));
    const I128 m = gain.mantissa, scale = I128{1} << gain.right;
    ASSERT_EQ(ScalarTraits<F>::product(x, gain).raw, fitted<F>(rounded(x.raw * m, scale)));
    // The result of the accumulator: a difference of signals with digits that are finer by 2^guard. It
    // saturates at the accumulator's limits.
    using Raw = typename Accumulator<F>::Raw;
    const I128 fine = rounded((I128{x.raw} - y.raw) * m << Accumulator<F>::guard_bits, scale);
    const I128 high = detail::greatest<Raw>, low = detail::least<Raw>;
    const auto sum = ScalarTraits<F>::accumulated(
        static_cast<typename F::WideInt>(ScalarTraits<F>::wide(x) - ScalarTraits<F>::wide(y)), gain);
    ASSERT_EQ(sum.raw, fine > high ? high : fine < low ? low : fine);
  }
  EXPECT_EQ(static_cast<double>(Gain<F>(0.0)), 0.0);
  EXPECT_EQ(Gain<F>(1e30).mantissa, detail::greatest<Storage>);
}

TYPED_TEST(FixedFormats, AccumulatorsSaturateAndComeBack) {
  using F = TypeParam;
  using T = ScalarTraits<F>;
  for (const F x : {F{}, F(0.3), F(-0.3), F::max(), F::min()}) EXPECT_EQ(T::signal(T::accumulator(x)), x);
  Accumulator<F> sum{};
  for (int n = 0; n < 40; ++n) sum = sum + T::accumulator(F::max());
  EXPECT_EQ(T::signal(sum), F::max());
  EXPECT_EQ(sum.raw, detail::greatest<typename Accumulator<F>::Raw>);
  EXPECT_EQ(T::signal(-sum - sum), F::min());
}

TYPED_TEST(FixedFormats, TimesBecomeRatesAndFractions) {
  using F = TypeParam;
  using T = ScalarTraits<F>;
  const TickRatio<F> ratio(0.25 * 1000);
  const double unit = std::ldexp(1.0, -F::fraction_bits);
  for (const std::uint32_t ticks : {1000u, 1001u, 5000u, 123457u, 0x7fffffffu, 0xffffffffu}) {
    EXPECT_NEAR(static_cast<double>(T::per_ticks(ratio, ticks)), 250.0 / ticks, unit) << ticks;
    EXPECT_NEAR(static_cast<double>(T::fraction(ticks / 3, ticks)), std::floor(ticks / 3.0) / ticks,
                0.5 * unit);
  }
  EXPECT_EQ(T::per_ticks(ratio, 0), F::max());
  EXPECT_EQ(T::fraction(7, 7), one<F>);
  EXPECT_EQ(T::fraction(0, 0), one<F>);
  EXPECT_EQ(T::counts(3, Gain<F>(5.0)).raw, 15) << "a count and a gain to raw digits";
}

/// For any counts, the result is the nearest digit. In whole numbers, this is (part 2^n + whole/2)/whole.
TYPED_TEST(FixedFormats, AFractionIsTheNearestDigit) {
  using F = TypeParam;
  std::mt19937_64 random{48};
  for (int n = 0; n < 20000; ++n) {
    const auto whole = static_cast<std::uint32_t>(1 + (random() >> (32 + random() % 32)));
    const auto part = static_cast<std::uint32_t>(random() % whole);
    const std::uint64_t scaled = static_cast<std::uint64_t>(part) << F::fraction_bits;
    const std::uint64_t nearest = (scaled + whole / 2) / whole;  // no tie if `whole` is odd; ties round up if
                                                                 // it is even
    const auto most = static_cast<std::uint64_t>(F::max().raw);
    EXPECT_EQ(static_cast<std::uint64_t>(ScalarTraits<F>::fraction(part, whole).raw), std::min(nearest, most))
        << part << '/' << whole;
  }
}

static_assert(std::is_trivially_copyable_v<Q15> && sizeof(Q15) == 2 && sizeof(Q31) == 4);
static_assert(!std::is_convertible_v<double, Q15> && !std::is_convertible_v<Q15, double>);
static_assert(!std::is_convertible_v<Q15, Q31>, "no conversion between formats by accident");
static_assert(Q15(0.5) * Q15(0.5) == Q15(0.25) && -Q15::min() == Q15::max());
static_assert(Q15::min() * Q15::min() == Q15::max(), "(-1)(-1) is the one product that does not fit");
static_assert(one<Q15> == Q15::max() && one<Q14>.raw == 16384);

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// A printed decimal is converted to another unit. The result is equal to the double of the decimal that is
// written in the other unit.
#include "sixstep/base/decimal.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "sixstep/base/random.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::base;

TEST(Decimal, InAnotherUnitIsTheNearestDoubleOfTheDigits) {
  constexpr std::uint64_t seed = 1;
  for (std::uint64_t n = 0; n < 100000; ++n) {
    const auto draw = [&](std::uint64_t stream, double below) {
      return static_cast<long long>(uniform({seed, stream, n}) * below);
    };
    const std::string digits = std::to_string(draw(0, 1e9));
    const int exponent = -static_cast<int>(draw(1, 10.0)), ten = static_cast<int>(draw(2, 20.0)) - 10;
    const double printed = std::strtod((digits + "e" + std::to_string(exponent)).c_str(), nullptr);
    const double wanted = std::strtod((digits + "e" + std::to_string(exponent + ten)).c_str(), nullptr);
    EXPECT_EQ(times_ten_to(printed, ten), wanted) << digits << "e" << exponent << " times 1e" << ten;
    EXPECT_EQ(times_ten_to(-printed, ten), -wanted);
  }
}

TEST(Decimal, BeatsThePlainQuotientWhichRoundsTwice) {
  int off = 0;
  for (int n = 1; n < 1000; ++n) off += (n / 1e3) / 1e3 != times_ten_to(n / 1e3, -3);
  EXPECT_GT(off, 50);
}

TEST(Decimal, LastDigitIsThatOfTheShortestDecimal) {
  EXPECT_EQ(last_digit_of(1.03), 0.01);
  EXPECT_EQ(last_digit_of(24.0), 1.0);
  EXPECT_EQ(last_digit_of(7.3e-6), 1e-7);
  EXPECT_EQ(last_digit_of(0.1 + 0.2), 0.0);  // not a printed decimal
}

}  // namespace SIXSTEP_TEST_FILE

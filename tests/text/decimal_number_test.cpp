// SPDX-License-Identifier: Apache-2.0
// Two conversions of decimals to doubles are compared with the conversion of the C++ library. One is exact
// and uses no library; the other is the conversion that the program uses.
#include "text/keys/decimal_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <system_error>

#include "text/keys/nearest_double.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using Kind = DecimalNumber::Kind;

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

/// The conversion of the C++ library.
DecimalNumber by_library(const std::string& text) {
  double x = 0.0;
  const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), x);
  const auto size = static_cast<std::size_t>(read.ptr - text.data());
  if (read.ec == std::errc::invalid_argument) return {};
  if (read.ec != std::errc()) return {.kind = Kind::out_of_range, .size = size};
  return {Kind::number, x, size};
}

void expect_as_library(const std::string& text) {
  const DecimalNumber x = decimal_number(text), wanted = by_library(text);
  ASSERT_EQ(x.kind, wanted.kind) << text;
  ASSERT_EQ(x.size, wanted.size) << text;
  ASSERT_EQ(bits(x.value), bits(wanted.value)) << text;
}

/// The exact double from the digits and the exponent of to_chars. It is computed without a conversion of
/// text.
double by_whole_numbers(const std::string& scientific) {
  std::string digits;
  const std::size_t e = scientific.find('e');
  for (const char c : scientific.substr(0, e))
    if (c >= '0' && c <= '9') digits += c;
  const long decimals = static_cast<long>(digits.size()) - 1;
  return nearest_double(digits, std::stol(scientific.substr(e + 1)) - decimals);
}

TEST(DecimalNumber, ReadsWhatIsWrittenAsTheLibraryDoes) {
  for (const char* text : {"0",
                           "-0",
                           "0.",
                           "00001",
                           "1.",
                           "1.e5",
                           ".5",
                           "-.5",
                           ".",
                           "-",
                           "",
                           "e5",
                           "1e",
                           "1e+",
                           "1e-",
                           "1e5x",
                           "1 ",
                           "+1",
                           "1.2.3",
                           "0e999999999999",
                           "-1e400",
                           "1e99999999999",
                           "1e-99999999999",
                           "1,5"})
    expect_as_library(text);
}

TEST(DecimalNumber, NeitherWordsNorHexadecimalsAreNumbers) {
  for (const char* text : {"nan", "inf", "-inf", "infinity"})
    EXPECT_EQ(decimal_number(text).kind, Kind::none) << text;
  EXPECT_EQ(decimal_number("0x10").size, 1u);
}

TEST(DecimalNumber, EndsOfTheRange) {
  for (const char* text : {"1.7976931348623157e308", "1.7976931348623158e308", "1.7976931348623159e308",
                           "1e309", "4.9e-324", "2.4703282292062327e-324", "2.4703282292062328e-324",
                           "1e-400", "2.2250738585072011e-308", "2.2250738585072014e-308"})
    expect_as_library(text);
}

TEST(DecimalNumber, LongOnesAreRoundedOnce) {
  const std::string zeros(2000, '0'), nines(900, '9');
  for (const std::string& text :
       {"0." + zeros + "1e2001", "1" + zeros + "e-2000", "0." + nines, "9007199254740993." + zeros + "1",
        std::string("9007199254740993"), "9007199254740993." + nines})
    expect_as_library(text);
}

/// With integer arithmetic only, a double is restored from its shortest and from its longest decimal.
TEST(NearestDouble, ComesBackFromItsOwnDigits) {
  constexpr unsigned seed = 13;
  std::mt19937_64 random(seed);
  for (int n = 0; n < 20'000; ++n) {
    const double x = std::fabs(std::bit_cast<double>(random()));
    if (!std::isfinite(x)) continue;
    char text[64];
    const auto shortest = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific);
    ASSERT_EQ(bits(by_whole_numbers({text, shortest.ptr})), bits(x)) << x << ", seed " << seed;
    const auto longest = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific, 20);
    ASSERT_EQ(bits(by_whole_numbers({text, longest.ptr})), bits(x)) << x << ", seed " << seed;
  }
}

/// The middle between two doubles is a decimal of finite length. It must be rounded to the even double. A
/// slightly different number must be rounded to the nearer double.
TEST(NearestDouble, TheMiddleGoesToTheEvenOne) {
  constexpr unsigned seed = 14;
  std::mt19937_64 random(seed);
  for (int n = 0; n < 5'000; ++n) {
    const std::uint64_t mantissa = (random() >> 11) | std::uint64_t{1} << 52;  // 2^52 .. 2^53
    const double below = static_cast<double>(mantissa), above = below + 1.0;
    const std::string whole = std::to_string(mantissa);
    const double even = mantissa % 2 == 0 ? below : above;
    ASSERT_EQ(nearest_double(whole + "5", -1), even) << whole << ".5, seed " << seed;
    ASSERT_EQ(nearest_double(whole + "5" + std::string(900, '0') + "1", -902), above) << whole;
    ASSERT_EQ(nearest_double(whole + "4" + std::string(900, '9'), -901), below) << whole;
  }
}

TEST(NearestDouble, BeyondAllIsNothingOrInfinite) {
  EXPECT_EQ(nearest_double("1", -400), 0.0);
  EXPECT_EQ(nearest_double("0", 400), 0.0);
  EXPECT_EQ(nearest_double("1", 400), std::numeric_limits<double>::infinity());
  EXPECT_EQ(nearest_double("18", 307), std::numeric_limits<double>::infinity());
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

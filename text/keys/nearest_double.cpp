// SPDX-License-Identifier: Apache-2.0
#include "text/keys/nearest_double.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace text {
namespace {

/// A non-negative whole number of any size: words of 32 bits, the lowest first, without leading zeros.
class Natural {
 public:
  explicit Natural(std::uint32_t word) : words_(word == 0 ? 0 : 1, word) {}

  void times_plus(std::uint32_t factor, std::uint32_t summand) {
    std::uint64_t carry = summand;
    for (std::uint32_t& word : words_) {
      carry += std::uint64_t{word} * factor;
      word = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) words_.push_back(static_cast<std::uint32_t>(carry));
  }

  void times_ten_to(int power) {
    constexpr int at_once = 9;
    for (; power >= at_once; power -= at_once) times_plus(1'000'000'000, 0);
    for (; power > 0; --power) times_plus(10, 0);
  }

  void shift_left(int bits) {
    if (words_.empty()) return;
    if (bits % 32 != 0) times_plus(std::uint32_t{1} << bits % 32, 0);
    words_.insert(words_.begin(), static_cast<std::size_t>(bits / 32), 0);
  }

  /// Subtracts a number that is at most as large.
  void subtract(const Natural& other) {
    std::int64_t borrow = 0;
    for (std::size_t n = 0; n < words_.size(); ++n) {
      borrow += std::int64_t{words_[n]} - (n < other.words_.size() ? other.words_[n] : 0);
      words_[n] = static_cast<std::uint32_t>(borrow);
      borrow >>= 32;
    }
    while (!words_.empty() && words_.back() == 0) words_.pop_back();
  }

  int bits() const {
    return words_.empty() ? 0 : static_cast<int>(32 * words_.size()) - std::countl_zero(words_.back());
  }

  bool operator==(const Natural&) const = default;
  bool operator<(const Natural& other) const {
    if (words_.size() != other.words_.size()) return words_.size() < other.words_.size();
    return std::lexicographical_compare(words_.rbegin(), words_.rend(), other.words_.rbegin(),
                                        other.words_.rend());
  }

 private:
  std::vector<std::uint32_t> words_;
};

constexpr int mantissa_bits = std::numeric_limits<double>::digits;
constexpr int least_power =
    std::numeric_limits<double>::min_exponent - mantissa_bits;  // power of two of the smallest double

/// The double nearest to over / under.
double quotient(Natural over, Natural under) {
  // The mantissa is the integer part of over / (under 2^power), and below 2^53.
  int power = std::max(over.bits() - under.bits() - mantissa_bits, least_power);
  (power < 0 ? over : under).shift_left(std::abs(power));
  Natural bound = under;
  bound.shift_left(mantissa_bits);
  if (!(over < bound)) {
    under.shift_left(1);
    bound.shift_left(1);
    ++power;
  }
  // Long division: each step gives one bit, then doubles `over` and the mantissa.
  std::uint64_t mantissa = 0;
  for (int bit = 0; bit < mantissa_bits; ++bit) {
    over.shift_left(1);
    mantissa <<= 1;
    if (!(over < bound)) {
      over.subtract(bound);
      ++mantissa;
    }
  }
  over.shift_left(1);
  if (bound < over || (over == bound && mantissa % 2 == 1)) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), power);
}

/// No double, and no midpoint between two doubles, has more than 767 significant digits. Further digits
/// matter only if any of them is not 0.
constexpr std::size_t most_digits = 800;

/// Removes leading and trailing zeros.
void shorten(std::string& digits, long& power) {
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  if (digits.size() <= most_digits) return;
  const bool more = digits.find_first_not_of('0', most_digits) != std::string::npos;
  power += static_cast<long>(digits.size() - most_digits);
  digits.resize(most_digits);
  if (more && digits.back() == '0') digits.back() = '1';
}

}  // namespace

double nearest_double(std::string digits, long power) {
  shorten(digits, power);
  if (digits.empty()) return 0.0;
  const long size = power + static_cast<long>(digits.size());  // 10^(size - 1) <= number < 10^size
  constexpr long largest = std::numeric_limits<double>::max_exponent10 + 1, least = -330;
  if (size > largest) return std::numeric_limits<double>::infinity();
  if (size < least) return 0.0;
  Natural over(0), under(1);
  for (const char c : digits) over.times_plus(10, static_cast<std::uint32_t>(c - '0'));
  (power < 0 ? under : over).times_ten_to(static_cast<int>(std::abs(power)));
  return quotient(std::move(over), std::move(under));
}

}  // namespace text

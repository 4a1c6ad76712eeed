// SPDX-License-Identifier: Apache-2.0
#include "text/keys/decimal_number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "text/keys/nearest_double.hpp"

namespace text {
namespace {

/// The end of the digits that begin at `at`.
std::size_t end_of_digits(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of("0123456789", at), text.size());
}

/// A number as written: its sign, its digits without the point, and the power of ten of the last digit.
struct Decimal {
  bool negative = false;
  std::string digits;
  long power = 0;
  std::size_t size = 0;  ///< length of the number's text
};

/// The exponent that begins with the letter e at `at`, and the position after the exponent. 0 and `at` if no
/// digit follows the e.
std::pair<long, std::size_t> exponent(std::string_view text, std::size_t at) {
  constexpr long far = 1'000'000'000;
  if (at >= text.size() || (text[at] != 'e' && text[at] != 'E')) return {0, at};
  const std::size_t sign = at + 1, first = text.substr(sign, 1).find_first_of("+-") == 0 ? sign + 1 : sign;
  const std::size_t end = end_of_digits(text, first);
  if (end == first) return {0, at};
  long power = 0;
  for (const char c : text.substr(first, end - first)) power = std::min(far, 10 * power + (c - '0'));
  return {text[sign] == '-' ? -power : power, end};
}

Decimal decimal_in(std::string_view text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0, point = end_of_digits(text, first);
  Decimal w{.negative = first == 1, .digits = std::string(text.substr(first, point - first)), .size = point};
  if (point < text.size() && text[point] == '.') {
    w.size = end_of_digits(text, point + 1);
    w.digits += text.substr(point + 1, w.size - point - 1);
    w.power = -static_cast<long>(w.size - point - 1);
  }
  if (w.digits.empty()) return w;
  const auto [power, end] = exponent(text, w.size);
  w.power += power;
  w.size = end;
  return w;
}

double magnitude([[maybe_unused]] std::string_view text, const Decimal& w) {
#ifdef __cpp_lib_to_chars  // many times as fast as nearest_double()
  double x = 0.0;
  if (std::from_chars(text.data(), text.data() + w.size, x).ec == std::errc()) return std::fabs(x);
#endif
  return nearest_double(w.digits, w.power);
}

}  // namespace

DecimalNumber decimal_number(std::string_view text) {
  const Decimal w = decimal_in(text);
  if (w.digits.empty()) return {};
  const bool zero = w.digits.find_first_not_of('0') == std::string::npos;
  const double x = magnitude(text, w);
  if (std::isinf(x) || (x == 0.0 && !zero))
    return {.kind = DecimalNumber::Kind::out_of_range, .size = w.size};
  return {DecimalNumber::Kind::number, w.negative ? -x : x, w.size};
}

std::optional<double> number_alone(std::string_view text) {
  const DecimalNumber x = decimal_number(text);
  if (x.kind != DecimalNumber::Kind::number || x.size != text.size()) return {};
  return x.value;
}

}  // namespace text

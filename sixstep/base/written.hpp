// SPDX-License-Identifier: Apache-2.0
// Numbers as text, for messages.
#pragma once
#include <charconv>
#include <cstdint>
#include <string>

namespace sixstep::base {

/// The shortest decimal that converts back to the same double, independent of the locale.
inline std::string written(double x) {
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, x);
  return {text, end.ptr};
}

/// x rounded to `digits` significant digits.
inline std::string rounded(double x, int digits) {
  char text[32];
  const std::to_chars_result end =
      std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits);
  return {text, end.ptr};
}

/// x rounded to three significant digits, for sentences that need no exact value.
inline std::string three_digits(double x) { return rounded(x, 3); }
/// x rounded to six significant digits, for a number from a user or from a formula.
inline std::string six_digits(double x) { return rounded(x, 6); }

/// `bits` as sixteen hexadecimal digits.
inline std::string written_hex(std::uint64_t bits) {
  std::string text(16, '0');
  for (auto digit = text.rbegin(); bits != 0; ++digit, bits >>= 4) *digit = "0123456789abcdef"[bits & 15];
  return text;
}

}  // namespace sixstep::base

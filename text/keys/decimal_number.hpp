// SPDX-License-Identifier: Apache-2.0
// Converts the text of a decimal number to the nearest double, the same on every platform and in every
// locale.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace text {

struct DecimalNumber {
  enum class Kind { number, none, out_of_range } kind = Kind::none;
  double value = 0.0;    ///< if kind is number
  std::size_t size = 0;  ///< number of characters read, even if the number is out of range
};

/// Reads the longest beginning of the text that is a number. A number has an optional minus, digits with at
/// most one point, and an optional exponent. The value is rounded once; if two doubles are equally near, it
/// is the even one of the two. A number is out of range if it would be infinite, or if it would be 0 although
/// it has a digit other than 0.
DecimalNumber decimal_number(std::string_view text);

/// The number if the whole text is a number; else empty.
std::optional<double> number_alone(std::string_view text);

}  // namespace text

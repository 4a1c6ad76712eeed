// SPDX-License-Identifier: Apache-2.0
// A decimal number's text as the nearest double, the same on every platform and in every locale.
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace text {

struct DecimalNumber {
  enum class Kind { number, none, out_of_range } kind = Kind::none;
  double value = 0.0;    ///< of a number
  std::size_t size = 0;  ///< of what was read, also where it is out of range
};

/// The longest beginning of the text that is a number: perhaps a minus, digits with at most one point,
/// perhaps an exponent. Rounded once, to even where two doubles are equally near. What would be infinite, or
/// 0 although it has other digits, is out of range.
DecimalNumber decimal_number(std::string_view text);

/// The number that the text is, with nothing behind it.
std::optional<double> number_alone(std::string_view text);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Prints numbers as engineers write them: SI prefixes for units that allow them, and the digits that the
// limits require.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace report {

/// A unit with its prefix: shown = value * factor.
struct Scale {
  double factor = 1.0;
  std::string unit;  ///< "ms", "°", "rad/s"; empty for pure numbers
};

/// The prefix with which the number is between 1 and 1000. Only units that usually have a prefix get a
/// prefix: no mrad/s, no krpm.
Scale scale_for(double magnitude, std::string_view unit);

/// A number such as "0.927", with `digits` significant digits and a true minus sign; with a power of ten if
/// plain digits would be unreadable.
std::string plain(double value, int digits, bool trim = false);

/// A given value with its unit and without trailing zeros: "0.927 ms", "33.5 mNm/A", "7.3·10⁻⁶ Nm s".
std::string given(double value, std::string_view unit);

/// Whether the value is the time of an event that did not occur. Then a word is printed instead of the
/// number.
bool never(double value, std::string_view unit);

/// A computed value with its unit and four digits.
std::string computed(double value, std::string_view unit);

/// Unit of a difference: kelvin for temperatures on the Celsius scale.
std::string_view difference_unit(std::string_view unit);

/// Computed values that are printed beside each other. All have the prefix of the largest value. They have
/// the prefix of the smallest nonzero value if this value would otherwise be below 0.1 and the largest stays
/// below 10000. If sizes differ by more than a factor of 10000, each value has its own prefix. Empty for a
/// missing value.
std::vector<std::string> computed_alike(const std::vector<std::optional<double>>& values,
                                        std::string_view unit);

/// The deviation measured/reference - 1 as text: "+1.3 %", or "x 14.6" if the ratio is ten or more. If the
/// reference is near zero or is a temperature, the text is the difference: "+0.02 A". If one of the numbers
/// is not finite, the text is in words.
std::string deviation(double measured, double reference, std::string_view unit);

/// A fraction in per cent with two digits: "97 %" for 0.97.
std::string in_percent(double part);

/// A figure and its limits in one unit, with enough digits to distinguish them.
struct Judged {
  std::string measured;
  std::string required;  ///< "≤ 1 ms", "23.3009 … 23.3010 A"
};
Judged judged(double measured, std::optional<double> min, std::optional<double> max, std::string_view unit);

/// The value in rpm, to be printed beside a value in rad/s; empty for any other unit.
std::string aside(double value, std::string_view unit);

/// A count with narrow spaces between groups: "1 234 567".
std::string grouped(long long count);

}  // namespace report

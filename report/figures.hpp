// SPDX-License-Identifier: Apache-2.0
// Prints numbers as engineers write them: SI prefixes for units that allow them, and the digits that the
// limits require.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace report {

/// A unit with its prefix: shown = value * factor.
struct Scale {
  double factor = 1.0;
  std::string unit;  ///< "ms", "°", "rad/s"; empty for pure numbers
};

/// The prefix that gives a number between 1 and 1000. Only units that usually have a prefix get one: no
/// mrad/s, no krpm.
Scale scale_for(double magnitude, std::string_view unit);

/// "0.927": with `digits` significant digits, a true minus, and powers of ten where plain digits would be
/// unreadable.
std::string plain(double value, int digits, bool trim = false);

/// "0.927 ms", "33.5 mNm/A", "7.3·10⁻⁶ Nm s": for given values, without trailing zeros.
std::string given(double value, std::string_view unit);

/// Whether the value is a time of an event that did not occur; a word then replaces it.
bool never(double value, std::string_view unit);

/// Prints a computed value with four digits.
std::string computed(double value, std::string_view unit);

/// measured/reference - 1 as "+1.3 %", or "+0.02 A" if the reference is zero; words if one is no number.
std::string deviation(double measured, double reference, std::string_view unit);

/// "97 %" for 0.97, with two digits.
std::string in_percent(double part);

/// A figure and its limits in one unit, with enough digits to distinguish them.
struct Judged {
  std::string measured;
  std::string required;  ///< "≤ 1 ms", "23.3009 … 23.3010 A"
};
Judged judged(double measured, std::optional<double> min, std::optional<double> max, std::string_view unit);

/// The value in rpm if the unit is rad/s, else empty.
std::string aside(double value, std::string_view unit);

/// "1 234 567" with narrow spaces.
std::string grouped(long long count);

}  // namespace report

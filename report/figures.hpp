// SPDX-License-Identifier: Apache-2.0
// Numbers as an engineer writes them: SI prefixes where a unit takes them, as many digits as the limits
// resolve.
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

/// The prefix that puts the magnitude between 1 and 1000. Only units that take one get one: no mrad/s, no
/// krpm.
Scale scale_for(double magnitude, std::string_view unit);

/// "0.927": digits significant ones, a true minus, powers of ten where plain digits would be unreadable.
std::string plain(double value, int digits, bool trim = false);

/// "0.927 ms", "33.5 mNm/A", "7.3·10⁻⁶ Nm s": with trailing zeros cut, for given values.
std::string given(double value, std::string_view unit);

/// A time that did not come: a word stands for it.
bool never(double value, std::string_view unit);

/// With four digits, for computed values.
std::string computed(double value, std::string_view unit);

/// measured/reference - 1 as "+1.3 %", or "+0.02 A" against a reference of zero; words where one is no
/// number.
std::string deviation(double measured, double reference, std::string_view unit);

/// "97 %" of 0.97, with two digits.
std::string in_percent(double part);

/// A figure beside its limits, all in one unit and with the digits that tell them apart.
struct Judged {
  std::string measured;
  std::string required;  ///< "≤ 1 ms", "23.3009 … 23.3010 A"
};
Judged judged(double measured, std::optional<double> min, std::optional<double> max, std::string_view unit);

/// The same in rpm for rad/s, else empty.
std::string aside(double value, std::string_view unit);

/// "1 234 567" with narrow spaces.
std::string grouped(long long count);

}  // namespace report

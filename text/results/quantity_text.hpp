// SPDX-License-Identifier: Apache-2.0
// Prints numbers for users: engineering prefixes and few digits, but enough to distinguish a missed limit
// from a met limit. Files for programs (CSV, JSON) have full precision and do not use these functions.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "text/rooms.hpp"

namespace text {

/// A number with its unit: "131.17 us", "47.25 kHz", "702.61 rad/s". It has five significant digits by
/// default.
std::string quantity_text(double x, const std::string& unit, int digits = 5);

/// The common prefix of numbers that are below or beside each other in a table, so that the largest number
/// looks largest. It is the largest number's prefix. It is the prefix of the smallest nonzero number if this
/// number would otherwise be below 0.1 and the largest number stays below 10000. If sizes differ by more than
/// a factor of 10000, each number has its own prefix.
class SharedPrefix {
 public:
  SharedPrefix(std::span<const double> values, const std::string& unit);
  std::string text(double x, int digits = 5) const;

 private:
  std::string unit_;
  double like_ = 0.0;  ///< a number with the common prefix; 0: each number has its own prefix
};

/// A number with `digits` digits after the point; "-" if it is not finite.
std::string fixed_text(double x, int digits);
/// A number in full precision; empty for NaN, "never" for an infinite number.
std::string csv_cell(double x);

/// A number of things: "1 run", "2 runs".
std::string counted(std::size_t n, const char* what);

/// Numbers that are compared with each other. All have the prefix of the largest of `yardsticks`, and enough
/// digits to distinguish different numbers.
struct ComparedTexts {
  std::vector<std::string> yardsticks;
  std::string x;     ///< value with its unit; it has its own prefix if its magnitude differs
  std::string unit;  ///< unit of the yardsticks, with prefix
};
ComparedTexts compared_texts(double x, std::span<const double> yardsticks, const std::string& unit);

}  // namespace text

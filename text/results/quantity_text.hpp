// SPDX-License-Identifier: Apache-2.0
// Numbers for people: engineering prefixes and few digits, but never so few that a miss looks like a hit.
// Files for programs (CSV, JSON) hold full precision and do not come here.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "text/rooms.hpp"

namespace text {

/// "131.17 us", "47.25 kHz", "702.61 rad/s": five significant digits unless asked for others.
std::string quantity_text(double x, const std::string& unit, int digits = 5);

/// With so many digits behind the point; "-" for what is not a number, or none that ends.
std::string fixed_text(double x, int digits);
/// In full, for programs; empty for what has no value, "never" for what does not come.
std::string csv_cell(double x);

/// "1 run", "2 runs".
std::string counted(std::size_t n, const char* what);

/// Numbers that are compared with each other: all in the prefix of the largest of `yardsticks`, and with as
/// many digits as tell apart whatever differs. First the texts of the yardsticks, without unit, then that of
/// x.
struct ComparedTexts {
  std::vector<std::string> yardsticks;
  std::string x;     ///< with its unit; in a prefix of its own where it is of another magnitude
  std::string unit;  ///< of the yardsticks, with prefix
};
ComparedTexts compared_texts(double x, std::span<const double> yardsticks, const std::string& unit);

}  // namespace text

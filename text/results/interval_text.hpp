// SPDX-License-Identifier: Apache-2.0
// Prints measured numbers with the digits that the measurement supports.
#pragma once
#include <string>

#include "sixstep/analysis/identification/interval.hpp"
#include "text/rooms.hpp"

namespace text {

/// The value, rounded to two digits of its half width.
std::string measured_text(const analysis::Interval& x);
/// "3.15 .. 3.27", to the same digits.
std::string bounds_text(const analysis::Interval& x);
/// "3.21 V (3.15 .. 3.27)", where `unit` is "V".
std::string with_bounds(const analysis::Interval& x, const char* unit);
/// A number with the digits that the interval supports, for a file.
std::string as_good_as(double value, const analysis::Interval& x);

/// "> 99.99 %", "97.2 %".
std::string certainty_text(double probability);

}  // namespace text

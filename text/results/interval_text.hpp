// SPDX-License-Identifier: Apache-2.0
// Prints measured numbers with the digits that the measurement supports.
#pragma once
#include <string>

#include "sixstep/analysis/identification/interval.hpp"
#include "text/rooms.hpp"

namespace text {

/// The value, rounded to two digits of its half width: "3.21".
std::string measured_text(const analysis::Interval& x);
/// The bounds with the same digits: "3.15 .. 3.27".
std::string bounds_text(const analysis::Interval& x);
/// The value with `unit` and bounds: "3.21 V (3.15 .. 3.27)" for "V".
std::string with_bounds(const analysis::Interval& x, const char* unit);
/// A number for a file, with as many digits as the interval supports.
std::string as_good_as(double value, const analysis::Interval& x);

/// A probability in per cent: "> 99.99 %", "97.2 %".
std::string certainty_text(double probability);

}  // namespace text

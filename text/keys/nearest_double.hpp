// SPDX-License-Identifier: Apache-2.0
// Converts decimals to doubles with integer arithmetic only, for standard libraries without from_chars for
// double.
#pragma once
#include <string>

namespace text {

/// The double nearest to digits * 10^power. If two doubles are equally near, it is the even one of the two. 0
/// or infinity outside the range of double.
double nearest_double(std::string digits, long power);

}  // namespace text

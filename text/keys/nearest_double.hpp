// SPDX-License-Identifier: Apache-2.0
// Converts decimals to doubles with integer arithmetic only, for standard libraries whose from_chars has no
// double.
#pragma once
#include <string>

namespace text {

/// The double nearest to digits * 10^power; of two equally near ones the even one; 0 or infinity outside the
/// range of double.
double nearest_double(std::string digits, long power);

}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Decimals to doubles in whole numbers alone: for standard libraries whose from_chars knows no double.
#pragma once
#include <string>

namespace text {

/// The digits as a whole number, times ten to the power: the nearest double, the even one where two are
/// equally near; 0 or infinity where it is beyond all.
double nearest_double(std::string digits, long power);

}  // namespace text

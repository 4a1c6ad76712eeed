// SPDX-License-Identifier: Apache-2.0
// Converts printed decimals to another unit with one rounding.
#pragma once
#include <cmath>

namespace sixstep::base {

/// No data sheet prints more than ten digits. A longer number is a computed result and is rounded to a double
/// like any result.
inline constexpr double more_than_printed = 1e10;

/// A printed number times 10^ten, as the double nearest to the decimal product. 0.572 mH becomes exactly the
/// double of 0.000572, and 135 g cm^2 the double of 1.35e-5. The digits form an integer. This integer is
/// multiplied or divided by one exact power of ten, which rounds once. Dividing 0.572 itself would round
/// twice. `ten` is in -22..22, where powers of ten are exact doubles.
inline double times_ten_to(double printed, int ten) {
  const auto scaled = [](double x, int power) {
    double exact = 1.0;
    for (int n = 0; n < (power < 0 ? -power : power); ++n) exact *= 10.0;
    return power < 0 ? x / exact : x * exact;
  };
  double scale = 1.0;
  for (int decimals = 0; decimals <= 22; ++decimals, scale *= 10.0) {
    const double digits = std::floor(printed * scale + 0.5), power = ten - decimals;
    if (!(digits < more_than_printed && digits > -more_than_printed)) break;
    if (digits / scale == printed && power >= -22.0) return scaled(digits, ten - decimals);
  }
  return scaled(printed, ten);
}

/// Weight of the last digit of the shortest decimal that converts back to the same double: 0.01 for 1.03, 1
/// for 24. The weight is 0 for a number with more digits than a data sheet prints. Trailing zeros have no
/// effect, because a double does not store them.
inline double last_digit_of(double printed) {
  double scale = 1.0;
  for (int decimals = 0; decimals <= 22; ++decimals, scale *= 10.0) {
    const double digits = std::floor(printed * scale + 0.5);
    if (digits / scale == printed) return 1.0 / scale;
    if (digits > more_than_printed) break;
  }
  return 0.0;
}

/// Rounds x down or up to `digits` significant digits, for numbers that a user reads, types or changes.
enum class Towards : bool { down, up };
inline double shortened(double x, int digits, Towards towards) {
  if (x == 0.0 || !(x - x == 0.0)) return x;
  double least = 1.0;
  for (int n = 1; n < digits; ++n) least *= 10.0;
  int power = 0;
  while (std::fabs(times_ten_to(x, power)) < least && power < 22) ++power;
  while (std::fabs(times_ten_to(x, power)) >= 10.0 * least && power > -22) --power;
  const double whole = times_ten_to(x, power);
  return times_ten_to(towards == Towards::up ? std::ceil(whole) : std::floor(whole), -power);
}

}  // namespace sixstep::base

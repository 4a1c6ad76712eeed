// SPDX-License-Identifier: Apache-2.0
// Computes exp, log, pow. Each function reduces its argument exactly and sums a Taylor series whose first
// omitted term is below 2^-60 of the result. Bits that affect the last rounding are stored in double-double.
#include "sixstep/base/elementary.hpp"

#include <bit>
#include <cstdint>
#include <limits>

#include "sixstep/base/double_double.hpp"

namespace sixstep::base {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr DoubleDouble ln_2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
// ln 2 in two parts: the first has 42 bits, so that its product with any exponent of a double is exact; the
// second is the rest.
constexpr double ln_2_short = 0x1.62e42fefa38p-1;
constexpr double ln_2_rest = 0x1.ef35793c7673p-45;
constexpr double log2_e = 0x1.71547652b82fep+0;

bool is_nan(double x) { return x != x; }

/// 2^n for n in -1022..1023, so that 2^n is a normal double.
double power_of_two(std::int64_t n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// y 2^n, rounded once even if the result is subnormal, for y in [1/2, 2) and n in [-1080, 1024].
double scale(double y, std::int64_t n) {
  if (n > 1023) return y * 2.0 * power_of_two(n - 1);
  if (n >= -1021) return y * power_of_two(n);
  return y * power_of_two(n + 200) * power_of_two(-200);
}

/// exp(x.high + x.low), for |x| <= 746. With x = n ln 2 + r, |r| <= 0.347, the result is 2^n exp(r), and
/// exp(r) = 1 + r + r^2 (1/2! + r/3! + ...).
double exp_sum(DoubleDouble x) {
  const double n_real = x.high * log2_e;
  const std::int64_t n = static_cast<std::int64_t>(n_real + (n_real < 0.0 ? -0.5 : 0.5));
  const double k = static_cast<double>(n);
  const DoubleDouble r = two_sum(x.high - k * ln_2_short, -(k * ln_2_rest));  // the first difference is exact
  const double h = r.high, rest = r.low + x.low;
  double p = 0x1.93974a8c07c9dp-37;  // 1/14!
  p = p * h + 0x1.6124613a86d09p-33;
  p = p * h + 0x1.1eed8eff8d898p-29;
  p = p * h + 0x1.ae64567f544e4p-26;
  p = p * h + 0x1.27e4fb7789f5cp-22;
  p = p * h + 0x1.71de3a556c734p-19;
  p = p * h + 0x1.a01a01a01a01ap-16;
  p = p * h + 0x1.a01a01a01a01ap-13;
  p = p * h + 0x1.6c16c16c16c17p-10;
  p = p * h + 0x1.1111111111111p-7;
  p = p * h + 0x1.5555555555555p-5;
  p = p * h + 0x1.5555555555555p-3;
  p = p * h + 0.5;
  const double tail = h * h * p;
  const DoubleDouble one_r = fast_two_sum(1.0, h), sum = fast_two_sum(one_r.high, tail);
  return scale(sum.high + (sum.low + (one_r.low + rest * (1.0 + (h + tail)))), n);
}

/// log x with an error of about 2^-68, for finite x > 0: log x = k ln 2 + log m.
/// x = 2^k m with m in [sqrt(1/2), sqrt 2).
/// log m = 2 s (1 + s^2/3 + s^4/5 + ...) with s = (m - 1)/(m + 1), |s| <= 0.1716.
DoubleDouble log_sum(double x) {
  std::int64_t k = 0;
  if (x < std::numeric_limits<double>::min()) {  // subnormal
    x *= 0x1p54;
    k = -54;
  }
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  // Difference of the bits of 1 and of sqrt(1/2). Adding it to the bits of a number increments the exponent
  // if the mantissa is at least sqrt 2.
  constexpr std::uint64_t half_octave = 0x3ff0000000000000u - 0x3fe6a09e667f3bcdu;
  const std::int64_t octave = static_cast<std::int64_t>((bits + half_octave) >> 52) - 1023;
  k += octave;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(octave) << 52));
  const DoubleDouble s = DoubleDouble{m - 1.0, 0.0} / two_sum(m, 1.0);
  const DoubleDouble q = s * s;
  const double h = q.high;
  double p = 1.0 / 29;
  p = p * h + 1.0 / 27;
  p = p * h + 1.0 / 25;
  p = p * h + 1.0 / 23;
  p = p * h + 1.0 / 21;
  p = p * h + 1.0 / 19;
  p = p * h + 1.0 / 17;
  p = p * h + 1.0 / 15;
  p = p * h + 1.0 / 13;
  p = p * h + 1.0 / 11;
  p = p * h + 1.0 / 9;
  // The rounding of the next terms would affect the result. They are added in double-double.
  DoubleDouble sum = q * p + DoubleDouble{0x1.2492492492492p-3, 0x1.2492492492492p-57};  // 1/7
  sum = q * sum + DoubleDouble{0x1.999999999999ap-3, -0x1.999999999999ap-57};            // 1/5
  sum = q * sum + DoubleDouble{0x1.5555555555555p-2, 0x1.5555555555555p-56};             // 1/3
  sum = q * sum + 1.0;
  const DoubleDouble log_m = sum * s * 2.0;
  return k == 0 ? log_m : ln_2 * static_cast<double>(k) + log_m;
}

/// Kind of y: a fraction, or an even or odd integer. Every double from 2^53 on is an even integer.
enum class Parity { fraction, even, odd };
Parity parity(double y) {
  const double size = y < 0.0 ? -y : y;
  if (size >= 0x1p53) return Parity::even;
  const std::int64_t whole = static_cast<std::int64_t>(size);
  if (static_cast<double>(whole) != size) return Parity::fraction;
  return whole % 2 != 0 ? Parity::odd : Parity::even;
}

/// x^y for x > 0, x != 1 and y != 0. Both numbers may be infinite, but not NaN.
double pow_positive(double x, double y) {
  if (y == infinity || y == -infinity) return (x > 1.0) == (y > 0.0) ? infinity : 0.0;
  if (x == infinity) return y > 0.0 ? infinity : 0.0;
  const DoubleDouble l = log_sum(x);
  const double size = y * l.high;
  if (size > 710.0) return infinity;
  if (size < -746.0) return 0.0;
  if (size < 0x1p-60 && size > -0x1p-60) return 1.0;  // y may be too small to split
  return exp_sum(l * y);
}

bool sign_bit(double x) { return (std::bit_cast<std::uint64_t>(x) >> 63) != 0; }

}  // namespace

double exp(double x) {
  if (is_nan(x)) return nan;
  if (x > 709.782712893384) return infinity;  // the largest double is exp(709.78271289338397...)
  if (x < -745.1332191019412) return 0.0;     // half the smallest subnormal
  return exp_sum({x, 0.0});
}

double log(double x) {
  if (is_nan(x) || x < 0.0) return nan;
  if (x == 0.0) return -infinity;
  if (x == infinity) return infinity;
  return log_sum(x).high;
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (is_nan(x) || is_nan(y)) return nan;
  const Parity whole = y == infinity || y == -infinity ? Parity::even : parity(y);
  const double sign = sign_bit(x) && whole == Parity::odd ? -1.0 : 1.0;
  const double size = x < 0.0 ? -x : x;
  if (size == 0.0) return y > 0.0 ? sign * 0.0 : sign * infinity;
  if (x < 0.0 && x != -infinity && whole == Parity::fraction) return nan;
  return size == 1.0 ? sign : sign * pow_positive(size, y);
}

}  // namespace sixstep::base

// SPDX-License-Identifier: Apache-2.0
// Computes sin, cos and atan2: exact reduction of the argument, then a short Taylor series whose leading
// terms are in double-double.
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sixstep/base/double_double.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::base {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr DoubleDouble half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double half_pi_third = -0x1.f1976b7ed8fbcp-110;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

/// An angle as a number of quarter turns (modulo 4) and a remainder of at most 45 degrees (plus rounding).
struct Reduced {
  unsigned quarters = 0;
  DoubleDouble rest;
};

/// Reduces |x| < 2^20: x - n pi/2, with pi/2 in three doubles whose products with n are exact. Every double
/// below 2^20 differs by at least 2^-60 from all multiples of pi/2, and the omitted part of pi/2 causes an
/// error below 2^-140.
Reduced reduce_small(double x) {
  const double turns = x * two_over_pi;
  const std::int64_t n = static_cast<std::int64_t>(turns + (turns < 0.0 ? -0.5 : 0.5));
  if (n == 0) return {0, {x, 0.0}};
  const double k = static_cast<double>(n);
  const DoubleDouble first = two_prod(k, half_pi.high), second = two_prod(k, half_pi.low);
  DoubleDouble r = two_sum(x - first.high, -first.low);  // the first difference is exact (Sterbenz)
  const DoubleDouble next = two_sum(r.high, -second.high);
  r = two_sum(next.high, (r.low + next.low) - (second.low + k * half_pi_third));
  return {static_cast<unsigned>(n & 3), r};
}

/// 2/pi = sum of words[j] 2^(-32 (j + 1)).
constexpr std::array<std::uint32_t, 39> two_over_pi_words{
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab, 0xf0cfbc20};

/// Reduces x >= 2^20: computes x 2/pi modulo 4 in integers (Payne and Hanek 1983), with x = M 2^E. The
/// function skips words of 2/pi whose product with x is a multiple of 4. The next seven words (224 bits) are
/// exact to 2^-137.
Reduced reduce_large(double x) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::int64_t E = static_cast<std::int64_t>(bits >> 52) - 1075;
  const std::uint64_t M = (bits & 0xfffffffffffffu) | 0x10000000000000u;
  const std::uint64_t M_parts[2] = {M & 0xffffffffu, M >> 32};
  const std::int64_t first = E >= 34 ? (E - 2) / 32 : 0;
  std::array<std::uint64_t, 10> product{};  // digits of 32 bits, least significant first
  for (std::size_t m = 0; m < 2; ++m) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < 7; ++j) {
      const std::uint64_t word = two_over_pi_words[static_cast<std::size_t>(first) + 6 - j];
      const std::uint64_t sum = M_parts[m] * word + product[m + j] + carry;
      product[m + j] = sum & 0xffffffffu;
      carry = sum >> 32;
    }
    product[m + 7] += carry;
  }
  const std::int64_t point = 32 * (first + 7) - E;  // bits after the binary point, at least 191
  const std::size_t top = static_cast<std::size_t>(point / 32), shift = static_cast<std::size_t>(point % 32);
  unsigned quarters = static_cast<unsigned>(((product[top] | (product[top + 1] << 32)) >> shift) & 3u);
  product[top] &= (std::uint64_t{1} << shift) - 1;
  const std::uint64_t half_bit =
      shift > 0 ? (product[top] >> (shift - 1)) & 1u : (product[top - 1] >> 31) & 1u;
  double sign = 1.0;
  if (half_bit != 0) {  // the next quarter turn is nearer: the remainder relative to it is negative
    ++quarters;
    sign = -1.0;
    std::uint64_t carry = 1;
    for (std::size_t i = 0; i <= top; ++i) {
      const std::uint64_t all = i < top ? 0xffffffffu : (std::uint64_t{1} << shift) - 1;
      const std::uint64_t sum = (product[i] ^ all) + carry;
      product[i] = sum & all;
      carry = i < top ? sum >> 32 : 0;
    }
  }
  DoubleDouble fraction;  // summed beginning with the smallest term, so that no bit is lost
  double weight = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - point) << 52);
  for (std::size_t i = 0; i <= top; ++i, weight *= 0x1p32)
    fraction = fraction + static_cast<double>(product[i]) * weight;
  return {quarters & 3u, fraction * half_pi * sign};
}

/// sin(r) = r - r^3/3! + ..., |r| <= pi/4; r.low enters through the derivative cos(r) at r.high.
double sin_rest(DoubleDouble r) {
  const double q = r.high * r.high;
  double p = 0x1.952c77030ad4ap-49;  // 1/17!
  p = p * q - 0x1.ae7f3e733b81fp-41;
  p = p * q + 0x1.6124613a86d09p-33;
  p = p * q - 0x1.ae64567f544e4p-26;
  p = p * q + 0x1.71de3a556c734p-19;
  p = p * q - 0x1.a01a01a01a01ap-13;
  p = p * q + 0x1.1111111111111p-7;
  p = p * q - 0x1.5555555555555p-3;
  return r.high + (r.low * (1.0 - 0.5 * q) + q * p * r.high);
}

/// cos(r) = 1 - r^2/2 + r^4/4! - ...; the square of r.high is exact, in double-double.
double cos_rest(DoubleDouble r) {
  const DoubleDouble square = two_prod(r.high, r.high);
  const double q = square.high;
  double p = -0x1.6827863b97d97p-53;  // 1/18!
  p = p * q + 0x1.ae7f3e733b81fp-45;
  p = p * q - 0x1.93974a8c07c9dp-37;
  p = p * q + 0x1.1eed8eff8d898p-29;
  p = p * q - 0x1.27e4fb7789f5cp-22;
  p = p * q + 0x1.a01a01a01a01ap-16;
  p = p * q - 0x1.6c16c16c16c17p-10;
  p = p * q + 0x1.5555555555555p-5;
  const DoubleDouble head = fast_two_sum(1.0, -0.5 * q);
  return head.high + (head.low + (q * q * p - (0.5 * square.low + r.high * r.low)));
}

/// atan(i/8).
constexpr std::array<DoubleDouble, 9> atan_eighths{{{0.0, 0.0},
                                                    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                                    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                                    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                                    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                                    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                                    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                                    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                                    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};

/// atan(y/x) for 0 <= y <= x with x in [1, 2): atan c + atan s.
/// c is the multiple of 1/8 nearest to y/x.
/// s = (y - c x)/(x + c y), |s| <= 1/16, and atan s = s - s^3/3 + ...
DoubleDouble atan_ratio(double y, double x) {
  const double eighths = std::floor(8.0 * (y / x) + 0.5), c = eighths / 8.0;
  const DoubleDouble s = (-two_prod(c, x) + y) / (two_prod(c, y) + x);
  const double q = s.high * s.high;
  double p = -1.0 / 15;
  p = p * q + 1.0 / 13;
  p = p * q - 1.0 / 11;
  p = p * q + 1.0 / 9;
  p = p * q - 1.0 / 7;
  p = p * q + 1.0 / 5;
  p = p * q - 1.0 / 3;
  return atan_eighths[static_cast<std::size_t>(eighths)] + (s + q * p * s.high);
}

bool sign_bit(double x) { return (std::bit_cast<std::uint64_t>(x) >> 63) != 0; }
double absolute(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
}

/// atan2(y, x) in the first quadrant, for x and y that are not both zero. `mirrored`: the point is in the
/// second quadrant, and the result is pi minus the angle.
double first_quadrant(double y, double x, bool mirrored) {
  const double big = y > x ? y : x, small = y > x ? x : y;
  DoubleDouble angle;
  if (small < big * 0x1p-60) {  // atan of the ratio equals the ratio, and is negligible beside pi/2
    if (y <= x && !mirrored) return y / x;
  } else {
    // A power of two scales the larger number to [1, 2). This power may exceed the range of a double, so it
    // is applied as two factors.
    const std::int64_t exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(big) >> 52) - 1023;
    const double half = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent / 2) << 52);
    const double other =
        std::bit_cast<double>(static_cast<std::uint64_t>(1023 - (exponent - exponent / 2)) << 52);
    angle = atan_ratio(small * half * other, big * half * other);
  }
  if (y > x) angle = half_pi + -angle;
  if (mirrored) angle = half_pi * 2.0 + -angle;
  return angle.high;
}

}  // namespace

SinCos sin_cos(double x) {
  if (!(x - x == 0.0)) return {nan, nan};
  const double size = absolute(x);
  if (size < 0x1p-27) return {x, 1.0};  // sin x = x (1 - x^2/6) rounds to x; this also keeps the sign of zero
  const Reduced r = size < 0x1p20 ? reduce_small(size) : reduce_large(size);
  const double s = sin_rest(r.rest), c = cos_rest(r.rest), sign = x < 0.0 ? -1.0 : 1.0;
  switch (r.quarters) {
    case 0:
      return {sign * s, c};
    case 1:
      return {sign * c, -s};
    case 2:
      return {-sign * s, -c};
    default:
      return {-sign * c, s};
  }
}

double atan2(double y, double x) {
  if (x != x || y != y) return nan;
  double y_size = absolute(y), x_size = absolute(x);
  const double sign = sign_bit(y) ? -1.0 : 1.0;
  if (y_size == 0.0) return sign * (sign_bit(x) ? 2.0 * half_pi.high : 0.0);
  if (y_size == infinity || x_size == infinity) {  // only the direction has an effect: 0, 45 or 90 degrees
    y_size = y_size == infinity ? 1.0 : 0.0;
    x_size = x_size == infinity ? 1.0 : 0.0;
  } else if (y_size < 0x1p-900 && x_size < 0x1p-900) {  // both are tiny: a common factor scales them
    y_size *= 0x1p110;
    x_size *= 0x1p110;
  }
  return sign * first_quadrant(y_size, x_size, sign_bit(x));
}

}  // namespace sixstep::base

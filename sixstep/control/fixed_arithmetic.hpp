// SPDX-License-Identifier: Apache-2.0
// Integer arithmetic under fixed.hpp: saturation and rounding to nearest, ties away from zero. Signs are
// removed first and restored last, so that only unsigned numbers are shifted and divided.
#pragma once
#include <cstdint>

namespace sixstep::control::detail {

/// Integer types by width. A product of two numbers of the storage fits into Wide. int8_t is used only by the
/// exhaustive test.
template <class Int>
struct Widths;
template <>
struct Widths<std::int8_t> {
  using Wide = std::int16_t;
  using Unsigned = std::uint8_t;
  using UnsignedWide = std::uint16_t;
  static constexpr int bits = 8;
};
template <>
struct Widths<std::int16_t> {
  using Wide = std::int32_t;
  using Unsigned = std::uint16_t;
  using UnsignedWide = std::uint32_t;
  static constexpr int bits = 16;
};
template <>
struct Widths<std::int32_t> {
  using Wide = std::int64_t;
  using Unsigned = std::uint32_t;
  using UnsignedWide = std::uint64_t;
  static constexpr int bits = 32;
};
template <>
struct Widths<std::int64_t> {
  using Unsigned = std::uint64_t;
  static constexpr int bits = 64;
};
template <class Int>
using UnsignedOf = typename Widths<Int>::Unsigned;

template <class Int>
constexpr Int two_to(int n) {
  return static_cast<Int>(static_cast<Int>(1) << n);  // n must be less than the number of Int's bits without
                                                      // the sign bit
}
/// 2^(bits-1) - 1, computed without the intermediate result 2^(bits-1), which does not fit.
template <class Int>
inline constexpr Int greatest = static_cast<Int>(two_to<Int>(Widths<Int>::bits - 2) - 1 +
                                                 two_to<Int>(Widths<Int>::bits - 2));
template <class Int>
inline constexpr Int least = static_cast<Int>(-greatest<Int> - 1);

template <class Int>
constexpr UnsignedOf<Int> absolute(Int x) {
  using Unsigned = UnsignedOf<Int>;
  return x < 0 ? static_cast<Unsigned>(Unsigned{0} - static_cast<Unsigned>(x)) : static_cast<Unsigned>(x);
}

/// The signed number from magnitude and sign; saturates if it does not fit.
template <class Unsigned>
constexpr auto with_sign(Unsigned magnitude, bool negative) {
  using Int = decltype([] {
    if constexpr (sizeof(Unsigned) == 2)
      return std::int16_t{};
    else if constexpr (sizeof(Unsigned) == 4)
      return std::int32_t{};
    else
      return std::int64_t{};
  }());
  if (magnitude > static_cast<Unsigned>(greatest<Int>)) return negative ? least<Int> : greatest<Int>;
  return negative ? static_cast<Int>(-static_cast<Int>(magnitude)) : static_cast<Int>(magnitude);
}

/// x, or the nearest number within the range of Narrow.
template <class Narrow, class Wide>
constexpr Narrow saturated(Wide x) {
  if constexpr (sizeof(Narrow) < sizeof(Wide)) {
    if (x > static_cast<Wide>(greatest<Narrow>)) return greatest<Narrow>;
    if (x < static_cast<Wide>(least<Narrow>)) return least<Narrow>;
  }
  return static_cast<Narrow>(x);
}

/// The signed number from magnitude and sign, saturated to an integer of half the width.
template <class Narrow, class Unsigned>
constexpr Narrow narrow_with_sign(Unsigned magnitude, bool negative) {
  if (magnitude > static_cast<Unsigned>(greatest<Narrow>)) return negative ? least<Narrow> : greatest<Narrow>;
  const auto x = static_cast<Narrow>(magnitude);
  return negative ? static_cast<Narrow>(-x) : x;
}

/// Magnitude and sign of a number.
template <class Unsigned>
struct Magnitude {
  Unsigned size = 0;
  bool negative = false;
};

/// Product of 16 by 16 bits where int has 16 bits. On such chips a product of 32-bit factors would call a
/// library function. Four 8-bit products need a quarter of the time of this call.
constexpr std::uint32_t product_by_bytes(std::uint16_t a, std::uint16_t b) {
  const auto part = [](std::uint16_t x, std::uint16_t y) {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>(x & 0xffu) *
                                      static_cast<std::uint16_t>(y & 0xffu));
  };
  const auto a_high = static_cast<std::uint16_t>(a >> 8), b_high = static_cast<std::uint16_t>(b >> 8);
  const std::uint32_t outer = static_cast<std::uint32_t>(part(a_high, b_high)) << 16 | part(a, b);
  return outer + (static_cast<std::uint32_t>(part(a_high, b)) << 8) +
         (static_cast<std::uint32_t>(part(a, b_high)) << 8);
}

/// a b as magnitude and sign. |a| may have one bit more than the magnitude bits of Storage.
template <class Storage>
constexpr auto product(typename Widths<Storage>::Wide a, Storage b) {
  using Wide = typename Widths<Storage>::Wide;
  if constexpr (sizeof(Storage) == 2 && sizeof(int) == 2) {
    const std::uint32_t size = product_by_bytes(static_cast<std::uint16_t>(absolute(a)), absolute(b));
    return Magnitude<std::uint32_t>{size, (a < 0) != (b < 0)};
  } else {
    const Wide p = static_cast<Wide>(a * static_cast<Wide>(b));
    return Magnitude<UnsignedOf<Wide>>{absolute(p), p < 0};
  }
}

/// u/2^n for n >= 0, rounded to nearest.
template <class Unsigned>
constexpr Unsigned magnitude_down(Unsigned u, int n) {
  if (n == 0) return u;
  const Unsigned half = static_cast<Unsigned>(u >> (n - 1));  // u in halves of the last digit of the result;
                                                              // adding 1/2 before the shift could overflow
  return static_cast<Unsigned>((half >> 1) + (half & 1u));
}
template <class Int>
constexpr Int shifted_down(Int x, int n) {
  if (n == 0) return x;
  return with_sign(magnitude_down(absolute(x), n), x < 0);
}

/// +-u 2^n as a signed number, saturated.
template <class Int>
constexpr Int magnitude_up(UnsignedOf<Int> u, bool negative, int n) {
  using Unsigned = UnsignedOf<Int>;
  if (u > static_cast<Unsigned>(static_cast<Unsigned>(greatest<Int>) >> n))
    return negative ? least<Int> : greatest<Int>;
  return with_sign(static_cast<Unsigned>(u << n), negative);
}
template <class Int>
constexpr Int shifted_up(Int x, int n) {
  return magnitude_up<Int>(absolute(x), x < 0, n);
}

/// a/b rounded to nearest, ties up. a must be at most 2^(width-1), and b less than 2^(width-1): otherwise a +
/// b/2 does not fit.
template <class Unsigned>
constexpr Unsigned divided_unsigned(Unsigned a, Unsigned b) {
  return static_cast<Unsigned>((a + static_cast<Unsigned>(b >> 1)) / b);
}

template <class Int>
constexpr Int divided(Int a, Int b) {
  return with_sign(divided_unsigned(absolute(a), absolute(b)), (a < 0) != (b < 0));
}

template <class Int>
constexpr Int sum_saturated(Int a, Int b) {
  if (b > 0 && a > static_cast<Int>(greatest<Int> - b)) return greatest<Int>;
  if (b < 0 && a < static_cast<Int>(least<Int> - b)) return least<Int>;
  return static_cast<Int>(a + b);
}

/// The nearest integer to x, ties away from zero, saturated; 0 if x is NaN.
template <class Int>
constexpr Int nearest(double x) {
  if (!(x == x)) return 0;
  if (x >= static_cast<double>(greatest<Int>)) return greatest<Int>;
  if (x <= static_cast<double>(least<Int>)) return least<Int>;
  const std::int64_t whole = static_cast<std::int64_t>(x);
  const double rest = x - static_cast<double>(whole);  // exact
  return saturated<Int>(static_cast<std::int64_t>(whole + (rest >= 0.5 ? 1 : rest <= -0.5 ? -1 : 0)));
}

}  // namespace sixstep::control::detail

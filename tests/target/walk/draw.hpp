// SPDX-License-Identifier: Apache-2.0
// Random inputs are drawn as integers, so that every processor uses the same bits. Signals cover their whole
// range, and are often at an end of the range or near 0. Gains, sums and ratios are also drawn. In floating
// point, the inputs are the dyadic numbers of the fixed formats. No call draws two of its arguments, because
// the compiler selects the order of arguments.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace target {

using namespace sixstep::control;

/// A linear congruential generator (Knuth, Numerical Recipes). Only the upper half of its state is used,
/// because it has the longer period.
struct Random {
  std::uint32_t state = 12345;

  constexpr std::uint16_t bits() {
    state = state * std::uint32_t{1664525} + std::uint32_t{1013904223};
    return static_cast<std::uint16_t>(state >> 16);
  }
  constexpr std::uint32_t long_bits() {
    const std::uint32_t high = bits();
    return high << 16 | bits();
  }
  /// 0 to n-1
  constexpr std::uint8_t below(std::uint8_t n) { return static_cast<std::uint8_t>(bits() % n); }
  constexpr bool one_in(std::uint16_t n) { return bits() % n == 0; }
};

template <class Scalar>
struct Number;  // draws numbers of a format

template <class Storage, int FractionBits>
struct Number<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;
  static constexpr bool wide = sizeof(Storage) == 4;

  static constexpr Scalar end(bool low) { return low ? Scalar::min() : Scalar::max(); }
  static constexpr Scalar digit(bool low) { return Scalar::from_raw(low ? Storage{-1} : Storage{1}); }
  /// n/2^31 of the range of the format
  static constexpr Scalar part(std::int32_t n) {
    if constexpr (wide)
      return Scalar::from_raw(n);
    else
      return Scalar::from_raw(static_cast<Storage>(n / (std::int32_t{1} << 16)));
  }
  /// m/2^right; m has 16 bits
  static constexpr Gain<Scalar> gain(std::int16_t m, std::int8_t right) {
    if constexpr (wide)
      return Gain<Scalar>::from_raw(static_cast<std::int32_t>(m) * (std::int32_t{1} << 16),
                                    static_cast<std::int8_t>(right + 16));
    else
      return Gain<Scalar>::from_raw(m, right);
  }
  static constexpr Divisor<Scalar> divisor(std::int16_t m, std::int8_t right) {
    return Divisor<Scalar>::from_reciprocal(gain(m, right));
  }
  /// n/2^27 of the range of the format
  static constexpr Accumulator<Scalar> sum(std::int32_t n) {
    using Wide = typename Scalar::WideInt;
    return Accumulator<Scalar>::from_raw(
        static_cast<Wide>(static_cast<Wide>(n) * (wide ? std::int64_t{1} << 32 : 1)));
  }
  static constexpr TickRatio<Scalar> ratio(std::uint16_t n) {
    using Wide = typename Scalar::WideInt;
    return TickRatio<Scalar>::from_raw(
        static_cast<Wide>(static_cast<Wide>(n) * (wide ? std::int32_t{1} << 22 : 64)));
  }
};

template <>
struct Number<float> {
  static constexpr float two_to(int n) {
    float x = 1;
    for (; n > 0; --n) x *= 2;
    for (; n < 0; ++n) x *= 0.5f;
    return x;
  }
  static constexpr float end(bool low) { return low ? -1.0f : 1.0f; }
  static constexpr float digit(bool low) { return low ? -two_to(-23) : two_to(-23); }
  static constexpr float part(std::int32_t n) { return static_cast<float>(n / 256) * two_to(-23); }
  static constexpr float gain(std::int16_t m, std::int8_t right) {
    return static_cast<float>(m) * two_to(-right);
  }
  static constexpr float divisor(std::int16_t m, std::int8_t right) {
    return m == 0 ? 0.0f : two_to(right) / static_cast<float>(m);
  }
  static constexpr float sum(std::int32_t n) { return static_cast<float>(n) * two_to(-27); }
  static constexpr float ratio(std::uint16_t n) { return static_cast<float>(n) * two_to(-9); }
};

/// A random signal: an end of the range, 0, one digit, a small value, or any value.
template <class Scalar>
constexpr Scalar signal(Random& random) {
  const std::uint8_t kind = random.below(16);
  const auto any = static_cast<std::int32_t>(random.long_bits());
  if (kind == 0) return Scalar{};
  if (kind == 1) return Number<Scalar>::end((any & 1) != 0);
  if (kind == 2) return Number<Scalar>::digit((any & 1) != 0);
  if (kind < 8) return Number<Scalar>::part(any / (std::int32_t{1} << (any & 15)));
  return Number<Scalar>::part(any);
}

/// Converts a part of the range to a quantity of an exported drive. In floating point, the quantity is in SI
/// units.
template <class Scalar>
constexpr Scalar in_si(Scalar part, [[maybe_unused]] std::uint16_t whole) {
  if constexpr (__is_same(Scalar, float))
    return part * static_cast<float>(whole);
  else
    return part;
}

/// Zero or a positive signal, less than `most`/32768 of the range.
template <class Scalar>
constexpr Scalar positive(Random& random, std::uint16_t most = 32767) {
  const std::uint32_t n = static_cast<std::uint32_t>(random.bits()) * most >> 16;
  return Number<Scalar>::part(static_cast<std::int32_t>(n << 16));
}

/// A gain of magnitude at most 2^-least, of either sign. Its mantissa is never the most negative number
/// (fixed.hpp).
template <class Scalar>
constexpr Gain<Scalar> gain(Random& random, std::int8_t least, std::uint8_t spread = 8) {
  const auto m = static_cast<std::int16_t>(random.bits() & 0x7fff);
  const bool negative = random.one_in(4);
  const auto right = static_cast<std::int8_t>(15 + least + random.below(spread));
  return Number<Scalar>::gain(static_cast<std::int16_t>(negative ? -m : m), right);
}
template <class Scalar>
constexpr Gain<Scalar> positive_gain(Random& random, std::int8_t least, std::uint8_t spread = 8) {
  const auto m = static_cast<std::int16_t>(random.bits() & 0x7fff);
  return Number<Scalar>::gain(m, static_cast<std::int8_t>(15 + least + random.below(spread)));
}

template <class Scalar>
inline constexpr int fraction_digits = 0;
template <class Storage, int FractionBits>
inline constexpr int fraction_digits<Fixed<Storage, FractionBits>> = FractionBits;

/// A gain of n/2^26 of the range per count. In fixed point, the gain is for the raw digits of the signal.
template <class Scalar>
constexpr Gain<Scalar> per_count(std::int16_t n) {
  return Number<Scalar>::gain(n, static_cast<std::int8_t>(26 - fraction_digits<Scalar>));
}

/// `size` times the sine of a binary angle, in counts, by Bhaskara's formula: 16 x (pi - x)/(5 pi^2 - 4 x (pi
/// - x)).
constexpr std::int32_t wave(std::uint32_t at, std::int32_t size) {
  const std::int32_t x = static_cast<std::int32_t>((at & 0x7fffffffu) >> 19);  // 4096 is half a turn
  const std::int32_t p = x * (4096 - x);
  const std::int32_t y = (16 * (p / 64)) * 64 / ((5 * 16777216 - 4 * p) / 1024);  // 1024 is 1
  const std::int32_t counts = y * size / 1024;
  return at < 0x80000000u ? counts : -counts;
}

}  // namespace target

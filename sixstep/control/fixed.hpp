// SPDX-License-Identifier: Apache-2.0
// Fixed-point numbers for chips without a floating-point unit. Fixed<std::int16_t, 15> is Q15: its raw
// integer n means n/2^15. The storage has 16 or 32 bits, and any number of fraction bits below this width.
//
// Rounding: every product, quotient and conversion is the exact result rounded to the nearest representable
// number, ties away from zero. Therefore (-a) b = -(a b), and a drive behaves alike in both directions of
// rotation.
//
// Saturation: a result beyond the range becomes the nearer limit of the range; no result wraps. x/0 saturates
// in the direction of x, and 0/0 is 0. Sums and differences are exact unless they saturate.
// tests/control/fixed_test.cpp compares all pairs of an 8-bit format, and random pairs of wider formats,
// with exact arithmetic.
//
// The arithmetic is correct also where int has 16 bits. Every operand is converted to a wider type of
// explicit size before use, because `1 << 15` is negative for a 16-bit int. Only unsigned numbers are
// shifted.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed_arithmetic.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

template <class Storage_, int FractionBits>
struct Fixed {
  using Storage = Storage_;
  using WideInt = typename detail::Widths<Storage>::Wide;
  static constexpr int fraction_bits = FractionBits;
  static_assert(FractionBits > 0 && FractionBits < detail::Widths<Storage>::bits);
#if defined(__AVR__) && defined(__clang__) && !defined(SIXSTEP_ANY_COMPILER)
  static_assert(
      sizeof(Storage) == 2,
      "clang 19 passes structs of 32-bit formats wrongly on the AVR where a call is not inlined; use q15 or q14, or define SIXSTEP_ANY_COMPILER after a test on the chip has confirmed this drive's bits");
#endif

  Storage raw = 0;  ///< the number times 2^FractionBits

  constexpr Fixed() = default;
  /// The nearest representable number; 0 if x is NaN. Use it for constants and on the host: on a chip without
  /// a floating-point unit a conversion at run time would link a library. Where double has 32 bits (AVR), a
  /// 32-bit format would have only 24 correct bits: use from_raw() for constants on such a chip.
  explicit constexpr Fixed(double x)
      : raw(detail::nearest<Storage>(x * static_cast<double>(detail::two_to<std::int64_t>(FractionBits)))) {}
  static constexpr Fixed from_raw(Storage raw) {
    Fixed x;
    x.raw = raw;
    return x;
  }
  static constexpr Fixed max() { return from_raw(detail::greatest<Storage>); }
  static constexpr Fixed min() { return from_raw(detail::least<Storage>); }
  explicit constexpr operator double() const {
    return static_cast<double>(raw) / static_cast<double>(detail::two_to<std::int64_t>(FractionBits));
  }

  friend constexpr Fixed operator+(Fixed a, Fixed b) { return fit(wide(a) + wide(b)); }
  friend constexpr Fixed operator-(Fixed a, Fixed b) { return fit(wide(a) - wide(b)); }
  friend constexpr Fixed operator-(Fixed a) { return fit(-wide(a)); }
  friend constexpr Fixed operator*(Fixed a, Fixed b) {
    return fit(detail::shifted_down(static_cast<WideInt>(wide(a) * wide(b)), FractionBits));
  }
  friend constexpr Fixed operator/(Fixed a, Fixed b) {
    if (b.raw == 0) return a.raw > 0 ? max() : a.raw < 0 ? min() : Fixed{};
    const WideInt scaled = static_cast<WideInt>(wide(a) * detail::two_to<WideInt>(FractionBits));
    return fit(detail::divided(scaled, wide(b)));
  }
  friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw == b.raw; }
  friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw < b.raw; }
  friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw > b.raw; }
  friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw <= b.raw; }
  friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw >= b.raw; }

 private:
  static constexpr WideInt wide(Fixed x) { return static_cast<WideInt>(x.raw); }
  template <class Int>
  static constexpr Fixed fit(Int x) {
    return from_raw(detail::saturated<Storage>(x));
  }
};

using Q15 = Fixed<std::int16_t, 15>;
using Q31 = Fixed<std::int32_t, 31>;
/// Formats with one fraction bit less. They contain the number 1, which a full duty needs.
using Q14 = Fixed<std::int16_t, 14>;
using Q30 = Fixed<std::int32_t, 30>;

/// A factor between two signals of one format: mantissa/2^right. Its range is 2^-30 (16 bits) or 2^-62 (32
/// bits) to the storage's largest number. The constructor rounds to the nearest number of this form. The
/// relative error is at most 2^-15 or 2^-31 while `right` is below its limit.
template <class Storage>
struct FixedGain {
  Storage mantissa = 0;
  std::int8_t right = 0;
  static constexpr int most_right = 2 * (detail::Widths<Storage>::bits - 1);

  constexpr FixedGain() = default;
  explicit constexpr FixedGain(double gain) {
    constexpr double end = static_cast<double>(detail::greatest<Storage>);
    double m = gain;
    while (m != 0 && right < most_right && 2 * m <= end && 2 * m >= -end) {
      m *= 2;
      ++right;
    }
    mantissa = detail::nearest<Storage>(m < -end ? -end : m);
  }
  /// The gain with these raw numbers. Exported drives use this function, because its bits are the same with
  /// every compiler, also where double has 32 bits.
  static constexpr FixedGain from_raw(Storage mantissa, std::int8_t right) {
    FixedGain gain;
    gain.mantissa = mantissa;
    gain.right = right;
    return gain;
  }
  explicit constexpr operator double() const {
    return static_cast<double>(mantissa) / static_cast<double>(detail::two_to<std::int64_t>(right));
  }
  constexpr bool operator==(const FixedGain&) const = default;
};

/// Division by a constant, computed as a multiplication by its reciprocal. Default: the quotient is 0.
template <class Storage>
struct FixedDivisor {
  FixedGain<Storage> reciprocal{};

  constexpr FixedDivisor() = default;
  explicit constexpr FixedDivisor(double divisor) : reciprocal(divisor == 0 ? 0.0 : 1 / divisor) {}
  static constexpr FixedDivisor from_reciprocal(FixedGain<Storage> reciprocal) {
    FixedDivisor divisor;
    divisor.reciprocal = reciprocal;
    return divisor;
  }
  friend constexpr bool operator>(const FixedDivisor& d, const FixedDivisor& than) {
    return d.reciprocal.mantissa > than.reciprocal.mantissa;  // only tests whether a divisor is positive
  }
};

/// A running sum of signals. Its last bit is 2^-12 (16 bits) or 2^-28 (32 bits) of a signal's last bit. Its
/// range is 16 times the range of a signal.
template <class Format>
struct FixedSum {
  using Raw = typename Format::WideInt;
  static constexpr int guard_bits = detail::Widths<typename Format::Storage>::bits - 4;

  Raw raw = 0;

  constexpr FixedSum() = default;
  explicit constexpr FixedSum(double x)
      : raw(detail::nearest<Raw>(x *
                                 static_cast<double>(detail::two_to<std::int64_t>(Format::fraction_bits)) *
                                 static_cast<double>(detail::two_to<std::int64_t>(guard_bits)))) {}
  static constexpr FixedSum from_raw(Raw raw) {
    FixedSum x;
    x.raw = raw;
    return x;
  }
  friend constexpr FixedSum operator+(FixedSum a, FixedSum b) {
    return from_raw(detail::sum_saturated(a.raw, b.raw));
  }
  friend constexpr FixedSum operator-(FixedSum a) {
    return from_raw(a.raw == detail::least<Raw> ? detail::greatest<Raw> : static_cast<Raw>(-a.raw));
  }
  friend constexpr FixedSum operator-(FixedSum a, FixedSum b) { return a + -b; }
  friend constexpr bool operator==(FixedSum a, FixedSum b) { return a.raw == b.raw; }
  friend constexpr bool operator<(FixedSum a, FixedSum b) { return a.raw < b.raw; }
  friend constexpr bool operator>(FixedSum a, FixedSum b) { return a.raw > b.raw; }
};

/// A product of a signal and timer counts.
template <class Format>
struct FixedTickRatio {
  typename Format::WideInt raw = 0;

  constexpr FixedTickRatio() = default;
  static constexpr FixedTickRatio from_raw(typename Format::WideInt raw) {
    FixedTickRatio ratio;
    ratio.raw = raw;
    return ratio;
  }
  explicit constexpr FixedTickRatio(double signal_times_ticks)
      : raw(detail::nearest<typename Format::WideInt>(
            signal_times_ticks * static_cast<double>(detail::two_to<std::int64_t>(Format::fraction_bits)))) {}
};

template <class Storage, int FractionBits>
struct ScalarTraits<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;
  using Gain = FixedGain<Storage>;
  using Divisor = FixedDivisor<Storage>;
  using Accumulator = FixedSum<Scalar>;
  using TickRatio = FixedTickRatio<Scalar>;
  using Wide = typename Scalar::WideInt;
  using UnsignedStorage = detail::UnsignedOf<Storage>;

  static constexpr Wide wide(Scalar x) { return static_cast<Wide>(x.raw); }
  static constexpr Scalar narrow(Wide x) { return Scalar::from_raw(detail::saturated<Storage>(x)); }
  static constexpr Scalar half_difference(Scalar a, Scalar b) {
    return narrow(detail::shifted_down(static_cast<Wide>(wide(a) - wide(b)), 1));
  }
  static constexpr Scalar product(Scalar x, Gain gain) {
    const auto p = detail::product<Storage>(wide(x), gain.mantissa);
    return Scalar::from_raw(
        detail::narrow_with_sign<Storage>(detail::magnitude_down(p.size, gain.right), p.negative));
  }
  static constexpr Scalar quotient(Scalar x, Divisor divisor) { return product(x, divisor.reciprocal); }
  /// `difference` may be a difference of two signals, which has one bit more than a signal. The product still
  /// fits into Wide, because a mantissa is never the least number of its storage.
  static constexpr Accumulator accumulated(Wide difference, Gain gain) {
    const auto p = detail::product<Storage>(difference, gain.mantissa);
    return accumulated(p.size, p.negative, gain.right);
  }
  static constexpr Accumulator accumulated(Scalar x, Gain gain) { return accumulated(wide(x), gain); }
  /// The increment of a sum, from the size and sign of a product.
  static constexpr Accumulator accumulated(detail::UnsignedOf<Wide> size, bool negative, int right) {
    const int down = right - Accumulator::guard_bits;
    return Accumulator::from_raw(down >= 0 ? detail::with_sign(detail::magnitude_down(size, down), negative)
                                           : detail::magnitude_up<Wide>(size, negative, -down));
  }
  static constexpr Accumulator accumulator(Scalar x) {
    return Accumulator::from_raw(static_cast<Wide>(wide(x) * detail::two_to<Wide>(Accumulator::guard_bits)));
  }
  static constexpr Scalar signal(Accumulator sum) {
    return narrow(detail::shifted_down(sum.raw, Accumulator::guard_bits));
  }
  /// The fraction `part`, 0..1, of a sum. The error is at most one digit of the signal, or eight digits if
  /// the sum exceeds twice the signal's range.
  static constexpr Accumulator share(Accumulator sum, Gain part) {
    constexpr Wide end = static_cast<Wide>(detail::two_to<Wide>(detail::Widths<Storage>::bits) - 1);
    const Wide digits = detail::shifted_down(sum.raw, Accumulator::guard_bits);
    if (digits <= end && digits >= -end) return accumulated(digits, part);
    // After the shift, the greatest sum is one more than the largest difference of two signals, due to
    // rounding. Therefore accumulated(Wide, Gain) does not suit.
    const Wide p = static_cast<Wide>(detail::shifted_down(sum.raw, Accumulator::guard_bits + 3) *
                                     static_cast<Wide>(part.mantissa));
    const Accumulator eighth = accumulated(detail::absolute(p), p < 0, part.right);
    return Accumulator::from_raw(detail::shifted_up(eighth.raw, 3));
  }
  static constexpr TickRatio times(TickRatio ratio, std::uint8_t n) {
    TickRatio sum{};
    for (std::uint8_t k = 0; k < n; ++k) sum.raw = detail::sum_saturated(sum.raw, ratio.raw);
    return sum;
  }
  static constexpr Scalar per_ticks(TickRatio ratio, std::uint32_t ticks) {
    if (ticks == 0) return ratio.raw > 0 ? Scalar::max() : ratio.raw < 0 ? Scalar::min() : Scalar{};
    using Unsigned = typename detail::Widths<Storage>::UnsignedWide;
    const Unsigned q = detail::divided_unsigned(detail::absolute(ratio.raw), static_cast<Unsigned>(ticks));
    return narrow(detail::with_sign(q, ratio.raw < 0));
  }
  /// part/whole, computed bit by bit. This uses all 32 bits of the counts and is faster than a 64-bit
  /// division.
  static constexpr Scalar fraction(std::uint32_t part, std::uint32_t whole) {
    if (part >= whole) return one<Scalar>;
    UnsignedStorage q = 0;
    for (int n = 0; n < FractionBits; ++n) {
      const bool one_more =
          part >= static_cast<std::uint32_t>(whole - part);  // 2 part >= whole, without an overflow of 2 part
      part = one_more ? static_cast<std::uint32_t>(part - (whole - part))
                      : static_cast<std::uint32_t>(part + part);
      q = static_cast<UnsignedStorage>(static_cast<UnsignedStorage>(q << 1) | (one_more ? 1u : 0u));
    }
    if (part >= static_cast<std::uint32_t>(whole - part)) ++q;
    return narrow(static_cast<Wide>(q));
  }
  static constexpr Scalar counts(std::int32_t n, Gain per_count) {
    return product(Scalar::from_raw(detail::saturated<Storage>(n)), per_count);
  }
};

}  // namespace sixstep::control

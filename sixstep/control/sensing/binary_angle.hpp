// SPDX-License-Identifier: Apache-2.0
// Represents angles as integers in units of 2^-32 turn. Sums wrap exactly at a full turn. The difference of
// two angles, as a signed integer, is the shorter rotation. Every core computes the same bits. One unit is
// 8.4e-8 degrees. Names distinguish electrical from mechanical angles. The mechanical angle times the pole
// pairs, with wrapping, is the electrical angle.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

using BinaryAngle = std::uint32_t;

inline constexpr BinaryAngle quarter_turn = 0x40000000u, half_turn = 0x80000000u;

/// The shorter rotation from one angle to another, -2^31 to 2^31 - 1. For half a turn the result is negative.
constexpr std::int32_t way_between(BinaryAngle from, BinaryAngle to) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(to - from));
}

/// Electrical angle: mechanical angle times pole pairs, plus offset (model.md 1).
constexpr BinaryAngle electrical_angle(BinaryAngle mechanical, std::uint8_t pole_pairs,
                                       BinaryAngle offset = 0) {
  return static_cast<BinaryAngle>(mechanical * pole_pairs + offset);
}

/// An angle in degrees as a binary angle, |degrees| below 2^22. Use it for constants and on the host. The
/// result is rounded to nearest where double has 64 bits. Where double has 32 bits (AVR), the relative error
/// is up to 2^-24.
constexpr BinaryAngle binary_degrees(double degrees) {
  const double turns = degrees / 360.0;
  const auto whole = static_cast<std::int32_t>(turns);
  double rest = turns - static_cast<double>(whole);
  if (rest < 0) rest += 1.0;
  return static_cast<BinaryAngle>(
      static_cast<std::uint64_t>(detail::nearest<std::int64_t>(rest * 4294967296.0)));
}

/// Begin of electrical sector n = 0..5: the least integer angle that is at least 60 n degrees (model.md 3).
constexpr BinaryAngle sector_angle(std::uint8_t n) {
  constexpr BinaryAngle begins[6] = {0u, 715827883u, 1431655766u, 2147483648u, 2863311531u, 3579139414u};
  return begins[n % 6];
}

/// The sector [60 n, 60 n + 60) degrees that contains an electrical angle. It is found by comparisons,
/// without rounding.
constexpr std::uint8_t sector_of_angle(BinaryAngle electrical) {
  const bool upper = electrical >= half_turn;
  const BinaryAngle rest = upper ? electrical - half_turn : electrical;
  const std::uint8_t third = rest >= sector_angle(2) ? 2 : rest >= sector_angle(1) ? 1 : 0;
  return upper ? static_cast<std::uint8_t>(third + 3) : third;
}

/// An angle rounded down to the resolution of a converter with 1..32 bits.
constexpr BinaryAngle quantised(BinaryAngle angle, std::uint8_t bits) {
  const std::uint8_t drop = bits >= 32 || bits == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(32 - bits);
  return (angle >> drop) << drop;
}

/// Number of whole turns, and the angle within the present turn. Together they do not wrap.
struct UnwrappedAngle {
  BinaryAngle angle = 0;
  std::int32_t turns = 0;
  bool operator==(const UnwrappedAngle&) const = default;
};

/// Sets a new angle, reached by the shorter rotation, and counts whole turns.
constexpr void unwrap(UnwrappedAngle& state, BinaryAngle angle) {
  const std::int32_t way = way_between(state.angle, angle);
  if (way >= 0 && angle < state.angle) ++state.turns;
  if (way < 0 && angle > state.angle) --state.turns;
  state.angle = angle;
}

namespace detail {

/// Number of bits of x, computed by halving the width. Compilers would convert a loop over the bits to a
/// library call on processors without an instruction that counts zeros.
constexpr std::uint8_t bit_width(std::uint32_t x) {
  std::uint8_t bits = 0;
  for (std::uint8_t half = 16; half != 0; half = static_cast<std::uint8_t>(half >> 1)) {
    if ((x >> half) == 0) continue;
    x >>= half;
    bits = static_cast<std::uint8_t>(bits + half);
  }
  return static_cast<std::uint8_t>(bits + x);
}

}  // namespace detail

/// Factor for a turn of `whole` parts. With this factor, angle_of_parts() multiplies instead of dividing. The
/// error is at most 2 units plus rounding.
struct TurnParts {
  std::uint32_t mantissa = 0;  ///< 2^(30+n)/whole, with n the number of bits of `whole`; exact if `whole` is
                               ///< a power of two
  std::uint8_t right = 0;      ///< n - 2
  bool operator==(const TurnParts&) const = default;
};

/// The factor for a turn of `whole` parts; 0 for fewer than two parts. The function needs a 64-bit division:
/// call it at most once per Hall edge, or at compile time.
constexpr TurnParts turn_in_parts(std::uint32_t whole) {
  if (whole < 2) return {};
  const std::uint8_t bits = detail::bit_width(whole);
  const std::uint64_t scaled = std::uint64_t{1} << (30 + bits);
  return {static_cast<std::uint32_t>((scaled + whole / 2) / whole), static_cast<std::uint8_t>(bits - 2)};
}

/// The angle of `part` parts of the turn; angles above one turn wrap.
constexpr BinaryAngle angle_of_parts(const TurnParts& turn, std::uint32_t part) {
  const std::uint64_t product = static_cast<std::uint64_t>(part) * turn.mantissa;
  if (turn.right == 0) return static_cast<BinaryAngle>(product);
  return static_cast<BinaryAngle>(((product >> (turn.right - 1)) + 1) >> 1);
}

/// Functions that a decoder requires of its scalar, in addition to ScalarTraits. This version is for floating
/// point.
template <class Scalar>
struct AngleTraits {
  /// mantissa/2^right, with a mantissa of 31 bits. The constant has the same bits where double has 32 bits.
  static constexpr Gain<Scalar> constant(std::int32_t mantissa, std::int8_t right) {
    return static_cast<Scalar>(static_cast<double>(mantissa) /
                               static_cast<double>(detail::two_to<std::int64_t>(right)));
  }
  /// A signed angle as a fraction of half a turn, -1..1.
  static constexpr Scalar half_turns(std::int32_t angle) {
    return static_cast<Scalar>(angle) * static_cast<Scalar>(0x1p-31);
  }
  /// x times `per_unit` as a signal, for a signed integer x of up to 32 bits. Fixed point: `per_unit` is in
  /// raw signal digits per unit of x.
  static constexpr Scalar scaled(std::int32_t x, Gain<Scalar> per_unit) {
    return static_cast<Scalar>(x) * per_unit;
  }
  /// n times a product of a signal and timer counts.
  static constexpr TickRatio<Scalar> counted(TickRatio<Scalar> ratio, std::uint32_t n) {
    return ratio * static_cast<Scalar>(n);
  }
  /// x as an integer with 31 fraction bits: -1..1, saturated, rounded towards 0.
  static constexpr std::int32_t bits_31(Scalar x) {
    if (x >= Scalar(1)) return detail::greatest<std::int32_t>;
    if (x <= Scalar(-1)) return -detail::greatest<std::int32_t>;
    return static_cast<std::int32_t>(x * static_cast<Scalar>(2147483648.0));
  }
};

template <class Storage, int FractionBits>
struct AngleTraits<Fixed<Storage, FractionBits>> {
  using Scalar = Fixed<Storage, FractionBits>;

  static constexpr Gain<Scalar> constant(std::int32_t mantissa, std::int8_t right) {
    constexpr std::int8_t drop = 32 - detail::Widths<Storage>::bits;
    return Gain<Scalar>::from_raw(detail::saturated<Storage>(detail::shifted_down(mantissa, drop)),
                                  static_cast<std::int8_t>(right - drop));
  }
  static constexpr Scalar half_turns(std::int32_t angle) {
    return Scalar::from_raw(detail::saturated<Storage>(detail::shifted_down(angle, 31 - FractionBits)));
  }
  /// Uses as many leading bits of x as a signal has. In 16-bit formats the relative error is up to 2^-15;
  /// 32-bit formats use all bits.
  static constexpr Scalar scaled(std::int32_t x, Gain<Scalar> per_unit) {
    const std::uint32_t whole = detail::absolute(x);
    constexpr int kept = detail::Widths<Storage>::bits - 1;
    const int bits = detail::bit_width(whole), left = bits > kept ? bits - kept : 0;
    const std::uint32_t size = detail::magnitude_down(whole, left);
    using Wide = typename Scalar::WideInt;
    const Wide part = x < 0 ? static_cast<Wide>(-static_cast<Wide>(size)) : static_cast<Wide>(size);
    const auto p = detail::product<Storage>(part, per_unit.mantissa);
    const int down = per_unit.right - left;
    return ScalarTraits<Scalar>::narrow(
        down >= 0 ? detail::with_sign(detail::magnitude_down(p.size, down), p.negative)
                  : detail::magnitude_up<Wide>(p.size, p.negative, -down));
  }
  /// Multiplies by additions, one per bit of n, because a 64-bit product with an overflow check would need a
  /// library function.
  static constexpr TickRatio<Scalar> counted(TickRatio<Scalar> ratio, std::uint32_t n) {
    TickRatio<Scalar> sum{};
    for (; n != 0; n >>= 1) {
      if ((n & 1u) != 0) sum.raw = detail::sum_saturated(sum.raw, ratio.raw);
      ratio.raw = detail::sum_saturated(ratio.raw, ratio.raw);
    }
    return sum;
  }
  static constexpr std::int32_t bits_31(Scalar x) {
    const std::int32_t bits = detail::shifted_up(static_cast<std::int32_t>(x.raw), 31 - FractionBits);
    return bits == detail::least<std::int32_t> ? -detail::greatest<std::int32_t> : bits;
  }
};

/// A signed angle as a signal. `per_half_turn`: signal of half a turn, 180 degrees divided by the base of
/// positions.
template <class Scalar>
constexpr Scalar angle_signal(std::int32_t angle, Gain<Scalar> per_half_turn) {
  return ScalarTraits<Scalar>::product(AngleTraits<Scalar>::half_turns(angle), per_half_turn);
}

/// An angle of -1..1 rad as a signed binary angle: 1 rad is 2^32/(2 pi) units.
template <class Scalar>
constexpr std::int32_t angle_of_rad(Scalar rad) {
  constexpr std::int32_t by_pi = 1367130551;  // 2^32/pi
  const auto p = detail::product<std::int32_t>(AngleTraits<Scalar>::bits_31(rad), by_pi);
  return detail::narrow_with_sign<std::int32_t>(detail::magnitude_down(p.size, 32), p.negative);
}

}  // namespace sixstep::control

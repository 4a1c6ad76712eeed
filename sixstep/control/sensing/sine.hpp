// SPDX-License-Identifier: Apache-2.0
// Computes cosine and sine of a binary angle, from a table of 65 entries over a quarter turn and an expansion
// about the nearest entry:
//
//   sin(a + d) = sin a + d cos a - d^2/2 sin a,   cos(a + d) = cos a - d sin a - d^2/2 cos a,   |d| <= pi/256
//
// The next term is at most (pi/256)^3/6 = 3.1e-7. In double the error is this term plus 1e-9 from the table.
// In fixed point of 16 bits rounding adds two digits. The table is computed in integers at compile time and
// has the same bits on every core. With 16-bit entries it needs 130 bytes.
#pragma once
#include <cstdint>

#include "sixstep/control/frames.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

namespace detail {

/// sin(n pi/128) 2^30 for n = 0..64, by Taylor's polynomial of degree 15 in units of 2^-31, with an error of
/// at most one unit.
constexpr std::int32_t sine_entry(std::uint8_t n) {
  constexpr std::uint64_t pi_31 = 6746518852u;  // pi 2^31
  const std::uint64_t x = (n * pi_31 + 64) / 128, x2 = (x * x) >> 31, one_31 = std::uint64_t{1} << 31;
  std::uint64_t y = one_31;
  for (std::uint8_t k = 14; k >= 2; k = static_cast<std::uint8_t>(k - 2))
    y = one_31 - ((x2 * y) >> 31) / (static_cast<std::uint64_t>(k) * (k + 1u));
  return static_cast<std::int32_t>((((x * y) >> 31) + 1) >> 1);
}

template <class Scalar>
struct SineTable {
  Scalar entry[65]{};
  constexpr SineTable() {
    // 2^31 does not fit into a signed number. shifted_up() saturates to 2^31 - 1, which rounds to 1 in every
    // format that contains 1.
    for (std::uint8_t n = 0; n < 65; ++n)
      entry[n] = AngleTraits<Scalar>::half_turns(shifted_up(sine_entry(n), 1));
  }
};

template <class Scalar>
inline constexpr SineTable<Scalar> sine_table{};

}  // namespace detail

template <class Scalar>
constexpr Direction<Scalar> direction_of(BinaryAngle angle) {
  using T = ScalarTraits<Scalar>;
  constexpr auto step = AngleTraits<Scalar>::constant(1686629713, 37);         // pi/256
  constexpr auto half_square = AngleTraits<Scalar>::constant(1324675879, 44);  // (pi/256)^2/2
  const BinaryAngle in_quarter = angle & 0x3fffffffu;
  const BinaryAngle nearest = (in_quarter + 0x00800000u) >> 24;
  // d/(pi/256), -1..1
  const Scalar u =
      AngleTraits<Scalar>::half_turns(static_cast<std::int32_t>((in_quarter - (nearest << 24)) << 8));
  const Scalar s = detail::sine_table<Scalar>.entry[nearest];
  const Scalar c = detail::sine_table<Scalar>.entry[64 - nearest];
  const Scalar shrunk = T::product(u * u, half_square);
  const Scalar sine = s + T::product(c * u, step) - s * shrunk;
  const Scalar cosine = c - T::product(s * u, step) - c * shrunk;
  switch (angle >> 30) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace sixstep::control

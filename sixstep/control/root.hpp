// SPDX-License-Identifier: Apache-2.0
// Computes square roots without a library, and two functions that use them:
//
//   vector_length   sqrt(a^2 + b^2)
//   circle_rest     sqrt(r^2 - x^2): second component of a vector of length r with the first component x; 0
//                   if |x| is above r
//
// Floating point uses Newton's iteration y <- (y + x/y)/2, which starts above the root and falls until it
// converges. It needs only + - * /. Every core therefore computes the same bits, with an error of at most two
// last digits. Fixed point computes the integer part of the root of an integer, bit by bit, with an error
// below one digit. The result of circle_rest is never outside of the circle.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The integer part of a square root, bit by bit.
template <class Unsigned>
constexpr Unsigned whole_root(Unsigned x) {
  Unsigned found = 0;
  for (auto bit = static_cast<Unsigned>(Unsigned{1} << (8 * sizeof(Unsigned) - 2)); bit != 0;
       bit = static_cast<Unsigned>(bit >> 2)) {
    if (x >= static_cast<Unsigned>(found + bit)) {
      x = static_cast<Unsigned>(x - (found + bit));
      found = static_cast<Unsigned>((found >> 1) + bit);
    } else {
      found = static_cast<Unsigned>(found >> 1);
    }
  }
  return found;
}

/// Square root of x; 0 if x is not above 0, is infinite or NaN.
template <class Scalar>
constexpr Scalar root(Scalar x) {
  constexpr Scalar quarter(0.25), half(0.5), four(4);
  if (!(x > Scalar{}) || x - x != Scalar{}) return Scalar{};
  Scalar scale(1);
  for (; x >= Scalar(1); x *= quarter) scale *= Scalar(2);
  for (; x < quarter; x *= four) scale *= half;
  Scalar y = half + half * x;
  for (Scalar next = half * (y + x / y); next < y; next = half * (y + x / y)) y = next;
  return scale * y;
}

template <class Scalar>
constexpr Scalar vector_length(Scalar a, Scalar b) {
  return root(a * a + b * b);
}
template <class Storage, int FractionBits>
constexpr Fixed<Storage, FractionBits> vector_length(Fixed<Storage, FractionBits> a,
                                                     Fixed<Storage, FractionBits> b) {
  using UnsignedWide = typename detail::Widths<Storage>::UnsignedWide;
  const auto square = [](Storage raw) {
    const auto size = static_cast<UnsignedWide>(detail::absolute(raw));
    return static_cast<UnsignedWide>(size * size);
  };
  // In the 16-bit formats a square is at most 2^30. The sum of two squares is at most 2^31, which fits into
  // an unsigned number.
  const UnsignedWide length = whole_root(static_cast<UnsignedWide>(square(a.raw) + square(b.raw)));
  constexpr auto end = static_cast<UnsignedWide>(detail::greatest<Storage>);
  return Fixed<Storage, FractionBits>::from_raw(static_cast<Storage>(length < end ? length : end));
}

/// Second component of a vector of length `radius` with the first component x. 0 if |x| is above the radius,
/// or the radius is below 0.
template <class Scalar>
constexpr Scalar circle_rest(Scalar radius, Scalar x) {
  const Scalar size = magnitude(x);
  return size < radius ? root((radius - size) * (radius + size)) : Scalar{};
}
template <class Storage, int FractionBits>
constexpr Fixed<Storage, FractionBits> circle_rest(Fixed<Storage, FractionBits> radius,
                                                   Fixed<Storage, FractionBits> x) {
  using UnsignedWide = typename detail::Widths<Storage>::UnsignedWide;
  const auto size = static_cast<UnsignedWide>(detail::absolute(x.raw));
  if (radius.raw <= 0 || size >= static_cast<UnsignedWide>(radius.raw)) return {};
  const auto whole = static_cast<UnsignedWide>(radius.raw);
  const UnsignedWide rest = whole_root(static_cast<UnsignedWide>((whole - size) * (whole + size)));
  return Fixed<Storage, FractionBits>::from_raw(static_cast<Storage>(rest));
}

}  // namespace sixstep::control

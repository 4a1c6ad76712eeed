// SPDX-License-Identifier: Apache-2.0
// Square roots without a library, and the two that a vector asks for:
//
//   vector_length   sqrt(a^2 + b^2)
//   circle_rest     sqrt(r^2 - x^2): what a circle of radius r leaves to the other axis; 0 where x has left it
//
// Floating point by Newton's y <- (y + x/y)/2 from above, which falls until it is there: + - * / alone, so that every
// core has the same bits, to a digit or two of the root. Fixed point takes the whole part of the root of whole
// numbers, bit by bit: to a digit, and never above the circle.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The whole part of a square root, bit by bit.
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

/// Of what is not above 0, and of no number: 0.
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
  // Two squares of 2^30 are 2^31: they fit where nothing has a sign.
  const UnsignedWide length = whole_root(static_cast<UnsignedWide>(square(a.raw) + square(b.raw)));
  constexpr auto end = static_cast<UnsignedWide>(detail::greatest<Storage>);
  return Fixed<Storage, FractionBits>::from_raw(static_cast<Storage>(length < end ? length : end));
}

/// Of a radius below 0 nothing is left.
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

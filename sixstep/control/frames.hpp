// SPDX-License-Identifier: Apache-2.0
// Transforms three phase quantities to one vector, in the stator's frame and in the rotor's frame (model.md
// 11). The transform preserves amplitudes: balanced phase quantities of peak 1 become a vector of length 1.
//
//   x_alpha = (2 x_a - x_b - x_c)/3         x_d =  x_alpha cos + x_beta sin
//   x_beta  = (x_b - x_c)/sqrt 3            x_q = -x_alpha sin + x_beta cos
//
// The d axis is the magnet's axis, at theta_d = theta_e - 150 degrees. Each frame is a type with its own
// member names, so that the compiler rejects a phase quantity where an axis quantity is needed. In fixed
// point, results saturate.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

template <class Scalar>
struct Abc {
  Scalar a{}, b{}, c{};
  bool operator==(const Abc&) const = default;
};

template <class Scalar>
struct AlphaBeta {
  Scalar alpha{}, beta{};
  bool operator==(const AlphaBeta&) const = default;
};

template <class Scalar>
struct Dq {
  Scalar d{}, q{};
  bool operator==(const Dq&) const = default;
};

/// An angle as its cosine and sine. The firmware computes both from a table or by a recurrence.
template <class Scalar>
struct Direction {
  Scalar cos = one<Scalar>, sin{};
};

/// The vector of three phase quantities. It is computed from half differences, because these fit every
/// format. A part that is common to the three phases cancels.
template <class Scalar>
constexpr AlphaBeta<Scalar> clarke(const Abc<Scalar>& x) {
  using Traits = ScalarTraits<Scalar>;
  constexpr auto two_thirds = static_cast<Gain<Scalar>>(2.0 / 3.0);
  constexpr auto two_by_root3 = static_cast<Gain<Scalar>>(1.1547005383792515);
  return {Traits::product(Traits::half_difference(x.a, x.b), two_thirds) +
              Traits::product(Traits::half_difference(x.a, x.c), two_thirds),
          Traits::product(Traits::half_difference(x.b, x.c), two_by_root3)};
}

/// The three phase quantities of a vector; their sum is zero.
template <class Scalar>
constexpr Abc<Scalar> inverse_clarke(const AlphaBeta<Scalar>& x) {
  using Traits = ScalarTraits<Scalar>;
  constexpr auto half = static_cast<Gain<Scalar>>(0.5);
  constexpr auto half_root3 = static_cast<Gain<Scalar>>(0.8660254037844386);
  const Scalar along = Traits::product(x.alpha, half), across = Traits::product(x.beta, half_root3);
  return {x.alpha, across - along, -across - along};
}

template <class Scalar>
constexpr Dq<Scalar> park(const AlphaBeta<Scalar>& x, const Direction<Scalar>& d_axis) {
  return {x.alpha * d_axis.cos + x.beta * d_axis.sin, x.beta * d_axis.cos - x.alpha * d_axis.sin};
}

template <class Scalar>
constexpr AlphaBeta<Scalar> inverse_park(const Dq<Scalar>& x, const Direction<Scalar>& d_axis) {
  return {x.d * d_axis.cos - x.q * d_axis.sin, x.d * d_axis.sin + x.q * d_axis.cos};
}

}  // namespace sixstep::control

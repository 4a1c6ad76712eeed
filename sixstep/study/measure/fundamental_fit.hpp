// SPDX-License-Identifier: Apache-2.0
// FundamentalFit is a least-squares fit of 1, cos and sin to a signal that passes part by part, and what it leaves.
//
// It sums the normal equations, and of the signal not the square itself but the square of its distance from a
// reference, a fundamental that follows the fit: what is left is then no difference of large squares, and a pure
// sine leaves rounding and not its root. A new reference d away from the old one changes the sums by closed forms,
//   sum (r - d f)^2 = sum r^2 - 2 d . sum r f + d . (sum f f) d,
// so no part is seen twice. The reference is the fit itself whenever what was seen has doubled: a part then lies
// at most as far behind the fit as all before it, and is at most some ripples away from it.
//
// The functions are 1, sin p and 1 - cos p of the phase p since the begin. They span the same as 1, cos and sin,
// and their sums keep their digits over the first degrees as well, where 1 and cos are not to be told apart.
#pragma once
#include <array>

#include "sixstep/base/elementary.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::study {

/// sin p and 1 - cos p, the latter with all its digits where p is small.
struct Phase {
  double sin = 0.0, versine = 0.0;
};
Phase phase_of(double rad);

/// A part of the signal at the nodes of a Gauss rule. The turns are those since the part's begin, in rad and 1/2 at
/// most; the weights are of what is integrated over, which need not be the phase.
template <int points>
struct FittedPart {
  series::Nodes<points, double> weight, turn, signal;
};

class FundamentalFit {
 public:
  /// Parts follow upon each other; `begin` is where this one does.
  template <int points>
  void add(const Phase& begin, const FittedPart<points>& part);
  /// rms of the distortion over rms of the fundamental; NaN where the signal is zero.
  double distortion() const;

 private:
  using Three = std::array<double, 3>;
  /// Integrals of the functions' products, of the distance from the reference with each of them, and of its square.
  template <class Sum>
  struct Integrals {
    Sum one{}, s{}, v{}, ss{}, sv{}, vv{};
    std::array<Sum, 3> with{};
    Sum square{};
  };
  Three step_to_fit() const;
  void move_reference(const Three& by);
  void follow_fit() {
    move_reference(step_to_fit());
    fitted_at_ = sums_.one.value;
  }
  void pass_through(const std::array<Phase, 3>& at, const Three& distance);
  double distance(const Phase& p, double signal) const {
    return signal - reference_[0] - reference_[1] * p.sin - reference_[2] * p.versine;
  }

  template <int points>
  Integrals<double> integrals_of(const std::array<Phase, points>& at, const FittedPart<points>& part) const;
  void take(const Integrals<double>& of_part);

  Integrals<series::CompensatedSum<double>> sums_;  ///< over all that was seen
  Three reference_{};
  double fitted_at_ = 0.0;  ///< how much had been seen when the reference was last moved
};

namespace detail {

/// p at begin + turn: sums of products that keep their digits where both are small.
inline Phase turned(const Phase& begin, const Phase& turn) {
  const double cos = 1.0 - begin.versine;
  return {begin.sin - begin.sin * turn.versine + cos * turn.sin,
          begin.versine + cos * turn.versine + begin.sin * turn.sin};
}

/// As many terms as points: a rule of n points is taken for turns x with x^(2 n) below 2^-53 (2 n)!.
template <int terms>
inline Phase small_turn(double x) {
  const double square = x * x;
  double sin = 1.0, versine = 1.0;
#pragma GCC unroll 8
  for (int n = terms - 1; n >= 1; --n) {
    sin = 1.0 - sin * (square * (1.0 / ((2 * n) * (2 * n + 1))));
    versine = 1.0 - versine * (square * (1.0 / ((2 * n + 1) * (2 * n + 2))));
  }
  return {x * sin, square * 0.5 * versine};
}

}  // namespace detail

template <int points>
FundamentalFit::Integrals<double> FundamentalFit::integrals_of(const std::array<Phase, points>& at,
                                                               const FittedPart<points>& part) const {
  Integrals<double> sum;
#pragma GCC unroll 8
  for (int k = 0; k < points; ++k) {
    const double w = part.weight[k], ws = w * at[k].sin, wv = w * at[k].versine;
    const double r = distance(at[k], part.signal[k]), wr = w * r;
    sum.one += w;
    sum.s += ws;
    sum.v += wv;
    sum.ss += ws * at[k].sin;
    sum.sv += ws * at[k].versine;
    sum.vv += wv * at[k].versine;
    sum.with[0] += wr;
    sum.with[1] += wr * at[k].sin;
    sum.with[2] += wr * at[k].versine;
    sum.square += wr * r;
  }
  return sum;
}

template <int points>
void FundamentalFit::add(const Phase& begin, const FittedPart<points>& part) {
  std::array<Phase, points> at;
  double length = 0.0;
#pragma GCC unroll 8
  for (int k = 0; k < points; ++k) {
    at[k] = detail::turned(begin, detail::small_turn<points>(part.turn[k]));
    length += part.weight[k];
  }
  constexpr double far_more = 8.0;
  if (length > far_more * sums_.one.value) {
    const auto of = [&](int k) { return distance(at[k], part.signal[k]); };
    pass_through({at[0], at[points / 2], at[points - 1]}, {of(0), of(points / 2), of(points - 1)});
  }
  take(integrals_of<points>(at, part));
  if (sums_.one.value >= 2 * fitted_at_) follow_fit();
}

}  // namespace sixstep::study

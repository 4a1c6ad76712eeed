// SPDX-License-Identifier: Apache-2.0
// Fits 1, cos and sin to a signal by least squares, part by part, and computes the residual.
//
// The fit sums the normal equations. It also sums the squared distance of the signal from a reference, which
// is a fundamental close to the fit. So the residual is not a difference of large squares: for a pure sine it
// is of the order of 2^-53 of the signal, not of the square root of 2^-53. With the distance r from the
// reference, the functions f of the fit and a change d of the reference's coefficients, the sums change by
// closed forms,
//   sum (r - d f)^2 = sum r^2 - 2 d . sum r f + d . (sum f f) d,
// so that no part is read twice. The reference is set to the fit whenever the length so far has doubled. The
// reference is then extrapolated over at most the length over which it was fitted.
//
// The functions are 1, sin p and 1 - cos p of the phase p since the beginning. They span the same space as 1,
// cos and sin. Their sums keep their digits also over the first degrees, where 1 and cos are almost equal.
#pragma once
#include <array>

#include "sixstep/base/elementary.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::study {

/// sin p and 1 - cos p; 1 - cos p keeps all its digits if p is small.
struct Phase {
  double sin = 0.0, versine = 0.0;
};
Phase phase_of(double rad);

/// A part of the signal at the nodes of a Gauss rule. `turn` is in rad since the part's beginning, 1/2 at
/// most. Weights are for the variable of integration, which need not be the phase.
template <int points>
struct FittedPart {
  series::Nodes<points, double> weight, turn, signal;
};

class FundamentalFit {
 public:
  /// Adds a part; parts must be contiguous. `begin` is the phase at this part's beginning.
  template <int points>
  void add(const Phase& begin, const FittedPart<points>& part);
  /// Distortion: rms of the residual divided by rms of the fundamental; NaN if the signal is zero.
  double distortion() const;

 private:
  using Three = std::array<double, 3>;
  /// Integrals of products of 1, s = sin p, v = 1 - cos p and r, the distance from the reference.
  enum Product : int { one, s, v, ss, sv, vv, r, rs, rv, rr, products };
  using Integrals = series::Nodes<products, double>;
  template <int points>
  struct Phases {
    series::Nodes<points, double> sin, versine;
  };

  template <int points>
  static Phases<points> phases_of(const Phase& begin, const series::Nodes<points, double>& turn);
  template <int points>
  series::Nodes<points, double> distance(const Phases<points>& at,
                                         const series::Nodes<points, double>& signal) const {
    return signal - reference_[0] - reference_[1] * at.sin - reference_[2] * at.versine;
  }
  template <int points>
  static Integrals integrals_of(const Phases<points>& at, const series::Nodes<points, double>& weight,
                                const series::Nodes<points, double>& distance);
  void take(const Integrals& of_part);
  Three step_to_fit() const;
  void move_reference(const Three& by);
  void follow_fit() {
    move_reference(step_to_fit());
    fitted_at_ = sums_[one];
  }
  void pass_through(const std::array<Phase, 3>& at, const Three& distance);

  Integrals sums_ = Integrals::everywhere(0.0),
            low_ = sums_;  ///< sums over all parts, and their rounding errors
  Three reference_{};
  double fitted_at_ = 0.0;  ///< length so far when the reference was last moved
};

namespace detail {

/// sin x and 1 - cos x with all their digits. The series have one term per point, because a rule of n points
/// is used only for turns x with x^(2 n) below 2^-53 (2 n)!.
template <int points>
[[gnu::always_inline]] inline void small_turn(const series::Nodes<points, double>& x,
                                              series::Nodes<points, double>& sin,
                                              series::Nodes<points, double>& versine) {
  const auto square = x * x;
  sin = versine = series::Nodes<points, double>::everywhere(1.0);
#pragma GCC unroll 8
  for (int n = points - 1; n >= 1; --n) {
    sin = 1.0 - sin * ((1.0 / ((2 * n) * (2 * n + 1))) * square);
    versine = 1.0 - versine * ((1.0 / ((2 * n + 1) * (2 * n + 2))) * square);
  }
  sin = x * sin;
  versine = 0.5 * square * versine;
}

}  // namespace detail

/// sin and 1 - cos of the phase `begin` plus `turn`, by sums of products that keep their digits if both
/// angles are small.
template <int points>
[[gnu::always_inline]] inline FundamentalFit::Phases<points> FundamentalFit::phases_of(
    const Phase& begin, const series::Nodes<points, double>& turn) {
  series::Nodes<points, double> sin, versine;
  detail::small_turn<points>(turn, sin, versine);
  const double cos = 1.0 - begin.versine;
  return {begin.sin - begin.sin * versine + cos * sin, begin.versine + cos * versine + begin.sin * sin};
}

template <int points>
[[gnu::always_inline]] inline FundamentalFit::Integrals FundamentalFit::integrals_of(
    const Phases<points>& at, const series::Nodes<points, double>& w,
    const series::Nodes<points, double>& distance) {
  const auto ws = w * at.sin, wv = w * at.versine, wr = w * distance;
  Integrals out;
  out.pair[0] = series::totals(w, ws);
  out.pair[1] = series::totals(wv, ws * at.sin);
  out.pair[2] = series::totals(ws * at.versine, wv * at.versine);
  out.pair[3] = series::totals(wr, wr * at.sin);
  out.pair[4] = series::totals(wr * at.versine, wr * distance);
  return out;
}

template <int points>
void FundamentalFit::add(const Phase& begin, const FittedPart<points>& part) {
  const Phases<points> at = phases_of<points>(begin, part.turn);
  auto weight = part.weight;
  if constexpr (points % 2 != 0) weight.set(points, 0.0);  // one lane is unused with an odd number of points
  constexpr double far_more = 8.0;
  if (series::totals(weight, weight)[0] > far_more * sums_[one]) {
    const auto off = distance<points>(at, part.signal);
    const auto phase = [&](int k) { return Phase{at.sin[k], at.versine[k]}; };
    constexpr int middle = points / 2, last = points - 1;
    pass_through({phase(0), phase(middle), phase(last)}, {off[0], off[middle], off[last]});
  }
  take(integrals_of<points>(at, weight, distance<points>(at, part.signal)));
  if (sums_[one] >= 2 * fitted_at_) follow_fit();
}

}  // namespace sixstep::study

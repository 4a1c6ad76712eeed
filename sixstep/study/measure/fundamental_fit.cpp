// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/fundamental_fit.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::study {

Phase phase_of(double rad) {
  const base::SinCos p = base::sin_cos(rad);
  return {p.sin, p.cos > 0.0 ? p.sin * p.sin / (1.0 + p.cos) : 1.0 - p.cos};
}

void FundamentalFit::take(const Integrals<double>& part) {
  sums_.one.add(part.one);
  sums_.s.add(part.s);
  sums_.v.add(part.v);
  sums_.ss.add(part.ss);
  sums_.sv.add(part.sv);
  sums_.vv.add(part.vv);
  for (std::size_t n = 0; n < 3; ++n) sums_.with[n].add(part.with[n]);
  sums_.square.add(part.square);
}

namespace {

/// The products of sin p and 1 - cos p, with what 1 makes up of them taken off.
struct Cleared {
  double l_s, l_v, ss, sv, vv;
};
template <class Sums>
Cleared cleared(const Sums& f) {
  const double l_s = f.s.value / f.one.value, l_v = f.v.value / f.one.value;
  return {l_s, l_v, f.ss.value - l_s * f.s.value, f.sv.value - l_s * f.v.value, f.vv.value - l_v * f.v.value};
}

}  // namespace

/// What of the fit the reference lacks: the normal equations by L D L', where nothing is taken along a function that
/// the others already make up.
FundamentalFit::Three FundamentalFit::step_to_fit() const {
  constexpr double made_up = 0x1p-40;
  const auto& f = sums_;
  if (!(f.one.value > 0.0)) return {};
  const Cleared c = cleared(f);
  const bool has_s = c.ss > made_up * f.ss.value;
  const double l_sv = has_s ? c.sv / c.ss : 0.0;
  const double vv = c.vv - l_sv * c.sv;
  const double z_s = f.with[1].value - c.l_s * f.with[0].value;
  const double z_v = f.with[2].value - c.l_v * f.with[0].value - l_sv * z_s;
  Three step{};
  step[2] = vv > made_up * f.vv.value ? z_v / vv : 0.0;
  step[1] = has_s ? z_s / c.ss - l_sv * step[2] : 0.0;
  step[0] = f.with[0].value / f.one.value - c.l_s * step[1] - c.l_v * step[2];
  return step;
}

void FundamentalFit::move_reference(const Three& by) {
  auto& f = sums_;
  const Three moved = {f.one.value * by[0] + f.s.value * by[1] + f.v.value * by[2],
                       f.s.value * by[0] + f.ss.value * by[1] + f.sv.value * by[2],
                       f.v.value * by[0] + f.sv.value * by[1] + f.vv.value * by[2]};
  for (std::size_t n = 0; n < 3; ++n) {
    f.square.add(by[n] * (moved[n] - 2 * f.with[n].value));
    reference_[n] += by[n];
  }
  for (std::size_t n = 0; n < 3; ++n) f.with[n].add(-moved[n]);
  if (f.square.value < 0.0) f.square.set(0.0);
}

/// The reference goes through three points of a part that is far longer than all before it, instead of being led on
/// from there: from nothing at all, where the part is the first.
void FundamentalFit::pass_through(const std::array<Phase, 3>& at, const Three& distance) {
  const double s_1 = at[1].sin - at[0].sin, s_2 = at[2].sin - at[0].sin;
  const double v_1 = at[1].versine - at[0].versine, v_2 = at[2].versine - at[0].versine;
  const double d_1 = distance[1] - distance[0], d_2 = distance[2] - distance[0];
  const double area = s_1 * v_2 - s_2 * v_1;
  Three by{};
  if (std::fabs(area) > 0x1p-20 * (std::fabs(s_1 * v_2) + std::fabs(s_2 * v_1))) {
    by[1] = (d_1 * v_2 - d_2 * v_1) / area;
    by[2] = (s_1 * d_2 - s_2 * d_1) / area;
  }
  by[0] = distance[0] - by[1] * at[0].sin - by[2] * at[0].versine;
  move_reference(by);
  fitted_at_ = sums_.one.value;
}

double FundamentalFit::distortion() const {
  FundamentalFit all = *this;
  all.move_reference(step_to_fit());
  const Cleared c = cleared(sums_);
  const double sin = all.reference_[1],
               cos = all.reference_[2];  // of 1 - cos: its sign and its mean drop out
  return std::sqrt(all.sums_.square.value / (sin * sin * c.ss + 2 * sin * cos * c.sv + cos * cos * c.vv));
}

}  // namespace sixstep::study

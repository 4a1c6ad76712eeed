// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/fundamental_fit.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::study {

Phase phase_of(double rad) {
  const base::SinCos p = base::sin_cos(rad);
  return {p.sin, p.cos > 0.0 ? p.sin * p.sin / (1.0 + p.cos) : 1.0 - p.cos};
}

void FundamentalFit::take(const Integrals& part) {
#pragma GCC unroll 8
  for (int k = 0; k < Integrals::pairs; ++k)
    series::add_compensated(sums_.pair[k], low_.pair[k], part.pair[k]);
}

/// The fit's coefficients minus the reference's coefficients, from the normal equations by L D L'
/// decomposition. The coefficient of a function that is almost a linear combination of the other functions is
/// set to 0.
FundamentalFit::Three FundamentalFit::step_to_fit() const {
  constexpr double made_up = 0x1p-40;
  const Integrals& f = sums_;
  if (!(f[one] > 0.0)) return {};
  const double l_s = f[s] / f[one], l_v = f[v] / f[one];
  const double d_s = f[ss] - l_s * f[s], d_sv = f[sv] - l_s * f[v];
  const bool has_s = d_s > made_up * f[ss];
  const double l_sv = has_s ? d_sv / d_s : 0.0;
  const double d_v = f[vv] - l_v * f[v] - l_sv * d_sv;
  const double z_s = f[rs] - l_s * f[r], z_v = f[rv] - l_v * f[r] - l_sv * z_s;
  Three step{};
  step[2] = d_v > made_up * f[vv] ? z_v / d_v : 0.0;
  step[1] = has_s ? z_s / d_s - l_sv * step[2] : 0.0;
  step[0] = f[r] / f[one] - l_s * step[1] - l_v * step[2];
  return step;
}

void FundamentalFit::move_reference(const Three& by) {
  const Integrals f = sums_;
  const Three moved = {f[one] * by[0] + f[s] * by[1] + f[v] * by[2],
                       f[s] * by[0] + f[ss] * by[1] + f[sv] * by[2],
                       f[v] * by[0] + f[sv] * by[1] + f[vv] * by[2]};
  double change = 0.0;
  for (int n = 0; n < 3; ++n) {
    change += by[n] * (moved[n] - 2 * f[r + n]);
    reference_[n] += by[n];
  }
  auto step = Integrals::everywhere(0.0);
  for (int n = 0; n < 3; ++n) step.set(r + n, -moved[n]);
  step.set(rr, change);
  take(step);
  if (sums_[rr] < 0.0) sums_.set(rr, 0.0), low_.set(rr, 0.0);
}

/// Moves the reference so that it passes through three points of a part. Used for the first part, and for a
/// part far longer than all parts before it: an extrapolated reference would be far away from such a part.
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
  fitted_at_ = sums_[one];
}

double FundamentalFit::distortion() const {
  FundamentalFit all = *this;
  all.move_reference(step_to_fit());
  const Integrals& f = sums_;
  const double d_s = f[ss] - f[s] * f[s] / f[one], d_sv = f[sv] - f[s] * f[v] / f[one],
               d_v = f[vv] - f[v] * f[v] / f[one];
  const double sin = all.reference_[1],
               cos = all.reference_[2];  // coefficient of 1 - cos; the coefficient of cos is its negative,
                                         // and the mean cancels
  return std::sqrt(all.sums_[rr] / (sin * sin * d_s + 2 * sin * cos * d_sv + cos * cos * d_v));
}

}  // namespace sixstep::study

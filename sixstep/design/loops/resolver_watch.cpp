// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/resolver_watch.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/elementary.hpp"

namespace sixstep::design {

ResolverLimits resolver_limits(const ResolverShows& whole) {
  const double k_1 = whole.k_1 * whole.k_1, k_2 = whole.k_2 * whole.k_2;
  const double c = base::cos(whole.quadrature_rad), half = (k_1 + k_2) / 2, product = k_1 * k_2 * c * c;
  const double apart = std::sqrt(std::fmax(half * half - product, 0.0));
  const double l_2 = half + apart, l_1 = product / l_2;  // in this form the smaller eigenvalue loses no
                                                         // digits
  ResolverLimits limits{l_1 / 2, l_2 * 5 / 4, 1};
  if (!(whole.noise > 0)) return limits;
  const double room = std::fmin(std::sqrt(l_1) - std::sqrt(limits.least_square),
                                std::sqrt(limits.greatest_square) - std::sqrt(l_2));
  const double z = room / whole.noise, rare = -base::log(1e-12);
  const double new_ones = std::ceil(rare / (z * z / 2 + base::log(2.0)));
  limits.in_a_row = static_cast<int>(std::clamp(2 * new_ones - 1, 1.0, 255.0));
  return limits;
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// Values of the general plant's series at the nodes of a quadrature, and the losses of copper and devices
// over a part of a segment. The audit uses them. The plant uses them when it simulates temperatures.
#pragma once
#include "sixstep/plant/general/constants.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::plant::general {

template <class Real>
class Plant;

namespace detail {

template <int points, class Real>
struct AtNodes {
  const Plant<Real>& plant;
  series::Nodes<points, Real> s;
  Real dt;

  series::Nodes<points, Real> of(const series::Coefficients<Real>& c) const {
    return series::values_at<points>(c, plant.expansion().degree, s);
  }
  Real integral(const series::Nodes<points, Real>& a) const { return dt * series::weighted_sum<points>(a); }
  Real integral(const series::Nodes<points, Real>& a, const series::Nodes<points, Real>& b) const {
    return dt * series::weighted_sum<points>(a, b);
  }
};

/// Copper losses of the phases and of the current around a delta, J.
template <int points, class Real>
Real copper_energy(const AtNodes<points, Real>& at) {
  const auto& c = at.plant.constants();
  Real sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (is_floating(at.plant.mode().legs[k])) continue;
    const auto i = at.of(at.plant.expansion().i[k]);
    sum += c.R[k] * at.integral(i, i);
  }
  if (c.has_loop) {
    const auto loop = at.of(at.plant.series().loop);
    sum += c.loop_R / 3 * at.integral(loop, loop);
  }
  return sum;
}

/// Losses of the conducting device of leg k, J.
template <int points, class Real>
Real device_energy(const AtNodes<points, Real>& at, std::size_t k) {
  const PoleTerms<Real>& terms = at.plant.constants().terms(k, at.plant.mode().legs[k]);
  const auto i = at.of(at.plant.expansion().i[k]);
  return terms.r_ohm * at.integral(i, i) - terms.offset_V * at.integral(i);
}

}  // namespace detail

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Motion within one segment of the shaft on which the sensor is mounted: the rotor's shaft, or the load's
// shaft after gear and elastic shaft.
#pragma once
#include <cmath>

#include "sixstep/plant/encoder.hpp"
#include "sixstep/plant/expansion.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

/// The load's shaft in the general kernel. The load's angle is theta_m/n - twist, with the motor's angle
/// theta_m and the gear ratio n. `speed` is null if the sensor is on the rotor's shaft.
template <class Real>
struct LoadSide {
  const series::Coefficients<Real>* speed = nullptr;
  const series::Coefficients<Real>* twist = nullptr;  ///< null for a rigid shaft
  Real inv_gear = 1;
};

/// Converts an angle, rad, over all turns to whole sixths of a turn and the rest. After a thousand turns the
/// error of a double is 1e-12 rad.
template <class Real>
plant::ShaftAngle<Real> in_sixths(Real theta_rad) {
  const Real whole = std::floor(theta_rad / Real(base::sector_rad));
  return {static_cast<std::int64_t>(whole), theta_rad - whole * Real(base::sector_rad), 1};
}

/// Motion of the shaft over the fraction s, in (0, 1], of one segment.
template <class Real>
struct ShaftMotion {
  const plant::Expansion<Real>& y;
  std::int64_t sector = 0;
  std::int64_t pole_pairs = 1;
  Real s = 1;
  sim::Instant from{}, to{}, next_sample{};
  LoadSide<Real> load{};

  plant::ShaftAngle<Real> angle(Real at) const {
    const Real x = series::evaluate(y.x, y.degree, at);
    if (load.speed == nullptr) return {sector, x, pole_pairs};
    const Real rotor =
        (static_cast<Real>(sector) * Real(base::sector_rad) + x) / static_cast<Real>(pole_pairs);
    const Real twist = load.twist == nullptr ? Real(0) : series::evaluate(*load.twist, y.degree, at);
    return in_sixths(rotor * load.inv_gear - twist);
  }
  Real speed(Real at) const {
    return series::evaluate(load.speed == nullptr ? y.w : *load.speed, y.degree, at);
  }
  /// Fraction of the segment at the instant `at`.
  Real part(const sim::Instant& at) const {
    return y.h > 0 ? static_cast<Real>(sim::seconds_between(from, at)) / y.h : Real(0);
  }
};

/// Fraction of the segment at which the shaft reverses; 0 if it does not reverse. The shaft can reverse at
/// most once.
template <class Real>
Real turning_part(const ShaftMotion<Real>& m) {
  const Real start = m.speed(Real(0)), end = m.speed(m.s);
  if (!((start > 0 && end < 0) || (start < 0 && end > 0))) return 0;
  Real low = 0, high = m.s;
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    ((m.speed(middle) > 0) == (start > 0) ? low : high) = middle;
  }
  return high;
}

/// Fraction of the segment at which the shaft reaches a count, if it turns in one direction from fraction
/// `low` to `high`. `count_at` returns the count at an angle; `way` is the direction, 1 or -1.
template <class Real, class CountAt>
Real part_of_count(const ShaftMotion<Real>& m, const CountAt& count_at, Real low, Real high,
                   std::int64_t count, int way) {
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    ((count_at(m.angle(middle)) - count) * way >= 0 ? high : low) = middle;
  }
  return high;
}

}  // namespace sixstep::rig

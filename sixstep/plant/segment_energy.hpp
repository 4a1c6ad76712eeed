// SPDX-License-Identifier: Apache-2.0
// SegmentEnergy integrates what moves through bridge, winding and shaft over one segment, from the segment's
// own series: the terms of the energy balance (model.md 5). Where nothing can flow, it computes nothing.
#pragma once
#include "sixstep/plant/plant.hpp"
#include "sixstep/series/quadrature.hpp"

namespace sixstep::plant {

/// J over one segment; friction is viscous and dry. `travel` is the shaft's way in rad; `load_viscous` what of `viscous`
/// acts at a load's side of its own.
template <class Real>
struct SegmentEnergy {
  Real supplied = 0, copper = 0, devices = 0, air_gap = 0, viscous = 0, dry = 0, load = 0, travel = 0,
       load_viscous = 0;
};

namespace detail {

/// Integrals of squares and currents, in units of the segment's length, of the connected legs in the law's order.
template <class Real>
struct LegIntegrals {
  PerLeg<Real> square{}, charge{};
};

/// What is integrated, at the nodes: currents of the first and second connected leg, speed and torque.
template <int points, class Real>
struct Moving {
  series::Nodes<points, Real> i_1, i_2, w, torque;
};

/// i_c = -(i_a + i_b), or i_b = -i_a where two legs are connected: one or two series say all.
template <int points, class Real>
[[gnu::always_inline]] inline LegIntegrals<Real> leg_integrals(const LegsLaw<Real>& law,
                                                               const Moving<points, Real>& at) {
  using series::weighted_sums;
  if (law.connected == 2) {
    const auto sums = weighted_sums<points>(at.i_1 * at.i_1, at.i_1);
    return {{sums[0], sums[0], 0}, {sums[1], -sums[1], 0}};
  }
  const auto i_3 = at.i_1 + at.i_2;
  const auto squares = weighted_sums<points>(at.i_1 * at.i_1, at.i_2 * at.i_2);
  const auto charges = weighted_sums<points>(at.i_1, at.i_2);
  return {{squares[0], squares[1], series::weighted_sum<points>(i_3, i_3)},
          {charges[0], charges[1], -(charges[0] + charges[1])}};
}

/// Copper, devices and supply: what the currents do. `dt` is the length in seconds.
template <int points, class Real>
[[gnu::always_inline]] inline void electrical_energy(const Constants<Real>& c, const Mode& mode,
                                                     const Expansion<Real>& y, Real dt,
                                                     const series::Nodes<points, Real>& s,
                                                     const Moving<points, Real>& at,
                                                     SegmentEnergy<Real>& out) {
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const LegIntegrals<Real> legs = leg_integrals<points>(law, at);
  // Of a floating leg in the third place both integrals are zero.
  const PerLeg<PoleTerms<Real>>& pole = law.pole;
  const auto device = [&](int n) {
    // mutant: pole[n].r_ohm * legs.square[n] - pole[n].offset_V * legs.charge[n] => pole[n].r_ohm * legs.square[n] + pole[n].offset_V * legs.charge[n]
    return pole[n].r_ohm * legs.square[n] - pole[n].offset_V * legs.charge[n];
  };
  const auto drawn = [&](int n) { return pole[n].bus_share * legs.charge[n]; };
  out.copper = dt * c.R * (legs.square[0] + legs.square[1] + legs.square[2]);
  out.devices = dt * ((device(0) + device(1)) + device(2));
  if (!(c.inv_C > 0)) {
    out.supplied = dt * y.bus[0] * ((drawn(0) + drawn(1)) + drawn(2));
    return;
  }
  const Real share = pole[2].bus_share;  // i_3 = -(i_1 + i_2)
  const auto dc = (pole[0].bus_share - share) * at.i_1 + (pole[1].bus_share - share) * at.i_2;
  out.supplied = dt * series::weighted_sum<points>(series::values_at<points>(y.bus, y.degree, s), dc);
}

/// What turns, and what it takes from the air gap where currents flow.
template <int points, class Real>
[[gnu::always_inline]] inline void shaft_energy(const Constants<Real>& c, const Mode& mode, Real dt,
                                                const Moving<points, Real>& at, bool conducts,
                                                SegmentEnergy<Real>& out) {
  const auto [load, dry, per_speed] = torques(c, mode.motion);
  const auto sums = series::weighted_sums<points>(at.w, at.w * at.w);
  out.travel = dt * sums[0];
  out.load = load * out.travel;
  // mutant: dry * out.travel => -dry * out.travel
  out.dry = dry * out.travel;
  out.viscous = dt * per_speed * sums[1];
  if (conducts) out.air_gap = dt * series::weighted_sum<points>(at.torque, at.w);
}

/// Only what is asked for of them, in one pass.
template <int points, class Real>
[[gnu::always_inline]] inline Moving<points, Real> moving_at(const LegsLaw<Real>& law,
                                                             const Expansion<Real>& y,
                                                             const series::Nodes<points, Real>& s,
                                                             bool conducts, bool turning) {
  const auto values = [&](const series::Coefficients<Real>& c) __attribute__((always_inline)) {
    return series::values_of_fitting<points>(c, y.degree, s);
  };
  Moving<points, Real> at;
  if (conducts) {
    at.i_1 = values(y.i[law.leg[0]]);
    at.i_2 = law.connected == 3 ? values(y.i[law.leg[1]]) : -at.i_1;
  }
  if (turning) at.w = values(y.w);
  if (conducts && turning) at.torque = values(y.torque);
  return at;
}

template <class Real>
[[gnu::always_inline]] inline SegmentEnergy<Real> segment_energy_here(const Plant<Real>& plant, Real to) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  const Mode& mode = plant.mode();
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const bool conducts = law.connected >= 2, turning = turns(mode.motion);
  SegmentEnergy<Real> out;
  if (!conducts && !turning) return out;
  series::with_points_for(
      y.degree, [&]<int points>() __attribute__((always_inline)) {
        const auto s = series::nodes_up_to<points>(to);
        const auto at = moving_at<points>(law, y, s, conducts, turning);
        const Real dt = y.h * to;
        if (conducts) electrical_energy<points>(c, mode, y, dt, s, at, out);
        if (turning) shaft_energy<points>(c, mode, dt, at, conducts, out);
      });
  return out;
}

}  // namespace detail

/// Over [0, to] of the expansion at hand. Each integral to about 2^-53 of its natural scale: see
/// series/quadrature.hpp.
template <class Real>
SegmentEnergy<Real> segment_energy(const Plant<Real>& plant, Real to) {
  return detail::segment_energy_here(plant, to);
}
/// Of doubles compiled once, for any processor and for those with AVX: the same bits (plant/expand.hpp).
SegmentEnergy<double> segment_energy(const Plant<double>& plant, double to);

}  // namespace sixstep::plant

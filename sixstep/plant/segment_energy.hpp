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

/// Integrals of squares and currents per leg, in units of the segment's length.
template <class Real>
struct LegIntegrals {
  PerLeg<Real> square{}, charge{};
};

/// i_c = -(i_a + i_b), or i_b = -i_a where two legs are connected: one or two series say all.
template <int points, class Real>
LegIntegrals<Real> leg_integrals(const LegsLaw<Real>& law, const series::Nodes<points, Real>& i_1,
                                 const series::Nodes<points, Real>& i_2) {
  using series::weighted_sum;
  LegIntegrals<Real> out;
  const int first = law.leg[0], second = law.leg[1], third = law.leg[2];
  const Real square_1 = weighted_sum<points>(i_1, i_1), charge_1 = weighted_sum<points>(i_1);
  out.square[first] = square_1;
  out.charge[first] = charge_1;
  if (law.connected == 2) {
    out.square[second] = square_1;
    out.charge[second] = -charge_1;
    return out;
  }
  const Real square_2 = weighted_sum<points>(i_2, i_2), charge_2 = weighted_sum<points>(i_2);
  series::Nodes<points, Real> i_3;
  for (int k = 0; k < points; ++k) i_3[k] = i_1[k] + i_2[k];
  out.square[second] = square_2;
  out.charge[second] = charge_2;
  out.square[third] = weighted_sum<points>(i_3, i_3);
  out.charge[third] = -(charge_1 + charge_2);
  return out;
}

/// Copper, devices and supply: what the currents do. `dt` is the length in seconds.
template <int points, class Real>
void electrical_energy(const Constants<Real>& c, const Mode& mode, const Expansion<Real>& y, Real dt,
                       const series::Nodes<points, Real>& s, SegmentEnergy<Real>& out) {
  const LegsLaw<Real>& law = c.legs[legs_index(mode.legs)];
  const auto i_1 = series::values_at<points>(y.i[law.leg[0]], y.degree, s);
  series::Nodes<points, Real> i_2;
  if (law.connected == 3)
    i_2 = series::values_at<points>(y.i[law.leg[1]], y.degree, s);
  else
    for (int k = 0; k < points; ++k) i_2[k] = -i_1[k];
  const LegIntegrals<Real> legs = leg_integrals<points>(law, i_1, i_2);
  Real devices = 0, charge = 0;
  for (int k = 0; k < 3; ++k) {
    const PoleTerms<Real>& terms = c.poles[static_cast<std::size_t>(mode.legs[k])];
    // mutant: terms.r_ohm * legs.square[k] - terms.offset_V * legs.charge[k] => terms.r_ohm * legs.square[k] + terms.offset_V * legs.charge[k]
    devices += terms.r_ohm * legs.square[k] - terms.offset_V * legs.charge[k];
    charge += terms.bus_share * legs.charge[k];
  }
  out.copper = dt * c.R * (legs.square[0] + legs.square[1] + legs.square[2]);
  out.devices = dt * devices;
  if (!(c.inv_C > 0)) {
    out.supplied = dt * y.bus[0] * charge;
    return;
  }
  series::Nodes<points, Real> dc;
  const auto share = [&](int n) {
    return c.poles[static_cast<std::size_t>(mode.legs[law.leg[n]])].bus_share;
  };
  for (int k = 0; k < points; ++k)
    dc[k] = (share(0) - share(2)) * i_1[k] + (share(1) - share(2)) * i_2[k];  // i_3 = -(i_1 + i_2)
  out.supplied = dt * series::weighted_sum<points>(series::values_at<points>(y.bus, y.degree, s), dc);
}

}  // namespace detail

/// Over [0, to] of the expansion at hand. Each integral to about 2^-53 of its natural scale: see
/// series/quadrature.hpp.
template <class Real>
SegmentEnergy<Real> segment_energy(const Plant<Real>& plant, Real to) {
  const Constants<Real>& c = plant.constants();
  const Expansion<Real>& y = plant.expansion();
  const Mode& mode = plant.mode();
  const bool conducts = connected_count(mode.legs) >= 2;
  SegmentEnergy<Real> out;
  series::with_points_for(y.degree, [&]<int points>() {
    const auto s = series::nodes_up_to<points>(to);
    const Real dt = y.h * to;
    if (conducts) detail::electrical_energy<points>(c, mode, y, dt, s, out);
    if (!turns(mode.motion)) return;
    const auto w = series::values_at<points>(y.w, y.degree, s);
    out.travel = dt * series::weighted_sum<points>(w);
    const auto [load, dry, per_speed] = torques(c, mode.motion);
    out.load = load * out.travel;
    // mutant: dry * out.travel => -dry * out.travel
    out.dry = dry * out.travel;
    if (per_speed > 0) out.viscous = dt * per_speed * series::weighted_sum<points>(w, w);
    if (conducts)
      out.air_gap = dt * series::weighted_sum<points>(series::values_at<points>(y.torque, y.degree, s), w);
  });
  return out;
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
// What moves through bridge, winding and shaft of the general plant over one segment (plant/segment_energy.hpp), and what is
// stored at an instant: fields, masses, an elastic shaft. Cogging takes and gives back: what it gave comes beside.
#pragma once
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant::general {

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

template <int points, class Real>
void electrical_energy(const AtNodes<points, Real>& at, SegmentEnergy<Real>& out) {
  const auto& c = at.plant.constants();
  const auto& y = at.plant.expansion();
  const auto& mode = at.plant.mode();
  series::Nodes<points, Real> dc{};
  if (connected_count(mode.legs) >= 2)
    for (int k = 0; k < 3; ++k) {
      if (is_floating(mode.legs[k])) continue;
      const PoleTerms<Real>& terms = c.poles[static_cast<std::size_t>(mode.legs[k])];
      const auto i = at.of(y.i[k]);
      const Real square = at.integral(i, i);
      out.copper += c.R[k] * square;
      out.devices += terms.r_ohm * square - terms.offset_V * at.integral(i);
      for (int n = 0; n < points; ++n) dc[n] += terms.bus_share * i[n];
    }
  out.supplied = at.integral(at.of(y.bus), dc);
  if (c.has_loop) {
    const auto loop = at.of(at.plant.series().loop);
    out.copper += c.loop_R / 3 * at.integral(loop, loop);
  }
}

template <int points, class Real>
void shaft_energy(const AtNodes<points, Real>& at, SegmentEnergy<Real>& out) {
  const auto& c = at.plant.constants();
  const auto& y = at.plant.expansion();
  const auto& z = at.plant.series();
  const auto w = at.of(y.w), load_w = at.of(z.load_w);
  out.travel = at.integral(w);
  out.dry = against(at.plant.mode().motion, c.coulomb) * out.travel;
  out.viscous = c.B * at.integral(w, w);
  out.load_viscous = c.load_B * at.integral(load_w, load_w);
  if (c.elastic) {
    auto slip = load_w;
    for (int n = 0; n < points; ++n) slip[n] = c.inv_gear * w[n] - load_w[n];
    out.viscous += out.load_viscous + c.damping * at.integral(slip, slip);
  }
  out.load = at.integral(at.of(z.load), load_w);
  out.air_gap = at.integral(at.of(y.torque), w);
}

}  // namespace detail

/// Over [0, to] of the expansion at hand.
template <class Real>
SegmentEnergy<Real> segment_energy(const Plant<Real>& plant, Real to) {
  SegmentEnergy<Real> out;
  series::with_points_for(plant.expansion().degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{plant, series::nodes_up_to<points>(to), plant.expansion().h * to};
    detail::electrical_energy<points>(at, out);
    detail::shaft_energy<points>(at, out);
  });
  return out;
}

/// What cogging gave to the shaft over [0, to], J.
template <class Real>
Real cogging_energy(const Plant<Real>& plant, Real to) {
  Real given = 0;
  series::with_points_for(plant.expansion().degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{plant, series::nodes_up_to<points>(to), plant.expansion().h * to};
    given = at.integral(at.of(plant.series().cogging), at.of(plant.expansion().w));
  });
  return given;
}

/// (1/2) i^T L i and the loop's field at the fraction s, J.
template <class Real>
Real field_energy(const Plant<Real>& plant, Real s) {
  const auto& c = plant.constants();
  const auto value = [&](const series::Coefficients<Real>& of) {
    return series::evaluate(of, plant.expansion().degree, s);
  };
  const auto& y = plant.expansion();
  const Real a = value(y.i[0]), b = value(y.i[1]), third = value(y.i[2]);
  Real energy = c.L * (a * a + b * b + third * third) / 2;
  if (c.salient) {
    const Real alpha = (2 * a - b - third) / 3,
               beta = (b - third) * Real(0.57735026918962576450914878050195746L);
    const Real cos = value(plant.series().cos[c.salient_rotation]),
               sin = value(plant.series().sin[c.salient_rotation]);
    constexpr Real half_root3 = Real(0.86602540378443864676372317075293618L);
    const Real turned_cos = cos / 2 - half_root3 * sin,
               turned_sin = sin / 2 + half_root3 * cos;  // of 2 theta_d
    energy +=
        Real(0.75) * c.L_D * (turned_cos * (alpha * alpha - beta * beta) + 2 * turned_sin * alpha * beta);
  }
  if (c.has_loop) {
    const Real loop = value(plant.series().loop);
    energy += loop * loop / (6 * c.loop_inv_L);
  }
  return energy;
}

/// Of both masses and the twist between them at the fraction s, J.
template <class Real>
Real moving_energy(const Plant<Real>& plant, Real s) {
  const auto& c = plant.constants();
  const auto value = [&](const series::Coefficients<Real>& of) {
    return series::evaluate(of, plant.expansion().degree, s);
  };
  const Real w = value(plant.expansion().w);
  Real energy = w * w / (2 * c.inv_J);
  if (c.elastic) {
    const Real load_w = value(plant.series().load_w), twist = value(plant.series().twist);
    energy += load_w * load_w / (2 * c.load_inv_J) + c.stiffness * twist * twist / 2;
  }
  return energy;
}

}  // namespace sixstep::plant::general

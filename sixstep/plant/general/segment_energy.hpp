// SPDX-License-Identifier: Apache-2.0
// Integrates the energies of the general plant's bridge, winding and shaft over one segment
// (plant/segment_energy.hpp), and computes the energy stored in fields, masses and elastic shaft at an
// instant. The energy of the cogging torque is computed separately.
#pragma once
#include "sixstep/plant/general/energy_nodes.hpp"
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/plant/segment_energy.hpp"

namespace sixstep::plant::general {

namespace detail {

template <int points, class Real>
void electrical_energy(const AtNodes<points, Real>& at, SegmentEnergy<Real>& out) {
  const auto& c = at.plant.constants();
  const auto& y = at.plant.expansion();
  const auto& mode = at.plant.mode();
  out.copper = copper_energy<points>(at);
  auto dc = series::Nodes<points, Real>::everywhere(Real(0));
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_floating(mode.legs[k])) continue;
    out.devices += device_energy<points>(at, k);
    const Real share = c.terms(k, mode.legs[k]).bus_share;
    dc = dc + share * at.of(y.i[k]);
  }
  out.supplied = at.integral(at.of(y.bus), dc);
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
    const auto slip = c.inv_gear * w - load_w;
    out.viscous += out.load_viscous + c.damping * at.integral(slip, slip);
  }
  if (c.lossy_gear() && turns(at.plant.mode().motion)) {
    const bool drives = (at.plant.mode().through_sign > 0) == (at.plant.mode().motion == Motion::forward);
    out.viscous += (gear_factor(c.efficiency, drives) - 1) * c.inv_gear * at.integral(at.of(z.through), w);
  }
  out.load = at.integral(at.of(z.load), load_w);
  out.air_gap = at.integral(at.of(y.torque), w);
}

}  // namespace detail

/// Energies of the present segment, J, from its start to the fraction `to`, 0 to 1.
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

/// Heat of the brake resistor, J, from the segment's start to the fraction `to`.
template <class Real>
Real brake_energy(const Plant<Real>& plant, Real to) {
  if (!plant.mode().braking) return 0;
  Real heat = 0;
  series::with_points_for(plant.expansion().degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{plant, series::nodes_up_to<points>(to), plant.expansion().h * to};
    const auto bus = at.of(plant.expansion().bus);
    heat = plant.constants().brake_conductance * at.integral(bus, bus);
  });
  return heat;
}

/// Energy that the cogging torque transfers to the shaft, J, from the segment's start to the fraction `to`.
template <class Real>
Real cogging_energy(const Plant<Real>& plant, Real to) {
  Real given = 0;
  series::with_points_for(plant.expansion().degree, [&]<int points>() {
    const detail::AtNodes<points, Real> at{plant, series::nodes_up_to<points>(to), plant.expansion().h * to};
    given = at.integral(at.of(plant.series().cogging), at.of(plant.expansion().w));
  });
  return given;
}

/// Magnetic energy of the phases and of the current around a delta, at the fraction s of the segment, J.
template <class Real>
Real field_energy(const Plant<Real>& plant, Real s) {
  const auto& c = plant.constants();
  const auto value = [&](const series::Coefficients<Real>& of) {
    return series::evaluate(of, plant.expansion().degree, s);
  };
  const auto& y = plant.expansion();
  const Real a = value(y.i[0]), b = value(y.i[1]), third = value(y.i[2]);
  Real energy = c.L * (a * a + b * b + third * third) / 2;
  if (c.has_axes) {  // the integral of i d(lambda), summed over the three phases
    const Real d = value(plant.series().d), q = value(plant.series().q);
    energy =
        Real(0.75) * (c.axes.L_d * d * d * (1 - d * c.axes.inv_I_sat * Real(2.0L / 3)) + c.axes.L_q * q * q);
  }
  if (c.has_loop) {
    const Real loop = value(plant.series().loop);
    energy += loop * loop / (6 * c.loop_inv_L);
  }
  return energy;
}

/// Kinetic energy of motor and load, plus the elastic energy of the shaft, at the fraction s of the segment,
/// J.
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

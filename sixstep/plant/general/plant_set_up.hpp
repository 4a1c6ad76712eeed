// SPDX-License-Identifier: Apache-2.0
// From what is given to the numbers that the recurrence wants: part of general/plant.hpp.
#pragma once
#include "sixstep/plant/general/plant.hpp"

namespace sixstep::plant::general {

template <class Real>
Plant<Real>::Plant(const Machine& machine, const Shaft& shaft, const Devices& devices, const Supply& supply,
                   const Start& start)
    : constants_{}, y_{}, z_{} {
  Constants<Real>& c = constants_;
  set_winding(machine);
  c.devices = devices;
  const plant::Devices mosfet{devices.R_on_ohm, devices.V_f_V, devices.r_d_ohm};
  c.poles = pole_table<Real>(mosfet);
  if (devices
          .igbt) {  // high by transistor: U_s - V_ce - r_ce i; low by transistor, i < 0: V_ce - r_ce i (model.md 2)
    c.poles[static_cast<std::size_t>(Connection::high_switch)].offset_V = -Real(devices.V_ce_V);
    c.poles[static_cast<std::size_t>(Connection::low_switch)].offset_V = Real(devices.V_ce_V);
  }
  set_shaft(shaft);
  set_supply(supply);
  const Real emf = 2 * K_e_ * plant::detail::abs(Real(start.speed_rad_s));
  set_scales(std::max(c.V_0, Real(start.bus_V)) + std::max(Real(devices.V_f_V), Real(devices.V_ce_V)) + emf);
  set_locked(shaft.locked);
  state_.bus = c.inv_C > 0 ? Real(start.bus_V) : c.V_0;
  more_.source = c.inv_L_b > 0 ? Real(start.source_A) : Real(0);
  place(start);
}

template <class Real>
void Plant<Real>::set_winding(const Machine& m) {
  Constants<Real>& c = constants_;
  c.shape = shape_table<Real>(m);
  c.rotations = c.shape.rotations.size();
  c.pole_pairs = Real(m.pole_pairs);
  const bool delta = m.winding == Winding::delta;
  for (std::size_t k = 0; k < 3; ++k) c.R[k] = delta ? Real(m.R_ohm[k]) / 3 : Real(m.R_ohm[k]);
  c.L = delta ? Real(m.L_H - m.M_H) / 3 : Real(m.L_H);
  stiffest_L_ = c.L;
  if (m.salient()) {
    c.salient = true;
    c.L = (Real(m.L_d_H) + Real(m.L_q_H)) / 2;
    c.L_D = (Real(m.L_d_H) - Real(m.L_q_H)) / 2;
    stiffest_L_ = std::min(Real(m.L_d_H), Real(m.L_q_H));
    while (c.shape.rotations[c.salient_rotation].order != 2) ++c.salient_rotation;
  }
  c.inv_L = 1 / c.L;
  c.has_loop = delta;
  c.loop_R = Real(m.R_ohm[0]);
  c.loop_inv_L = 1 / Real(m.L_H + 2 * m.M_H);
  for (const double K : m.K_e_V_s) K_e_ = std::max(K_e_, Real(K));
  if (delta) K_e_ /= 2;
}

template <class Real>
void Plant<Real>::set_shaft(const Shaft& shaft) {
  Constants<Real>& c = constants_;
  c.elastic = shaft.elastic();
  c.inv_gear = 1 / Real(shaft.gear);
  const Real J = Real(shaft.J_kg_m2), B = Real(shaft.B_Nm_s), square = c.inv_gear * c.inv_gear;
  c.inv_J = 1 / (c.elastic ? J : J + Real(shaft.load_J_kg_m2) * square);
  c.B = c.elastic ? B : B + Real(shaft.load_B_Nm_s) * square;
  c.load_inv_J = c.elastic ? 1 / Real(shaft.load_J_kg_m2) : Real(0);
  c.load_B = Real(shaft.load_B_Nm_s);
  c.stiffness = Real(shaft.stiffness_Nm);
  c.damping = Real(shaft.damping_Nm_s);
  c.coulomb = Real(shaft.coulomb_Nm);
  c.breakaway = std::max(c.coulomb, Real(shaft.static_Nm));
  c.load = Real(shaft.load.torque_Nm);
  c.fan = Real(shaft.load.fan_Nm_s2);
  c.gravity = Real(shaft.load.gravity_Nm);
  c.gravity_angle = Real(shaft.load.gravity_angle_rad);
}

template <class Real>
void Plant<Real>::set_supply(const Supply& supply) {
  Constants<Real>& c = constants_;
  c.V_0 = Real(supply.V_0_V);
  if (!(supply.C_F > 0)) return;
  c.inv_C = 1 / Real(supply.C_F);
  c.R_b = Real(supply.R_b_ohm);
  c.inv_R_b = supply.R_b_ohm > 0 ? 1 / c.R_b : Real(0);
  c.inv_L_b = supply.L_b_H > 0 ? 1 / Real(supply.L_b_H) : Real(0);
  c.source_sinks = supply.sinks;
  c.brake_conductance = supply.brake_ohm > 0 ? 1 / Real(supply.brake_ohm) : Real(0);
  c.brake_on = Real(supply.brake_on_V);
  c.brake_off = Real(supply.brake_off_V);
}

/// The scales by which rounding noise is told from a signal.
template <class Real>
void Plant<Real>::set_scales(Real volt_scale) {
  Constants<Real>& c = constants_;
  c.volt_scale = volt_scale;
  c.amp_scale = volt_scale / std::min({c.R[0], c.R[1], c.R[2]});
  c.speed_scale = volt_scale / (2 * K_e_);
  c.torque_scale = 2 * K_e_ * c.amp_scale;
  c.volt_noise = noise_of(c.volt_scale, Real(1));
  c.amp_noise = noise_of(c.amp_scale, Real(1));
  c.speed_noise = noise_of(c.speed_scale, Real(1));
  c.torque_noise = noise_of(c.torque_scale, Real(1));
}

template <class Real>
void Plant<Real>::set_rates() {
  Constants<Real>& c = constants_;
  const Real R = std::max({c.R[0], c.R[1], c.R[2]}), least_R = std::min({c.R[0], c.R[1], c.R[2]});
  const Real in_series = std::max(Real(c.devices.R_on_ohm), Real(c.devices.r_d_ohm));
  c.steady_rate = (R + in_series) / stiffest_L_ + (c.has_loop ? c.loop_R * c.loop_inv_L : Real(0)) +
                  (c.locked ? Real(0) : K_e_ * std::sqrt(c.inv_J / stiffest_L_)) +
                  c.inv_C * (1 / least_R + c.brake_conductance);
  if (c.inv_L_b > 0)
    c.steady_rate += std::sqrt(c.inv_L_b * c.inv_C) + c.R_b * c.inv_L_b;
  else
    c.steady_rate += c.inv_C * c.inv_R_b;
  const Real both = c.inv_gear * c.inv_gear * c.inv_J + c.load_inv_J;
  if (c.elastic) c.steady_rate += std::sqrt(c.stiffness * both) + c.damping * both;
  Real order = 1;
  for (const Rotation<Real>& r : c.shape.rotations) order = std::max(order, Real(r.order));
  c.turning_rate = c.pole_pairs * order;
}

/// As plant::Plant puts its rotor down.
template <class Real>
void Plant<Real>::place(const Start& start) {
  state_.w = constants_.locked ? Real(0) : Real(start.speed_rad_s);
  more_.load_w = constants_.inv_gear * state_.w;
  if (constants_.elastic) more_.load_w = 0;
  mode_.load_sign = state_.w < 0 ? -1 : 1;
  const double electrical = start.angle_rad * static_cast<double>(constants_.pole_pairs);
  const double edge = std::floor(electrical / base::sector_rad + 0.5);
  const bool on_edge = std::fabs(electrical - edge * base::sector_rad) <= 0x1p-50 * std::fabs(electrical);
  const double sector = on_edge ? edge : std::floor(electrical / base::sector_rad);
  state_.sector = static_cast<std::int64_t>(sector);
  state_.x = on_edge ? Real(0) : std::max(Real(0), Real(electrical) - Real(sector) * Real(base::sector_rad));
  if (constants_.elastic) more_.twist = 0;
  mode_.sector = static_cast<std::uint8_t>(sector_in_turn(state_.sector));
  const auto& pieces = constants_.shape.sector[mode_.sector];
  while (mode_.piece + 1u < pieces.size() && state_.x >= pieces[mode_.piece].to) ++mode_.piece;
  if (on_edge && state_.w < 0) pass_edge(false);
}

template <class Real>
void Plant<Real>::set_locked(bool locked) {
  constants_.locked = locked;
  constants_.dry_friction = constants_.breakaway > 0 && !locked;
  if (locked) state_.w = state_.w_low = 0;
  set_rates();
  stale_ = true;
}

template <class Real>
void Plant<Real>::set_source_voltage(double V_0_V) {
  Constants<Real>& c = constants_;
  c.V_0 = Real(V_0_V);
  if (!(c.inv_C > 0)) {
    state_.bus = c.V_0;
    state_.bus_low = 0;
  }
  set_scales(std::max(c.volt_scale, c.V_0 + Real(c.devices.V_f_V)));
  stale_ = true;
}

template <class Real>
void Plant<Real>::set_source_sinks(bool sinks) {
  constants_.source_sinks = sinks || !(constants_.inv_C > 0);
  stale_ = true;
}

}  // namespace sixstep::plant::general

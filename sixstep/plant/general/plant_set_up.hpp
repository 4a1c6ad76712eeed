// SPDX-License-Identifier: Apache-2.0
// Member functions of general/plant.hpp that convert the given parameters to the constants of the recurrence.
#pragma once
#include "sixstep/plant/general/plant.hpp"

namespace sixstep::plant::general {

namespace detail {

/// Highest open-circuit voltage of the source over all charges and the whole mains period, V.
template <class Real = double>
Real highest_open_voltage(const Supply& s) {
  if (s.source == Source::steady) return s.V_0_V;
  if (s.source != Source::battery) return s.mains.peak_V;
  double highest = 0;
  for (const ChargePoint& p : s.battery.open_circuit) highest = std::max(highest, p.voltage_V);
  return highest;
}

}  // namespace detail

template <class Real>
Plant<Real>::Plant(const Machine& machine, const Shaft& shaft, const Devices& devices, const Supply& supply,
                   const Start& start, const HeatGiven& heat)
    : constants_{}, y_{}, z_{}, heat_(heat) {
  Constants<Real>& c = constants_;
  set_winding(machine);
  c.devices = devices;
  set_bridge();
  set_shaft(shaft);
  set_load_laws(shaft.load);
  set_supply(supply);
  const Real emf = 2 * K_e_ * plant::detail::abs(Real(start.speed_rad_s));
  set_scales(std::max(Real(detail::highest_open_voltage(supply)), Real(start.bus_V)) +
             std::max(Real(devices.V_f_V), Real(devices.V_ce_V)) + emf);
  set_locked(shaft.locked);
  state_.bus = c.inv_C > 0 ? Real(start.bus_V) : c.V_0;
  more_.capacitor.set(state_.bus);
  more_.load.set(Real(shaft.load.torque_Nm));
  place(start);
  find_pieces();
  if (heat.motor) set_warmth(heat_.on_R(), heat_.on_K_e());
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
  if (m.has_axes()) {
    c.has_axes = true;
    c.L = (Real(m.L_d_H) + Real(m.L_q_H)) / 2;
    c.axes = {Real(m.L_d_H), Real(m.L_q_H), m.saturation_A > 0 ? 1 / Real(m.saturation_A) : Real(0)};
    const Real along = c.axes.inv_I_sat > 0 ? c.axes.L_d / 2 : c.axes.L_d;
    stiffest_L_ = std::min(along, c.axes.L_q);
    while (c.shape.rotations[c.axes.rotation].order != 1) ++c.axes.rotation;
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
  c.imposed = shaft.dynamometer;
  c.gear = Real(shaft.gear);
  c.inv_gear = 1 / c.gear;
  c.efficiency = Real(shaft.efficiency);
  c.J_1 = Real(shaft.J_kg_m2);
  c.B_1 = Real(shaft.B_Nm_s);
  c.load_J = Real(shaft.load_J_kg_m2);
  c.load_B = Real(shaft.load_B_Nm_s);
  const Real square = c.inv_gear * c.inv_gear;
  c.inv_J = 1 / (c.elastic ? c.J_1 : c.J_1 + c.load_J * square);
  c.B = c.elastic ? c.B_1 : c.B_1 + c.load_B * square;
  c.load_inv_J = c.elastic ? 1 / c.load_J : Real(0);
  c.stiffness = Real(shaft.stiffness_Nm);
  c.damping = Real(shaft.damping_Nm_s);
  c.coulomb = Real(shaft.coulomb_Nm);
  c.breakaway = std::max(c.coulomb, Real(shaft.static_Nm));
}

template <class Real>
void Plant<Real>::set_load_laws(const Load& load) {
  Constants<Real>& c = constants_;
  c.fan = Real(load.fan_Nm_s2);
  c.gravity = Real(load.gravity_Nm);
  c.gravity_angle = Real(load.gravity_angle_rad);
  if (load.over_speed.empty()) return;
  const auto& points = load.over_speed;
  c.over_speed.push_back(
      {Real(0), Real(points.front().speed_rad_s), Real(points.front().torque_Nm), Real(0)});
  for (std::size_t n = 0; n + 1 < points.size(); ++n) {
    const Real from = Real(points[n].speed_rad_s), to = Real(points[n + 1].speed_rad_s);
    const Real rise = (Real(points[n + 1].torque_Nm) - Real(points[n].torque_Nm)) / (to - from);
    c.over_speed.push_back({from, to, Real(points[n].torque_Nm) - rise * from, rise});
  }
  c.over_speed.push_back({Real(points.back().speed_rad_s), Real(0), Real(points.back().torque_Nm), Real(0)});
}

template <class Real>
void Plant<Real>::set_supply(const Supply& supply) {
  Constants<Real>& c = constants_;
  c.V_0 = Real(supply.V_0_V);
  if (!(supply.C_F > 0)) return;
  c.inv_C = 1 / Real(supply.C_F);
  c.R_b = Real(supply.R_b_ohm);
  c.R_C = Real(supply.R_C_ohm);
  c.inv_R_b = supply.R_b_ohm > 0 ? 1 / c.R_b : Real(0);
  c.inv_L_b = supply.L_b_H > 0 ? 1 / Real(supply.L_b_H) : Real(0);
  c.source_sinks = supply.sinks;
  c.sink = supply.sinks ? Real(0) : Real(supply.sink_A);
  c.brake_conductance = supply.brake_ohm > 0 ? 1 / Real(supply.brake_ohm) : Real(0);
  c.brake_on = Real(supply.brake_on_V);
  c.brake_off = Real(supply.brake_off_V);
  set_source(supply);
}

template <class Real>
void Plant<Real>::set_source(const Supply& supply) {
  Constants<Real>& c = constants_;
  c.source = supply.source;
  if (c.source == Source::battery) {
    const Battery& b = supply.battery;
    for (std::size_t n = 0; n + 1 < b.open_circuit.size(); ++n) {
      const Real from = Real(b.open_circuit[n].charge), to = Real(b.open_circuit[n + 1].charge);
      const Real V = Real(b.open_circuit[n].voltage_V);
      const Real rise = (Real(b.open_circuit[n + 1].voltage_V) - V) / (to - from);
      c.open_circuit.push_back({from, to, V - rise * from, rise});
    }
    c.inv_capacity = 1 / Real(b.capacity_C);
    c.inv_C_1 = b.C_1_F > 0 ? 1 / Real(b.C_1_F) : Real(0);
    c.inv_R_1 = b.R_1_ohm > 0 ? 1 / Real(b.R_1_ohm) : Real(0);
    more_.charge.set(Real(b.charge));
  } else if (c.source != Source::steady) {
    const bool single = c.source == Source::single_phase;
    c.mains_peak = Real(supply.mains.peak_V);
    c.mains_drop = 2 * Real(supply.mains.diode_drop_V);
    c.mains_rate = 2 * Real(base::pi) * Real(supply.mains.frequency_Hz);
    c.mains_edge = single ? Real(1.5) * Real(base::sector_rad) : Real(0.5) * Real(base::sector_rad);
    more_.phase.set(single ? -c.mains_edge
                           : Real(0));  // single phase: the mains begin at a zero of |sin|; three phases: at
                                        // the top of a pulse
  }
}

/// Computes the pole terms with the channels' present temperatures. An IGBT's transistor has the constant
/// drop V_ce and the resistance r_ce. Pole voltage with the upper transistor on: U_s - V_ce - r_ce i. With
/// the lower transistor on (i < 0): V_ce - r_ce i (model.md 2).
template <class Real>
void Plant<Real>::set_bridge() {
  Constants<Real>& c = constants_;
  const plant::Devices mosfet{c.devices.R_on_ohm, c.devices.V_f_V, c.devices.r_d_ohm};
  const auto index = [](Connection at) { return static_cast<std::size_t>(at); };
  for (std::size_t k = 0; k < 3; ++k) {
    PoleTable<Real>& table = c.poles[k];
    table = pole_table<Real>(mosfet);
    PoleTerms<Real>&high = table[index(Connection::high_switch)], &low = table[index(Connection::low_switch)];
    if (c.devices.igbt) {
      high.offset_V = -Real(c.devices.V_ce_V);
      low.offset_V = Real(c.devices.V_ce_V);
    }
    if (!heat_.given().devices) continue;
    high.r_ohm *= Real(heat_.on_R_on(k, true));
    low.r_ohm *= Real(heat_.on_R_on(k, false));
  }
}

/// Sets the scales that distinguish rounding noise from a signal.
template <class Real>
void Plant<Real>::set_scales(Real volt_scale) {
  Constants<Real>& c = constants_;
  plant::detail::set_scales(c, volt_scale, std::min({c.R[0], c.R[1], c.R[2]}), K_e_);
  c.per_amp = 1 / c.amp_scale;
  c.per_speed = 1 / c.speed_scale;
}

template <class Real>
void Plant<Real>::set_rates() {
  Constants<Real>& c = constants_;
  const Real R = std::max({c.R[0], c.R[1], c.R[2]}), least_R = std::min({c.R[0], c.R[1], c.R[2]});
  const Real in_series = std::max(Real(c.devices.R_on_ohm), Real(c.devices.r_d_ohm));
  c.steady_rate = (R + in_series + c.R_C) / stiffest_L_ + (c.has_loop ? c.loop_R * c.loop_inv_L : Real(0)) +
                  (c.locked ? Real(0) : K_e_ * std::sqrt(c.inv_J / stiffest_L_)) +
                  c.inv_C * (1 / least_R + c.brake_conductance);
  if (c.inv_L_b > 0)
    c.steady_rate += std::sqrt(c.inv_L_b * c.inv_C) + (c.R_b + c.R_C) * c.inv_L_b;
  else
    c.steady_rate += c.inv_C * c.inv_R_b;
  const Real both = c.inv_gear * c.inv_gear * c.inv_J + c.load_inv_J;
  if (c.elastic) c.steady_rate += std::sqrt(c.stiffness * both) + c.damping * both;
  for (const TorquePiece<Real>& p : c.over_speed)
    c.steady_rate = std::max(c.steady_rate, plant::detail::abs(p.rise) * both);
  c.steady_rate += c.mains_rate + c.inv_C_1 * c.inv_R_1;
  Real order = 1;
  for (const Rotation<Real>& r : c.shape.rotations) order = std::max(order, Real(r.order));
  c.turning_rate = c.pole_pairs * order;
}

/// Sets angle and speed of the rotor at the start, like plant::Plant.
template <class Real>
void Plant<Real>::place(const Start& start) {
  state_.w = constants_.locked ? Real(0) : Real(start.speed_rad_s);
  more_.load_w.set(constants_.elastic ? Real(0) : constants_.inv_gear * state_.w);
  mode_.load_sign = state_.w < 0 ? -1 : 1;
  const double electrical = start.angle_rad * static_cast<double>(constants_.pole_pairs);
  const bool on_edge = plant::detail::set_rotor_angle(state_, electrical);
  mode_.sector = static_cast<std::uint8_t>(sector_in_turn(state_.sector));
  const auto& pieces = constants_.shape.sector[mode_.sector];
  while (mode_.piece + 1u < pieces.size() && state_.x >= pieces[mode_.piece].to) ++mode_.piece;
  if (on_edge && state_.w < 0) pass_edge(false);
}

/// Finds the pieces of the tables over speed and over charge that contain the present state.
template <class Real>
void Plant<Real>::find_pieces() {
  const auto find = [](const auto& pieces, std::uint8_t& at, Real value) {
    at = 0;
    while (at + 1u < pieces.size() && value > pieces[at].to) ++at;
  };
  const Real load_w = constants_.elastic ? more_.load_w.value : constants_.inv_gear * state_.w;
  find(constants_.over_speed, mode_.load_piece, load_w);
  find(constants_.open_circuit, mode_.charge_piece, more_.charge.value);
  mode_.load_sign = load_w < 0 ? -1 : load_w > 0 ? 1 : mode_.load_sign;
}

template <class Real>
void Plant<Real>::set_speed(double speed_rad_s, double rate_rad_s2) {
  Constants<Real>& c = constants_;
  c.speed_rate = Real(rate_rad_s2);
  more_.load_w.set(Real(speed_rad_s));
  if (c.speed_is_given() && !c.locked) {
    state_.w = c.gear * Real(speed_rad_s);
    state_.w_low = 0;
  }
  find_pieces();
  stale_ = true;
}

template <class Real>
void Plant<Real>::set_warmth(double on_R, double on_K_e) {
  Constants<Real>& c = constants_;
  const Real R = Real(on_R) / cold_R_, K = Real(on_K_e) / cold_K_e_;
  cold_R_ = Real(on_R);
  cold_K_e_ = Real(on_K_e);
  for (Real& of : c.R) of *= R;
  c.loop_R *= R;
  for (auto& sector : c.shape.sector)
    for (Piece<Real>& piece : sector)
      for (int k = 0; k < way_count; ++k) piece.now[k] *= K, piece.rise[k] *= K;
  for (Rotation<Real>& part : c.shape.rotations)
    for (int k = 0; k < way_count; ++k) part.cos[k] *= K, part.sin[k] *= K;
  K_e_ *= K;
  set_rates();
  stale_ = true;
}

template <class Real>
void Plant<Real>::set_locked(bool locked) {
  constants_.locked = locked;
  constants_.dry_friction = (constants_.breakaway > 0 || constants_.lossy_gear()) && !locked;
  if (locked) {
    state_.w = state_.w_low = 0;
    if (!constants_.over_speed.empty()) find_pieces();
  }
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

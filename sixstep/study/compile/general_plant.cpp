// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/general_plant.hpp"

#include "sixstep/plant/general/shape.hpp"
#include "sixstep/study/compile/timeline.hpp"

namespace sixstep::study {

namespace {

namespace general = plant::general;

/// A salient rotor has both axes in the place of one inductance.
bool is_salient(const design::Sheet& s) {
  return s.d_axis_inductance_mH && s.q_axis_inductance_mH && !s.inductance_mH &&
         s.d_axis_inductance_mH->value != s.q_axis_inductance_mH->value;
}

general::Shape shape_of(const design::Sheet& s, const plant::Machine& from) {
  general::Shape to{.flat_deg = from.flat_deg};
  if (from.back_emf != plant::BackEmf::sine) return to;
  to.harmonics = {{1, 1.0}};
  for (std::size_t n = 0; n < s.harmonic_orders.size(); ++n)
    to.harmonics.push_back({static_cast<int>(s.harmonic_orders[n]), s.harmonic_sizes[n]});
  return to;
}

/// Of the branches, whose R and L between two terminals the model has as those of a star, and K_x from K_t by the sector mean
/// without loop current (model.md 7).
void connect_delta(const design::Sheet& s, double K_t_Nm_A, general::Machine& m) {
  m.winding = general::Winding::delta;
  const double R = 3 * m.R_ohm[0], M = 1e-3 * s.mutual_inductance_mH;
  m.R_ohm = {R, R, R};
  m.L_H = 3 * m.L_H + M;
  m.M_H = M;
  m.K_e_V_s = {1, 1, 1};
  const double K = K_t_Nm_A / general::sector_mean(m);
  m.K_e_V_s = {K, K, K};
}

general::Machine machine_of(const Scenario& s, const Compiled& c) {
  const plant::Machine& from = c.motor.machine;
  const design::Sheet& sheet = s.sheet;
  general::Machine to{.R_ohm = {from.R_ohm, from.R_ohm, from.R_ohm},
                      .K_e_V_s = {from.K_e_V_s, from.K_e_V_s, from.K_e_V_s},
                      .L_H = from.L_H,
                      .pole_pairs = from.pole_pairs,
                      .shape = shape_of(sheet, from)};
  for (std::size_t k = 0; k < 3; ++k) {
    if (sheet.phase_resistance_deviation.size() == 3) to.R_ohm[k] *= 1 + sheet.phase_resistance_deviation[k];
    if (sheet.phase_back_emf_deviation.size() == 3) to.K_e_V_s[k] *= 1 + sheet.phase_back_emf_deviation[k];
  }
  if (is_salient(sheet)) {
    to.L_d_H = 1e-3 * sheet.d_axis_inductance_mH->value;
    to.L_q_H = 1e-3 * sheet.q_axis_inductance_mH->value;
  }
  for (std::size_t n = 0; n < sheet.cogging_orders.size(); ++n)
    to.cogging.push_back(
        {static_cast<int>(sheet.cogging_orders[n]), 1e-3 * sheet.cogging_mNm[n],
         sheet.cogging_phase_deg.empty() ? 0.0 : sheet.cogging_phase_deg[n] * base::pi / 180});
  if (sheet.connection == design::WindingConnection::delta) connect_delta(sheet, c.motor.K_t_Nm_A, to);
  return to;
}

/// Dry friction acts at the motor's side, whichever side it is given for.
general::Shaft shaft_of(const Scenario& s, const Compiled& c) {
  const plant::Shaft& motor = c.motor.shaft;
  return {.J_kg_m2 = motor.J_kg_m2,
          .B_Nm_s = motor.B_Nm_s,
          .coulomb_Nm = c.shaft.coulomb_Nm,
          .static_Nm = c.shaft.static_Nm,
          .gear = s.load.gear,
          .load_J_kg_m2 = s.load.inertia_kg_m2,
          .load_B_Nm_s = s.load.viscous_Nm_s,
          .stiffness_Nm = s.load.stiffness_Nm_rad,
          .damping_Nm_s = s.load.damping_Nm_s_rad,
          .load = {.fan_Nm_s2 = s.load.fan_Nm_s2,
                   .gravity_Nm = s.load.gravity_Nm,
                   .gravity_angle_rad = s.load.gravity_angle_deg * base::pi / 180},
          .locked = s.load.locked};
}

general::Devices devices_of(const Bridge& b) {
  return {.igbt = b.device == Device::igbt,
          .R_on_ohm = b.on_resistance_ohm,
          .V_ce_V = b.device == Device::igbt ? b.saturation_V : 0.0,
          .V_f_V = b.diode_drop_V,
          .r_d_ohm = b.diode_resistance_ohm};
}

general::Supply supply_of(const Supply& s) {
  return {.V_0_V = s.voltage_V,
          .R_b_ohm = s.resistance_ohm,
          .L_b_H = s.inductance_H,
          .C_F = s.capacitance_F,
          .sinks = s.sinks,
          .brake_ohm = s.brake_resistance_ohm,
          .brake_on_V = s.brake_on_V,
          .brake_off_V = s.brake_off_V};
}

}  // namespace

bool needs_general_plant(const Scenario& s) {
  const bool shaft =
      s.load.gear != 1 || s.load.stiffness_Nm_rad > 0 || s.load.fan_Nm_s2 > 0 || s.load.gravity_Nm != 0;
  const bool supply = s.supply.inductance_H > 0 || s.supply.brake_resistance_ohm > 0;
  const design::Sheet& m = s.sheet;
  const bool winding = !m.harmonic_orders.empty() || !m.phase_resistance_deviation.empty() ||
                       !m.phase_back_emf_deviation.empty() || !m.cogging_orders.empty() || is_salient(m) ||
                       m.connection == design::WindingConnection::delta;
  return shaft || supply || winding || s.bridge.device == Device::igbt || breaks_a_wire(s);
}

std::optional<GeneralPlant> general_plant(const Scenario& s, const Compiled& c) {
  if (!needs_general_plant(s)) return std::nullopt;
  const plant::Start& start = c.start;
  return GeneralPlant{
      .machine = machine_of(s, c),
      .shaft = shaft_of(s, c),
      .devices = devices_of(s.bridge),
      .supply = supply_of(s.supply),
      .start = {.speed_rad_s = start.speed_rad_s, .angle_rad = start.angle_rad, .bus_V = start.bus_V}};
}

}  // namespace sixstep::study

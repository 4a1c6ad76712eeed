// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/general_plant.hpp"

#include <cmath>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/plant/general/shape.hpp"
#include "sixstep/study/compile/timeline.hpp"
#include "sixstep/study/scenario/supply_voltages.hpp"
#include "sixstep/study/scenario/switching_law.hpp"

namespace sixstep::study {

namespace {

namespace general = plant::general;

general::Shape shape_of(const design::Sheet& s, const plant::Machine& from) {
  general::Shape to{.flat_deg = from.flat_deg};
  if (s.back_emf == design::BackEmfShape::table) {
    for (std::size_t n = 0; n < s.back_emf_angle_deg.size(); ++n)
      to.table.push_back({s.back_emf_angle_deg[n], s.back_emf_shape[n]});
    return to;
  }
  if (from.back_emf != plant::BackEmf::sine) return to;
  to.harmonics = {{1, 1.0}};
  for (std::size_t n = 0; n < s.harmonic_orders.size(); ++n)
    to.harmonics.push_back({static_cast<int>(s.harmonic_orders[n]), s.harmonic_sizes[n]});
  return to;
}

/// Converts the winding to the branches of a delta. The sheet's R and L between two terminals are values of
/// the equivalent star. The branches' back-EMF constant K_x follows from K_t by the sector mean without loop
/// current (model.md 7).
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

}  // namespace

general::Machine general_machine(const design::Sheet& sheet, const design::MotorModel& motor) {
  const plant::Machine& from = motor.machine;
  general::Machine to{.R_ohm = {from.R_ohm, from.R_ohm, from.R_ohm},
                      .K_e_V_s = {motor.K_e_V_s, motor.K_e_V_s, motor.K_e_V_s},
                      .L_H = from.L_H,
                      .pole_pairs = from.pole_pairs,
                      .shape = shape_of(sheet, from)};
  for (std::size_t k = 0; k < 3; ++k) {
    if (sheet.phase_resistance_deviation.size() == 3) to.R_ohm[k] *= 1 + sheet.phase_resistance_deviation[k];
    if (sheet.phase_back_emf_deviation.size() == 3) to.K_e_V_s[k] *= 1 + sheet.phase_back_emf_deviation[k];
  }
  if (sheet.saturation_current_A) {
    to.saturation_A = sheet.saturation_current_A->value;
    to.L_d_H = to.L_q_H = from.L_H;
  }
  if (design::is_salient(sheet)) {
    to.L_d_H = 1e-3 * sheet.d_axis_inductance_mH->value;
    to.L_q_H = 1e-3 * sheet.q_axis_inductance_mH->value;
  }
  for (std::size_t n = 0; n < sheet.cogging_orders.size(); ++n)
    to.cogging.push_back(
        {sheet.cogging_orders[n] * (sheet.kind == design::MotorKind::linear ? from.pole_pairs : 1.0),
         1e-3 * sheet.cogging_mNm[n],
         sheet.cogging_phase_deg.empty() ? 0.0 : sheet.cogging_phase_deg[n] * base::pi / 180});
  if (sheet.connection == design::WindingConnection::delta) connect_delta(sheet, motor.K_t_Nm_A, to);
  return to;
}

namespace {

std::vector<general::TorquePoint> torque_over_speed(const Load& l) {
  std::vector<general::TorquePoint> points;
  for (std::size_t n = 0; n < l.at_speeds_rad_s.size(); ++n)
    points.push_back({l.at_speeds_rad_s[n], l.at_speeds_Nm[n]});
  return points;
}

/// Dry friction acts at the motor's side of the gear, even if the load's keys give it.
general::Shaft shaft_of(const Scenario& s, const Compiled& c) {
  const plant::Shaft& motor = c.motor.shaft;
  return {.J_kg_m2 = motor.J_kg_m2,
          .B_Nm_s = motor.B_Nm_s,
          .coulomb_Nm = c.shaft.coulomb_Nm,
          .static_Nm = c.shaft.static_Nm,
          .gear = s.load.gear,
          .efficiency = s.load.gear_efficiency,
          .load_J_kg_m2 = s.load.inertia_kg_m2,
          .load_B_Nm_s = s.load.viscous_Nm_s,
          .stiffness_Nm = s.load.stiffness_Nm_rad,
          .damping_Nm_s = s.load.damping_Nm_s_rad,
          .load = {.fan_Nm_s2 = square_law(s.load).Nm_s2,
                   .gravity_Nm = s.load.gravity_Nm,
                   .gravity_angle_rad = s.load.gravity_angle_deg * base::pi / 180,
                   .over_speed = torque_over_speed(s.load)},
          .locked = s.load.locked,
          .dynamometer = !s.load.dynamometer_rad_s.empty()};
}

general::Devices devices_of(const Bridge& b) {
  return {.igbt = b.device == Device::igbt,
          .R_on_ohm = b.on_resistance_ohm,
          .V_ce_V = b.device == Device::igbt ? b.saturation_V : 0.0,
          .V_f_V = b.diode_drop_V,
          .r_d_ohm = b.diode_resistance_ohm};
}

general::Battery battery_of(const Supply& s) {
  general::Battery to{.capacity_C = 3600 * s.battery_capacity_Ah,
                      .R_1_ohm = s.battery_recovery_ohm,
                      .C_1_F = s.battery_recovery_F,
                      .charge = s.battery_charge};
  for (std::size_t n = 0; n < s.battery_charges.size(); ++n)
    to.open_circuit.push_back({s.battery_charges[n], s.battery_voltages_V[n]});
  return to;
}

general::Source source_of(SourceKind kind) {
  switch (kind) {
    case SourceKind::battery:
      return general::Source::battery;
    case SourceKind::single_phase:
      return general::Source::single_phase;
    case SourceKind::three_phase:
      return general::Source::three_phase;
    case SourceKind::steady:
      break;
  }
  return general::Source::steady;
}

general::Supply supply_of(const Supply& s) {
  const bool mains = s.source == SourceKind::single_phase || s.source == SourceKind::three_phase;
  return {.V_0_V = s.voltage_V,
          .R_b_ohm = s.resistance_ohm,
          .L_b_H = s.inductance_H,
          .C_F = s.capacitance_F,
          .R_C_ohm = s.capacitor_resistance_ohm,
          .sinks = s.sinks && !mains,
          .sink_A = s.sink_limit_A,
          .brake_ohm = s.brake_resistance_ohm,
          .brake_on_V = s.brake_on_V,
          .brake_off_V = s.brake_off_V,
          .source = source_of(s.source),
          .battery = battery_of(s),
          .mains = {std::sqrt(2.0) * s.mains_rms_V, s.mains_Hz, s.rectifier_drop_V}};
}

/// Motor friction heats the housing; the load's friction does not.
general::HeatGiven heat_of(const Scenario& s, const Compiled& c) {
  const Heat& h = s.heat;
  general::HeatGiven to{.motor = h.motor,
                        .devices = h.devices,
                        .step_s = h.step_s,
                        .ambient_degC = h.ambient_degC,
                        .winding_degC = h.winding_degC.value_or(h.ambient_degC),
                        .housing_degC = h.housing_degC.value_or(h.ambient_degC),
                        .copper_per_K = design::copper_per_K,
                        .magnet_per_K = -1e-2 * s.sheet.magnet_loss_percent_K,
                        .given_at_degC = design::sheet_degC,
                        .own_coulomb_Nm = c.motor.shaft.coulomb_Nm,
                        .own_B_Nm_s = c.motor.shaft.B_Nm_s,
                        .igbt = s.bridge.device == Device::igbt,
                        .switching = switching_law(s.bridge),
                        .sink_degC = s.bridge.sink_degC,
                        .junction_K_W = s.bridge.junction_K_W,
                        .on_per_K = 1e-2 * s.bridge.on_resistance_percent_K};
  if (const auto model = design::thermal_model(s.sheet)) {
    to.winding_housing_K_W = model->winding_housing_K_W;
    to.housing_ambient_K_W = model->housing_ambient_K_W;
    to.winding_s = model->winding_s;
    to.motor_s = model->motor_s;
  }
  return to;
}

/// The default bus voltage at the start: usual_V, or the open-circuit voltage of a battery.
double start_bus_V(const Scenario& s, double usual_V) {
  if (s.initial.bus_V || s.supply.source != SourceKind::battery) return usual_V;
  return open_circuit_V(s.supply, s.supply.battery_charge);
}

}  // namespace

bool needs_general_plant(const Scenario& s) {
  const Load& l = s.load;
  const bool ramps = l.between == Between::lines && !l.times_s.empty();
  const bool shaft = l.gear != 1 || l.stiffness_Nm_rad > 0 || square_law(l).Nm_s2 > 0 || l.gravity_Nm != 0 ||
                     ramps || !l.at_speeds_Nm.empty() || !l.dynamometer_rad_s.empty();
  const bool supply = s.supply.inductance_H > 0 || s.supply.brake_resistance_ohm > 0 ||
                      s.supply.source != SourceKind::steady || s.supply.capacitor_resistance_ohm > 0 ||
                      s.supply.sink_limit_A > 0;
  return shaft || supply || s.heat.motor || s.heat.devices || !design::left_to_a_run(s.sheet).empty() ||
         s.bridge.device == Device::igbt || breaks_wire_or_switch(s) || crosses_wires(s) ||
         displaces_probes(s);
}

std::optional<GeneralPlant> general_plant(const Scenario& s, const Compiled& c) {
  if (!needs_general_plant(s)) return std::nullopt;
  const plant::Start& start = c.start;
  return GeneralPlant{.machine = general_machine(s.sheet, c.motor),
                      .shaft = shaft_of(s, c),
                      .devices = devices_of(s.bridge),
                      .supply = supply_of(s.supply),
                      .start = {.speed_rad_s = s.load.dynamometer_rad_s.empty()
                                                   ? start.speed_rad_s
                                                   : s.load.gear * s.load.dynamometer_rad_s.front(),
                                .angle_rad = start.angle_rad,
                                .bus_V = start_bus_V(s, start.bus_V)},
                      .heat = heat_of(s, c)};
}

}  // namespace sixstep::study

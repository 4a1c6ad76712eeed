// SPDX-License-Identifier: Apache-2.0
// Fills the row of all columns at one instant of a run.
#pragma once
#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/rig/shaft_raw.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

/// Sets the quantities that change within a segment, at the segment's fraction s and time t. `sector`: the
/// sector of the Hall code.
template <class Plant>
void set_moving(FullRow& row, const Plant& plant, int sector, double s, double t) {
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  const auto three = [&](ColumnId first, const plant::PerLeg<double>& v) {
    for (std::size_t k = 0; k < 3; ++k) row[static_cast<std::size_t>(first) + k] = v[k];
  };
  const plant::Snapshot<double> now = plant.at(s);
  set(ColumnId::t, t);
  three(ColumnId::i_a, now.i);
  three(ColumnId::u_a, now.pole);
  three(ColumnId::u_ab, {now.pole[0] - now.pole[1], now.pole[1] - now.pole[2], now.pole[2] - now.pole[0]});
  three(ColumnId::e_a, now.emf);
  set(ColumnId::speed, now.speed);
  set(ColumnId::angle, now.angle);
  set(ColumnId::torque, now.torque);
  set(ColumnId::bus_V, now.bus);
  set(ColumnId::bus_A, now.bus_current);
  const plant::PerLeg<double> w = motor_current_weights(sector);
  set(ColumnId::i_m, w[0] * now.i[0] + w[1] * now.i[1] + w[2] * now.i[2]);
}

/// Sets the columns that only the general kernel simulates. For the lean kernel they are constants or copies
/// of other columns.
inline void set_load_side(FullRow& row, const plant::Plant<double>& plant, double s) {
  const auto& c = plant.constants();
  const auto& bus = plant.expansion().bus;
  const auto of = [&row](ColumnId id) -> double& { return row[static_cast<std::size_t>(id)]; };
  of(ColumnId::winding_degC) = of(ColumnId::housing_degC) = of(ColumnId::junction_degC) = design::sheet_degC;
  of(ColumnId::load_speed) = of(ColumnId::speed);
  of(ColumnId::load_angle) = of(ColumnId::angle);
  of(ColumnId::source_A) = of(ColumnId::bus_A);  // with a stiff bus, source current and bus current are equal
  if (!(c.inv_C > 0)) return;
  const double above = c.V_0 - series::evaluate(bus, plant.expansion().degree, s);
  of(ColumnId::source_A) = plant.mode().source_feeds ? above * c.inv_R_b : 0.0;
  of(ColumnId::capacitor_A) = of(ColumnId::source_A) - of(ColumnId::bus_A);
}
inline void set_load_side(FullRow& row, const plant::general::Plant<double>& plant, double s) {
  const auto value = [&](const Series& of) { return series::evaluate(of, plant.expansion().degree, s); };
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  const auto& c = plant.constants();
  const double angle = row[static_cast<std::size_t>(ColumnId::angle)];
  set(ColumnId::load_speed, value(plant.series().load_w));
  set(ColumnId::load_angle, c.inv_gear * angle - (c.elastic ? value(plant.series().twist) : 0.0));
  set(ColumnId::source_A,
      c.inv_C > 0 ? value(plant.series().source) : row[static_cast<std::size_t>(ColumnId::bus_A)]);
  if (c.inv_C > 0) set(ColumnId::capacitor_A, value(plant.series().capacitor_A));
  if (c.source == plant::general::Source::battery) {
    set(ColumnId::battery_charge, value(plant.series().charge));
    set(ColumnId::battery_recovery_V, value(plant.series().slow));
  }
  const plant::BodyTemperatures bodies = plant.bodies_degC(s);
  set(ColumnId::winding_degC, bodies.winding);
  set(ColumnId::housing_degC, bodies.housing);
  set(ColumnId::junction_degC, plant.heat().hottest_junction_degC());
  if (c.has_loop) set(ColumnId::loop_A, value(plant.series().loop));
}

/// Sets the columns of an encoder or a resolver.
inline void set_shaft_sensor(FullRow& row, const rig::ShaftPorts& ports,
                             const rig::ShaftMotion<double>& motion, double s, double t) {
  const rig::ShaftRaw raw = rig::shaft_raw(ports, motion.angle(s), sim::to_instant(t));
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  set(ColumnId::encoder_A, raw.lines >> 2 & 1);
  set(ColumnId::encoder_B, raw.lines >> 1 & 1);
  set(ColumnId::encoder_Z, raw.lines & 1);
  set(ColumnId::absolute_code, raw.code);
  set(ColumnId::resolver_cos_V, raw.winding_V[0]);
  set(ColumnId::resolver_sin_V, raw.winding_V[1]);
}

/// Sets the columns of an encoder or a resolver if the rig has such a sensor.
template <class Rig>
void set_shaft_sensor(FullRow& row, const Rig& rig, double s, double t) {
  const rig::ShaftPorts* const ports = rig::shaft_ports_of(rig.firmware());
  if (ports != nullptr && ports->given().kind != rig::ShaftSensor::none)
    set_shaft_sensor(row, *ports, rig.shaft_motion(s, rig.now()), s, t);
}

inline void set_field(FullRow& row, const rig::FieldTelemetry& held) {
  const auto pair = [&row](ColumnId along, const control::Dq<double>& x) {
    row[static_cast<std::size_t>(along)] = x.d;
    row[static_cast<std::size_t>(along) + 1] = x.q;
  };
  pair(ColumnId::i_d, held.measured_A);
  pair(ColumnId::i_d_ref, held.reference_A);
  pair(ColumnId::v_d, held.voltage_V);
  row[static_cast<std::size_t>(ColumnId::angle_error)] = held.angle_error_deg;
}

/// The full row of the rig at the fraction s of its segment, at time t. Columns that do not apply are filled
/// too.
template <class Rig>
FullRow full_row(const Rig& rig, double s, double t) {
  FullRow row{};
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  set_moving(row, rig.plant(), rig.probe_sector(), s, t);
  set(ColumnId::duty, signed_duty(ModulatorView(rig.modulator()), rig.board_sector()));
  set(ColumnId::i_ref, rig.current_reference_A());
  set(ColumnId::speed_ref, rig.speed_reference_rad_s());
  set(ColumnId::position_ref, rig.position_reference_deg());
  set(ColumnId::load, plant::load_torque(rig.plant(), s));
  const plant::Gates& gates = rig.leg_gates();
  for (std::size_t k = 0; k < 3; ++k) {
    row[static_cast<std::size_t>(ColumnId::gate_T1) + 2 * k] = gates.high[k];
    row[static_cast<std::size_t>(ColumnId::gate_T2) + 2 * k] = gates.low[k];
  }
  set_load_side(row, rig.plant(), s);
  set(ColumnId::hall, rig.pins());
  set(ColumnId::sector, rig.plant().sector());
  set_shaft_sensor(row, rig, s, t);
  set_field(row, rig::field_held(rig.firmware()));
  return row;
}

}  // namespace sixstep::study

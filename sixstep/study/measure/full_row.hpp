// SPDX-License-Identifier: Apache-2.0
// One instant of a run as a row of all columns.
#pragma once
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

/// What moves within a segment: the row at the fraction s of it, at time t.
template <class Plant>
void set_moving(FullRow& row, const Plant& plant, double s, double t) {
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
  const plant::PerLeg<double> w = motor_current_weights(plant.sector());
  set(ColumnId::i_m, w[0] * now.i[0] + w[1] * now.i[1] + w[2] * now.i[2]);
}

/// Beside that, what only the general kernel has.
inline void set_load_side(FullRow&, const plant::Plant<double>&, double) {}
inline void set_load_side(FullRow& row, const plant::general::Plant<double>& plant, double s) {
  const auto value = [&](const Series& of) { return series::evaluate(of, plant.expansion().degree, s); };
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  const auto& c = plant.constants();
  const double angle = row[static_cast<std::size_t>(ColumnId::angle)];
  set(ColumnId::load_speed, value(plant.series().load_w));
  set(ColumnId::load_angle, c.inv_gear * angle - (c.elastic ? value(plant.series().twist) : 0.0));
  if (c.inv_L_b > 0) set(ColumnId::source_A, value(plant.series().source));
  if (c.has_loop) set(ColumnId::loop_A, value(plant.series().loop));
}

/// Everything there is to say of the rig at the fraction s of its segment, at time t, whether it applies or
/// not.
template <class Rig>
FullRow full_row(const Rig& rig, double s, double t) {
  FullRow row{};
  const auto set = [&](ColumnId id, double v) { row[static_cast<std::size_t>(id)] = v; };
  set_moving(row, rig.plant(), s, t);
  set(ColumnId::duty, signed_duty(rig.modulator(), rig.plant().sector()));
  set(ColumnId::i_ref, rig.current_reference_A());
  set(ColumnId::speed_ref, rig.speed_reference_rad_s());
  set(ColumnId::position_ref, rig.setpoint());
  set(ColumnId::load, plant::load_torque(rig.plant(), s));
  const plant::Gates& gates = rig.plant().gates();
  for (std::size_t k = 0; k < 3; ++k) {
    row[static_cast<std::size_t>(ColumnId::gate_T1) + 2 * k] = gates.high[k];
    row[static_cast<std::size_t>(ColumnId::gate_T2) + 2 * k] = gates.low[k];
  }
  set_load_side(row, rig.plant(), s);
  set(ColumnId::hall, rig.pins());
  set(ColumnId::sector, rig.plant().sector());
  return row;
}

}  // namespace sixstep::study

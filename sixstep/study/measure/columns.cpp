// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/columns.hpp"

#include <algorithm>

#include "sixstep/base/linear.hpp"

#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/signal_choices.hpp"

namespace sixstep::study {

namespace {

/// The column of a signal, with the signal's unit. Its name is the signal's older word if there is one, else
/// the signal's word.
Column of(Signal signal, const char* frame, const char* meaning) {
  const std::string_view older = base::word(column_words, signal);
  return {std::string(older.empty() ? fact_of(signal).word : older), std::string(unit_of(signal)), frame,
          meaning};
}

std::vector<Column> turning_columns() {
  return {
      {"t_s", "s", "", "time"},
      of(Signal::phase_a, "phase, into the motor", "current of phase a"),
      of(Signal::phase_b, "phase, into the motor", "current of phase b"),
      of(Signal::phase_c, "phase, into the motor", "current of phase c"),
      of(Signal::pole_a, "pole, against the negative rail", "voltage of terminal a"),
      of(Signal::pole_b, "pole, against the negative rail", "voltage of terminal b"),
      of(Signal::pole_c, "pole, against the negative rail", "voltage of terminal c"),
      of(Signal::line_ab, "terminal", "line voltage a to b"),
      of(Signal::line_bc, "terminal", "line voltage b to c"),
      of(Signal::line_ca, "terminal", "line voltage c to a"),
      of(Signal::emf_a, "phase", "back-EMF of phase a"),
      of(Signal::emf_b, "phase", "back-EMF of phase b"),
      of(Signal::emf_c, "phase", "back-EMF of phase c"),
      of(Signal::speed, "mechanical", "speed"),
      of(Signal::angle, "mechanical", "angle, counted over turns"),
      of(Signal::torque, "air gap", "electromagnetic torque"),
      of(Signal::bus_voltage, "", "bus voltage"),
      of(Signal::bus_current, "into the bridge", "bus current"),
      of(Signal::duty, "", "signed duty in effect; with armed comparators the state of the upper switch"),
      of(Signal::current, "motor", "motor current (i_p - i_n)/2 of the positive pair"),
      of(Signal::current_reference, "motor", "current reference at the last sample"),
      of(Signal::speed_reference, "mechanical", "speed reference at the last sample"),
      of(Signal::position_reference, "mechanical", "position setpoint"),
      of(Signal::load_torque, "shaft", "load torque"),
      of(Signal::gate_T1, "", "upper gate of a"),
      of(Signal::gate_T2, "", "lower gate of a"),
      of(Signal::gate_T3, "", "upper gate of b"),
      of(Signal::gate_T4, "", "lower gate of b"),
      of(Signal::gate_T5, "", "upper gate of c"),
      of(Signal::gate_T6, "", "lower gate of c"),
      {"hall", "1", "", "Hall code, H1 H2 H3 as bits 2, 1, 0"},
      {"sector", "1", "electrical", "sector 0 to 5"},
      of(Signal::load_speed, "mechanical, of the load", "speed behind gear and elastic shaft"),
      of(Signal::load_angle, "mechanical, of the load", "angle behind gear and elastic shaft, over turns"),
      of(Signal::source_current, "out of the source", "current of the source"),
      of(Signal::loop_current, "delta",
         "sum of the branch currents, three times the current that circulates"),
      of(Signal::capacitor_current, "into the capacitor", "current of the bus capacitor"),
      of(Signal::battery_charge, "", "charge of the battery, relative to the full charge"),
      of(Signal::battery_recovery, "", "voltage of the battery that recovers slowly, v_1"),
      of(Signal::winding_temperature, "", "temperature of the winding"),
      of(Signal::housing_temperature, "", "temperature of housing and magnets"),
      of(Signal::junction_temperature, "", "temperature of the hottest switch's junction"),
      {"encoder_A", "1", "", "line A of the incremental encoder at the board's pin"},
      {"encoder_B", "1", "", "line B"},
      {"encoder_Z", "1", "", "the index line"},
      {"absolute_code", "1", "", "Gray code that the absolute encoder outputs"},
      {"resolver_cos_V", "V", "", "voltage of the resolver's cosine winding, without noise"},
      {"resolver_sin_V", "V", "", "voltage of the resolver's sine winding, without noise"},
      of(Signal::direct_current, "rotor, d",
         "field-oriented: current along the magnet as the drive assumes it, at the last sample"),
      of(Signal::quadrature_current, "rotor, q",
         "field-oriented: current across the magnet as the drive assumes it, at the last sample"),
      of(Signal::direct_current_reference, "rotor, d",
         "field-oriented: reference of the current along the magnet"),
      of(Signal::quadrature_current_reference, "rotor, q",
         "field-oriented: reference of the current across the magnet"),
      of(Signal::direct_voltage, "rotor, d", "field-oriented: commanded phase voltage along the magnet"),
      of(Signal::quadrature_voltage, "rotor, q", "field-oriented: commanded phase voltage across the magnet"),
      of(Signal::angle_error, "electrical",
         "field-oriented: error of the magnet's angle that the drive computes"),
  };
}

/// A column's name and unit for a linear motor.
struct LinearColumn {
  std::string_view turning, linear, unit;
  double factor = 1.0;
};
constexpr LinearColumn linear_names[] = {
    {"speed_rad_s", "speed_m_s", "m/s"},
    {"angle_rad", "position_mm", "mm", 1e3},
    {"torque_Nm", "force_N", "N"},
    {"speed_ref_rad_s", "speed_ref_m_s", "m/s"},
    {"position_ref_deg", "position_ref_mm", "mm", base::in_linear("deg").factor},
    {"load_Nm", "load_N", "N"},
    {"load_speed_rad_s", "load_speed_m_s", "m/s"},
    {"load_angle_rad", "load_position_mm", "mm", 1e3},
};

std::vector<Column> linear_columns() {
  std::vector<Column> columns = turning_columns();
  for (Column& column : columns) {
    for (const LinearColumn& row : linear_names)
      if (column.name == row.turning) {
        column.name = row.linear;
        column.unit = row.unit;
        column.per_turning = row.factor;
        column.meaning =
            column.meaning.starts_with("angle") ? "position" : base::linear_words(column.meaning);
        break;
      }
  }
  return columns;
}

/// True if the sensor of this column is fitted.
bool fitted(ColumnId id, RotorSensing rotor) {
  if (id <= ColumnId::encoder_Z) return rotor == RotorSensing::encoder;
  if (id == ColumnId::absolute_code) return rotor == RotorSensing::absolute;
  return rotor == RotorSensing::resolver;
}

}  // namespace

bool holds_labels(std::string_view column) {
  constexpr std::string_view labels[] = {"hall",      "sector",    "encoder_A",
                                         "encoder_B", "encoder_Z", "absolute_code"};
  return column.starts_with("gate_") ||
         std::find(std::begin(labels), std::end(labels), column) != std::end(labels);
}

const std::vector<Column>& all_columns() {
  static const std::vector<Column> columns = turning_columns();
  return columns;
}

const std::vector<Column>& all_columns(design::MotorKind kind) {
  static const std::vector<Column> linear = linear_columns();
  return kind == design::MotorKind::linear ? linear : all_columns();
}

bool applies(ColumnId id, control::Mode mode) {
  using control::Mode;
  if (id == ColumnId::i_ref || id >= ColumnId::i_d)
    return mode == Mode::current || mode == Mode::speed || mode == Mode::position;
  if (id == ColumnId::speed_ref) return mode == Mode::speed || mode == Mode::position;
  if (id == ColumnId::position_ref) return mode == Mode::position;
  return true;
}

bool applies(ColumnId id, const Scenario& s) {
  using control::Mode;
  if (id == ColumnId::load_speed || id == ColumnId::load_angle)
    return s.load.gear != 1 || s.load.stiffness_Nm_rad > 0;
  if (id == ColumnId::source_A) return s.supply.inductance_H > 0 || s.supply.source != SourceKind::steady;
  if (id == ColumnId::capacitor_A) return s.supply.capacitor_resistance_ohm > 0;
  if (id == ColumnId::winding_degC || id == ColumnId::housing_degC) return s.heat.motor;
  if (id == ColumnId::junction_degC) return s.heat.devices;
  if (id == ColumnId::battery_charge) return s.supply.source == SourceKind::battery;
  if (id == ColumnId::battery_recovery_V)
    return s.supply.source == SourceKind::battery && s.supply.battery_recovery_ohm > 0;
  if (id >= ColumnId::i_d && s.control.drive != FirmwareKind::field) return false;
  if (id == ColumnId::angle_error && s.sensors.rotor == RotorSensing::ideal &&
      s.control.field.angle == FieldAngle::sensors)
    return false;  // an ideal sensor has no angle error: the column would be 0
  if (id >= ColumnId::encoder_A && id < ColumnId::i_d) return fitted(id, s.sensors.rotor);
  if (id == ColumnId::loop_A) return s.sheet.connection == design::WindingConnection::delta;
  for (const Mode mode : {Mode::off, Mode::duty, Mode::current, Mode::speed, Mode::position})
    if (comes_into(s, mode) && applies(id, mode)) return true;
  return false;
}

base::Result<std::vector<std::size_t>> record_indices(const Scenario& scenario) {
  std::vector<std::size_t> indices = {0};
  const std::vector<Column>& columns = all_columns(scenario.sheet.kind);
  if (scenario.record.columns.empty()) {
    for (std::size_t c = 1; c < column_count; ++c)
      if (applies(static_cast<ColumnId>(c), scenario)) indices.push_back(c);
    return indices;
  }
  base::Problems problems;
  for (const std::string& name : scenario.record.columns) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
    if (found == columns.end())
      problems.push_back({"record.columns", "\"" + name + "\"", "is not a column of the trace",
                          "name one of the columns that the help on record.columns lists"});
    else if (found != columns.begin())
      indices.push_back(static_cast<std::size_t>(found - columns.begin()));
  }
  if (!problems.empty()) return problems;
  return indices;
}

base::Result<std::vector<Column>> record_columns(const Scenario& scenario) {
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();
  std::vector<Column> chosen;
  for (const std::size_t c : *indices) chosen.push_back(all_columns(scenario.sheet.kind)[c]);
  return chosen;
}

std::optional<std::size_t> column_of(Signal signal) {
  const std::string_view older = base::word(column_words, signal), word = fact_of(signal).word;
  const std::vector<Column>& all = all_columns();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (all[n].name == (older.empty() ? word : older)) return n;
  return {};
}

}  // namespace sixstep::study

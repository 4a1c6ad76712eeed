// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/check/check.hpp"

namespace sixstep::study {

namespace {

/// The reason why a column has no values, and the key that decides it.
struct NoValue {
  const char *limit, *cure;
};

NoValue no_value(ColumnId id, const Scenario& s) {
  switch (id) {
    case ColumnId::load_speed:
    case ColumnId::load_angle:
      return {"applies only to a load behind a gear or an elastic shaft, and this load turns with the rotor",
              "record speed_rad_s and angle_rad, or set load.gear or load.stiffness_Nm_rad"};
    case ColumnId::source_A:
      return {"needs a source with inductance, and supply.inductance_H = 0",
              "remove this column, or set supply.inductance_H above 0; bus_A is the bridge's current"};
    case ColumnId::capacitor_A:
      return {"needs a capacitor with resistance, and supply.capacitor_resistance_ohm = 0",
              "remove this column, or set supply.capacitor_resistance_ohm above 0"};
    case ColumnId::battery_charge:
      return {"applies to a battery only, and supply.source is not \"battery\"",
              "remove this column, or set supply.source = \"battery\""};
    case ColumnId::winding_degC:
    case ColumnId::housing_degC:
      return {"is constant while heat.motor = false", "remove this column, or set heat.motor = true"};
    case ColumnId::junction_degC:
      return {"is constant while heat.devices = false", "remove this column, or set heat.devices = true"};
    default:
      break;
  }
  if (id >= ColumnId::i_d && s.control.drive != FirmwareKind::field)
    return {"applies to the field-oriented drive only",
            "remove this column, or set control.drive = \"field-oriented\""};
  if (id == ColumnId::angle_error)
    return {"is always 0, because sensors.rotor = \"ideal\" has no angle error",
            "remove this column, or set control.field.angle = \"observer\""};
  if (id >= ColumnId::encoder_A && id < ColumnId::i_d)
    return {"is a signal of a sensor that sensors.rotor does not select",
            "remove this column, or set sensors.rotor to the sensor that has this signal"};
  return {"has no value in this control.mode",
          "remove this column, or set a control.mode that has this reference"};
}

}  // namespace

base::Problems check_columns(const Scenario& s) {
  base::Problems out;
  const auto columns = record_indices(s);
  if (!columns || s.record.columns.empty()) return out;  // check() reports unknown columns
  for (const std::size_t n : *columns) {
    const auto id = static_cast<ColumnId>(n);
    if (applies(id, s) || id == ColumnId::loop_A) continue;  // a star's loop current is 0
    const NoValue why = no_value(id, s);
    out.push_back({"record.columns", "\"" + all_columns(s.sheet.kind)[n].name + "\"", why.limit, why.cure});
  }
  return out;
}

}  // namespace sixstep::study

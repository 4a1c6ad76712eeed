// SPDX-License-Identifier: Apache-2.0
// The keys of [bridge] and [heat].
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

/// Upper bounds of three keys: ten times the values of the largest switches that are built for drives (6.5
/// kV, 1 kA: 10 J, 3 mC, 20 A).
inline constexpr double most_energy_J = 100, most_charge_C = 0.03, most_gate_A = 200;

/// Keys that affect efficiency and temperatures only.
inline void describe_losses(base::Visitor& v, Bridge& s) {
  v.value("turn_on_J", s.turn_on_J,
          {.meaning = "energy of a turn-on at energies_at_V and energies_at_A",
           .unit = "J",
           .range = between(0, most_energy_J)});
  v.value("turn_off_J", s.turn_off_J,
          {.meaning = "energy of a turn-off at energies_at_V and energies_at_A",
           .unit = "J",
           .range = between(0, most_energy_J)});
  v.value("recovery_J", s.recovery_J,
          {.meaning = "energy of a diode's reverse recovery at energies_at_V and energies_at_A",
           .unit = "J",
           .range = between(0, most_energy_J)});
  v.value(
      "energies_at_V", s.energies_at_V,
      {.meaning = "bus voltage at which the switching energies are given", .unit = "V", .range = from(0)});
  v.value("energies_at_A", s.energies_at_A,
          {.meaning = "current at which the switching energies are given", .unit = "A", .range = from(0)});
  v.value(
      "gate_current_A", s.gate_current_A,
      {.meaning =
           "mosfet: current of the gate driver; this current and the two gate charges replace the energies",
       .unit = "A",
       .range = between(0, most_gate_A)});
  v.value("gate_source_charge_C", s.gate_source_charge_C,
          {.meaning = "mosfet: gate charge while the current rises or falls, Q_gs2",
           .unit = "C",
           .range = between(0, most_charge_C)});
  v.value("gate_drain_charge_C", s.gate_drain_charge_C,
          {.meaning = "mosfet: gate charge while the voltage falls or rises, Q_gd",
           .unit = "C",
           .range = between(0, most_charge_C)});
  v.value("recovery_charge_C", s.recovery_charge_C,
          {.meaning = "mosfet: reverse recovery charge of the body diode, Q_rr",
           .unit = "C",
           .range = between(0, most_charge_C)});
  v.value("sink_degC", s.sink_degC,
          {.meaning = "temperature of the heat sink", .unit = "degC", .range = between(-100, 1000)});
  v.value(
      "junction_K_W", s.junction_K_W,
      {.meaning =
           "thermal resistance of each switch from junction to heat sink; 0: junction temperatures are not computed",
       .unit = "K/W",
       .range = from(0)});
  v.value("on_resistance_percent_K", s.on_resistance_percent_K,
          {.meaning =
               "rise of on_resistance_ohm per kelvin of the junction above 25 degC; typical of MOSFETs: 0.6",
           .unit = "percent/K",
           .range = from(0)});
}

inline void describe(base::Visitor& v, Bridge& s) {
  v.choice("phases", s.phases, phase_order_choices,
           {.meaning = "phases of the motor at legs a, b, c of the bridge"});
  v.choice("device", s.device, device_choices, {.meaning = "kind of the six switches"});
  v.value("on_resistance_ohm", s.on_resistance_ohm,
          {.meaning = "resistance of a switch that is on; for an IGBT in addition to saturation_V",
           .unit = "ohm",
           .range = from(0)});
  v.value("saturation_V", s.saturation_V,
          {.meaning = "igbt: voltage across a transistor that is on, at zero current",
           .unit = "V",
           .range = from(0)});
  v.value("diode_drop_V", s.diode_drop_V,
          {.meaning = "forward voltage of a diode at zero current", .unit = "V", .range = from(0)});
  v.value("diode_resistance_ohm", s.diode_resistance_ohm,
          {.meaning = "differential resistance of a diode", .unit = "ohm", .range = from(0)});
  v.value("dead_time_s", s.dead_time_s,
          {.meaning = "pause between the turn-off of one switch of a leg and the turn-on of the other switch",
           .unit = "s",
           .range = from(0)});
  v.value("dead_time_at_commutation", s.dead_time_at_commutation,
          {.meaning = "whether the dead time delays also the turn-ons at a commutation"});
  describe_losses(v, s);
}

inline void describe(base::Visitor& v, Heat& s) {
  v.value(
      "motor", s.motor,
      {.meaning =
           "whether winding and housing warm up by the sheet's thermal lines, and R and K_e change with them"});
  v.value(
      "devices", s.devices,
      {.meaning =
           "whether the switches' junctions warm up by bridge.junction_K_W, and on_resistance_ohm changes with their temperature"});
  v.value(
      "ambient_degC", s.ambient_degC,
      {.meaning = "temperature of the air around the motor", .unit = "degC", .range = between(-100, 1000)});
  v.value("winding_degC", s.winding_degC,
          {.meaning = "temperature of the winding at the start. Default: ambient_degC",
           .unit = "degC",
           .range = between(-100, 1000)});
  v.value("housing_degC", s.housing_degC,
          {.meaning = "temperature of housing and magnets at the start. Default: ambient_degC",
           .unit = "degC",
           .range = between(-100, 1000)});
  v.value("step_s", s.step_s,
          {.meaning = "interval at which R, K_e and on_resistance_ohm are computed from the temperatures",
           .unit = "s",
           .range = between(1e-3, 1e3)});
}

}  // namespace sixstep::study

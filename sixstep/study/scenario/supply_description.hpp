// SPDX-License-Identifier: Apache-2.0
// The keys of [supply].
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

inline void describe_battery(base::Visitor& v, Supply& s) {
  v.value(
      "battery_charges", s.battery_charges,
      {.meaning =
           "relative charges of the battery at which battery_voltages_V gives the voltages, rising; 1: full",
       .range = between(0, 1)});
  v.value("battery_voltages_V", s.battery_voltages_V,
          {.meaning = "open-circuit voltages at battery_charges; linear between the points",
           .unit = "V",
           .range = above(0)});
  v.value("battery_capacity_Ah", s.battery_capacity_Ah,
          {.meaning = "charge of the full battery", .unit = "A h", .range = from(0)});
  v.value(
      "battery_charge", s.battery_charge,
      {.meaning = "charge of the battery at the start, relative to the full charge", .range = between(0, 1)});
  v.value(
      "battery_recovery_ohm", s.battery_recovery_ohm,
      {.meaning =
           "resistance of the part of the battery's voltage that recovers slowly after a load, in series with resistance_ohm; 0: no such part",
       .unit = "ohm",
       .range = from(0)});
  v.value(
      "battery_recovery_F", s.battery_recovery_F,
      {.meaning =
           "capacitance parallel to battery_recovery_ohm; their product is the time constant of the recovery",
       .unit = "F",
       .range = from(0)});
}

inline void describe(base::Visitor& v, Supply& s) {
  v.choice(
      "source", s.source, source_choices,
      {.meaning =
           "kind of the bus's source; with a battery or mains, voltage_V is the voltage for which the drive is designed"});
  v.value("voltage_V", s.voltage_V, {.meaning = "voltage of the source", .unit = "V", .range = above(0)});
  v.value(
      "resistance_ohm", s.resistance_ohm,
      {.meaning = "resistance between the source and the bus capacitor; 0 without capacitance_F: stiff bus",
       .unit = "ohm",
       .range = from(0)});
  v.value("capacitance_F", s.capacitance_F,
          {.meaning = "capacitance of the bus capacitor, behind resistance_ohm; 0: stiff bus",
           .unit = "F",
           .range = from(0)});
  v.value("sinks", s.sinks,
          {.meaning = "whether the source takes current back; false: regeneration raises the bus voltage"});
  v.value("inductance_H", s.inductance_H,
          {.meaning = "inductance between source and bus capacitor, in series with resistance_ohm",
           .unit = "H",
           .range = from(0)});
  v.value(
      "brake_resistance_ohm", s.brake_resistance_ohm,
      {.meaning =
           "brake chopper: resistor across the bus, which is on from brake_on_V until brake_off_V; 0: no brake chopper",
       .unit = "ohm",
       .range = from(0)});
  v.value("brake_on_V", s.brake_on_V,
          {.meaning = "bus voltage above which the brake resistor is on", .unit = "V", .range = from(0)});
  v.value(
      "brake_off_V", s.brake_off_V,
      {.meaning = "bus voltage below which the brake resistor is off again", .unit = "V", .range = from(0)});
  v.value("sink_limit_A", s.sink_limit_A,
          {.meaning = "largest current that a source with sinks = false takes back",
           .unit = "A",
           .range = from(0)});
  v.value("capacitor_resistance_ohm", s.capacitor_resistance_ohm,
          {.meaning = "series resistance (ESR) of the bus capacitor", .unit = "ohm", .range = from(0)});
  describe_battery(v, s);
  v.value("mains_rms_V", s.mains_rms_V,
          {.meaning = "rms voltage of the mains: of a single phase, or between two lines of three phases",
           .unit = "V",
           .range = from(0)});
  v.value("mains_Hz", s.mains_Hz, {.meaning = "frequency of the mains", .unit = "Hz", .range = above(0)});
  v.value("rectifier_drop_V", s.rectifier_drop_V,
          {.meaning = "forward drop of one rectifier diode; two diodes conduct in series",
           .unit = "V",
           .range = from(0)});
}

}  // namespace sixstep::study

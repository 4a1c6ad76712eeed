// SPDX-License-Identifier: Apache-2.0
// The keys of a scenario file: the only place of their names, units, ranges and meanings. Defaults are the
// structs'.
#pragma once
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/at_description.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/control_description.hpp"
#include "sixstep/study/scenario/measure_description.hpp"
#include "sixstep/study/scenario/protection_description.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

template <class Visitor>
void describe(Visitor& v, Supply& s) {
  v.value("voltage_V", s.voltage_V, {.meaning = "voltage of the source", .unit = "V", .range = above(0)});
  v.value("resistance_ohm", s.resistance_ohm,
          {.meaning = "resistance of the source, feeding capacitance_F; 0 with no capacitance is a stiff bus",
           .unit = "ohm",
           .range = from(0)});
  v.value("capacitance_F", s.capacitance_F,
          {.meaning = "bus capacitor behind resistance_ohm; 0: stiff bus", .unit = "F", .range = from(0)});
  v.value("sinks", s.sinks,
          {.meaning = "whether the source takes current back; false: regeneration lifts the bus"});
  v.value("inductance_H", s.inductance_H,
          {.meaning = "inductance between source and bus capacitor, in series with resistance_ohm",
           .unit = "H",
           .range = from(0)});
  v.value("brake_resistance_ohm", s.brake_resistance_ohm,
          {.meaning = "brake chopper: resistor across the bus from brake_on_V until brake_off_V; 0: none",
           .unit = "ohm",
           .range = from(0)});
  v.value("brake_on_V", s.brake_on_V,
          {.meaning = "bus voltage above which the brake resistor is on", .unit = "V", .range = from(0)});
  v.value("brake_off_V", s.brake_off_V,
          {.meaning = "bus voltage below which it is off again", .unit = "V", .range = from(0)});
}

template <class Visitor>
void describe(Visitor& v, Bridge& s) {
  v.choice("device", s.device, device_choices, {.meaning = "kind of the six switches"});
  v.value("on_resistance_ohm", s.on_resistance_ohm,
          {.meaning = "resistance of a switch that is on; of an IGBT beside saturation_V",
           .unit = "ohm",
           .range = from(0)});
  v.value("saturation_V", s.saturation_V,
          {.meaning = "igbt: voltage across a transistor that is on, at no current",
           .unit = "V",
           .range = from(0)});
  v.value("diode_drop_V", s.diode_drop_V,
          {.meaning = "forward drop of a diode at no current", .unit = "V", .range = from(0)});
  v.value("diode_resistance_ohm", s.diode_resistance_ohm,
          {.meaning = "differential resistance of a diode", .unit = "ohm", .range = from(0)});
  v.value("dead_time_s", s.dead_time_s,
          {.meaning = "pause between turning one switch of a leg off and the other on",
           .unit = "s",
           .range = from(0)});
  v.value("dead_time_at_commutation", s.dead_time_at_commutation,
          {.meaning = "whether the dead time also delays the turn-ons of a commutation"});
}

template <class Visitor>
void describe(Visitor& v, Pwm& s) {
  v.value("period_s", s.period_s,
          {.meaning = "PWM period, and the controller's sampling period",
           .unit = "s",
           .range = between(shortest_period_s, 1)});
  v.choice("alignment", s.alignment, alignment_choices, {.meaning = "where in the period the on-time lies"});
  v.choice("chopping", s.chopping, chopping_choices, {.meaning = "which switches are chopped"});
  v.choice("commutation", s.commutation, commutation_choices, {.meaning = "when the driven pair changes"});
  v.choice("sample", s.sample, sample_choices, {.meaning = "when in the period the controller samples"});
  v.value("delay_periods", s.delay_periods,
          {.meaning = "periods from a sample until its result takes effect", .range = between(0, 1)});
  v.value("timer_Hz", s.timer_Hz,
          {.meaning = "clock of the PWM timer, which rounds on-times and dead time; 0: not rounded",
           .unit = "Hz",
           .range = from(0)});
  v.value("minimum_pulse_s", s.minimum_pulse_s,
          {.meaning =
               "on-time below which a period's pulse is left out, and off-time below which its gap closes, "
               "as gate drivers do; a duty's, no comparator's",
           .unit = "s",
           .range = from(0)});
}

template <class Visitor>
void describe(Visitor& v, Load& s) {
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "constant load torque, positive against forward motion", .unit = "N m"});
  v.value("times_s", s.times_s,
          {.meaning = "when each of torques_Nm begins, rising", .unit = "s", .range = from(0)});
  v.value("torques_Nm", s.torques_Nm,
          {.meaning = "load torques, each from its time on, instead of torque_Nm", .unit = "N m"});
  v.value(
      "viscous_Nm_s", s.viscous_Nm_s,
      {.meaning = "friction torque per rad/s, added to the motor's own", .unit = "N m s", .range = from(0)});
  v.value("coulomb_Nm", s.coulomb_Nm,
          {.meaning = "friction torque that does not depend on speed, added to the motor's own",
           .unit = "N m",
           .range = from(0)});
  v.value("static_Nm", s.static_Nm,
          {.meaning = "torque that breaks the shaft loose, where larger than the Coulomb friction",
           .unit = "N m",
           .range = from(0)});
  v.value(
      "inertia_kg_m2", s.inertia_kg_m2,
      {.meaning = "moment of inertia on the shaft, added to the rotor's", .unit = "kg m2", .range = from(0)});
  v.value(
      "gear", s.gear,
      {.meaning =
           "motor turns per turn of the load; torque, inertia and friction of the load are then at its side",
       .range = between(1e-3, 1e5)});
  v.value("stiffness_Nm_rad", s.stiffness_Nm_rad,
          {.meaning = "torsional stiffness of shaft and coupling at the load's side; 0: rigid",
           .unit = "N m/rad",
           .range = from(0)});
  v.value("damping_Nm_s_rad", s.damping_Nm_s_rad,
          {.meaning = "damping of the elastic shaft", .unit = "N m s/rad", .range = from(0)});
  v.value("fan_Nm_s2", s.fan_Nm_s2,
          {.meaning = "fan or propeller: torque per square of the load's speed, against it",
           .unit = "N m s2",
           .range = from(0)});
  v.value("gravity_Nm", s.gravity_Nm,
          {.meaning =
               "weight on an arm: torque at its horizontal, gravity_Nm sin(load angle - gravity_angle_deg)",
           .unit = "N m"});
  v.value("gravity_angle_deg", s.gravity_angle_deg,
          {.meaning = "load angle at which the weight pulls neither way", .unit = "deg"});
  v.value("locked", s.locked, {.meaning = "whether the rotor is held"});
}

template <class Visitor>
void describe(Visitor& v, Initial& s) {
  v.value("speed_rad_s", s.speed_rad_s, {.meaning = "mechanical speed at the start", .unit = "rad/s"});
  v.value("angle_rad", s.angle_rad, {.meaning = "mechanical angle at the start", .unit = "rad"});
  v.value(
      "bus_V", s.bus_V,
      {.meaning = "bus voltage at the start; without it supply.voltage_V", .unit = "V", .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, Record& s) {
  v.value("grid_s", s.grid_s,
          {.meaning = "spacing of the recorded rows; without it pwm.period_s",
           .unit = "s",
           .range = from(shortest_period_s)});
  v.value("events", s.events,
          {.meaning = "whether every event is recorded too, with both sides of each jump"});
  v.value("columns", s.columns, {.meaning = "columns to record, t_s always first; without it all of them"});
}

template <class Visitor>
void describe(Visitor& v, Spread& s) {
  v.value("key", s.key,
          {.meaning =
               "number that differs from run to run, as supply.voltage_V: of motor_override (resistance_ohm, "
               "inductance_mH, torque_constant_mNm_A or back_emf_mV_s, inertia_gcm2, viscous_friction_Nm_s, "
               "coulomb_friction_mNm, flat_deg), supply, bridge, load or initial",
           .required = true});
  v.choice("distribution", s.distribution, distribution_choices, {.meaning = "how likely each value is"});
  v.value("relative", s.relative,
          {.meaning = "half width (uniform) or standard deviation (normal), as a part of the key's value",
           .range = above(0)});
  v.value("absolute", s.absolute,
          {.meaning = "half width or standard deviation in the key's unit, instead of relative",
           .range = above(0),
           .unit_of = s.key});
  v.value("cut_sigma", s.cut_sigma,
          {.meaning = "normal: standard deviations beyond which no value is drawn", .range = from(1)});
  v.value("source", s.source, {.meaning = "where the width comes from"});
}

template <class Visitor>
void describe(Visitor& v, Scenario& s) {
  v.value("title", s.title, {.meaning = "one line that names the run"});
  v.value(
      "extends", s.extends,
      {.meaning = "a scenario beside this one whose keys hold where this one is silent, or a list of them, "
                  "the later the stronger; lists of tables add to theirs; an empty list [] or table {} drops "
                  "theirs"});
  v.value("motor", s.motor,
          {.meaning = "motor file: a path, or a name looked up beside the scenario, in the data folder and "
                      "in the built-in list",
           .required = true});
  v.value("duration_s", s.duration_s,
          {.meaning = "simulated time",
           .unit = "s",
           .range = base::Range{0, longest_s, false, true},
           .required = true});
  v.value("notes", s.notes, {.meaning = "what the run teaches, shown in the report"});
  v.table("motor_override", s.sheet,
          {.meaning = "single values that replace those of the motor file", .partial = true});
  v.table("supply", s.supply, {.meaning = "what feeds the bus"});
  v.table("bridge", s.bridge, {.meaning = "six switches with antiparallel diodes"});
  v.table("pwm", s.pwm, {.meaning = "modulation, sampling and commutation"});
  v.table("control", s.control, {.meaning = "what is controlled and how"});
  v.table("sensors", s.sensors, {.meaning = "what the controller measures with; ideal by default"});
  v.table("protection", s.protection,
          {.meaning = "what the product drive watches, how it starts and stops; with control.drive = "
                      "\"product\""});
  v.table("reference", s.reference, {.meaning = "what is wanted over time"});
  v.table("load", s.load, {.meaning = "what the shaft drives"});
  v.list("at", s.at, {.meaning = "what changes during the run", .cure = what_may_change});
  v.table("initial", s.initial, {.meaning = "state at the start"});
  v.table("record", s.record, {.meaning = "what is written to the trace"});
  v.list("require", s.require, {.meaning = "figures that decide whether the run passes"});
  v.list("compare", s.compare, {.meaning = "figures shown beside those of a source; they decide nothing"});
  v.list("spread", s.spread,
         {.meaning = "how drives of a series differ, for many runs; the controller stays designed "
                     "for the values as written"});
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// The keys of a scenario file: the only place of their names, units, ranges and meanings. Defaults are the
// structs'.
#pragma once
#include "sixstep/design/sheet_description.hpp"
#include "sixstep/study/choices.hpp"
#include "sixstep/study/sensors_description.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

/// Time is counted in picoseconds of 63 bits, 106 days; and what repeats must be many of them long.
inline constexpr double longest_s = 9e6;
inline constexpr double shortest_period_s = 1e-9;

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
}

template <class Visitor>
void describe(Visitor& v, Bridge& s) {
  v.choice("device", s.device, device_choices, {.meaning = "kind of the six switches"});
  v.value("on_resistance_ohm", s.on_resistance_ohm,
          {.meaning = "resistance of a switch that is on", .unit = "ohm", .range = from(0)});
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
}

/// The three ways to say a PI's gains, the same in every loop.
template <class Visitor, class Loop>
void describe_gains(Visitor& v, Loop& s) {
  v.value(
      "settle_s", s.settle_s,
      {.meaning = "settling time the poles are placed for, with damping", .unit = "s", .range = above(0)});
  v.value(
      "damping", s.damping,
      {.meaning = "damping of the placed pole pair, with settle_s", .range = base::Range{0, 1, false, true}});
  v.value("d1", s.d1, {.meaning = "gain on the present error of (d1 z + d0)/(z - 1), with d0"});
  v.value("d0", s.d0, {.meaning = "gain on the previous error of (d1 z + d0)/(z - 1), with d1"});
  v.value("kp", s.kp, {.meaning = "proportional gain, with ki: kp = d1"});
  v.value("ki", s.ki, {.meaning = "integral gain per sample, with kp: ki = d1 + d0"});
}

template <class Visitor>
void describe(Visitor& v, CurrentLoop& s) {
  v.choice("type", s.type, current_loop_choices, {.meaning = "kind of the current controller"});
  describe_gains(v, s);
  v.value(
      "band_A", s.band_A,
      {.meaning = "hysteresis: half width of the band around the reference", .unit = "A", .range = above(0)});
  v.choice("on", s.on, hysteresis_choices, {.meaning = "hysteresis: which current is watched"});
  v.choice("comparator", s.comparator, comparator_choices,
           {.meaning = "hysteresis: when the band is looked at"});
  v.value("limit_A", s.limit_A,
          {.meaning = "bound on the current reference that an outer loop asks for",
           .unit = "A",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, SpeedLoop& s) {
  describe_gains(v, s);
  v.value("torque_limit_Nm", s.torque_limit_Nm,
          {.meaning = "torque at the speed controller's full output; without it the sheet's stall torque",
           .unit = "N m",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, PositionLoop& s) {
  v.value(
      "gain_rad_s_per_deg", s.gain_rad_s_per_deg,
      {.meaning = "speed asked for per degree of position error", .unit = "rad/s/deg", .range = above(0)});
  v.value(
      "speed_limit_rad_s", s.speed_limit_rad_s,
      {.meaning = "bound on the speed that the position loop asks for", .unit = "rad/s", .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, FullScale& s) {
  v.value("current_A", s.current_A,
          {.meaning = "largest current and difference of currents that a number holds; without it three "
                      "times the largest reference or limit, or what the bus can drive on top of one",
           .unit = "A",
           .range = above(0)});
  v.value("voltage_V", s.voltage_V,
          {.meaning = "largest voltage; without it supply.voltage_V", .unit = "V", .range = above(0)});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning = "largest speed and difference of speeds; without it that of no load and no loss, and the "
                  "largest reference",
       .unit = "rad/s",
       .range = above(0)});
  v.value("position_deg", s.position_deg,
          {.meaning = "largest position and difference of positions; without it twice the largest reference",
           .unit = "deg",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, Regeneration& s) {
  v.value("limit_V", s.limit_V,
          {.meaning = "bus voltage at which the drive no longer brakes", .unit = "V", .range = above(0)});
  v.value(
      "gain_A_per_V", s.gain_A_per_V,
      {.meaning = "braking current per volt below limit_V; without it a tenth of supply.capacitance_F over "
                  "pwm.period_s",
       .unit = "A/V",
       .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, Control& s) {
  v.choice("mode", s.mode, mode_choices, {.meaning = "what is controlled, and so what the reference means"});
  v.choice("arithmetic", s.arithmetic, arithmetic_choices,
           {.meaning = "number type the controller computes in"});
  v.table("full_scale", s.full_scale, {.meaning = "fixed point: what the ends of the range stand for"});
  v.table("current", s.current, {.meaning = "the current controller"});
  v.table("speed", s.speed, {.meaning = "the speed controller around it"});
  v.table("position", s.position, {.meaning = "the position controller around both"});
  v.table("regeneration", s.regeneration,
          {.meaning = "limit of the current that braking returns to the bus"});
}

template <class Visitor>
void describe(Visitor& v, Reference& s) {
  v.choice("shape", s.shape, shape_choices, {.meaning = "how the reference runs over time"});
  v.value("value", s.value, {.meaning = "constant: the reference, in the unit of control.mode"});
  v.value("times_s", s.times_s,
          {.meaning = "steps: when each of values begins, rising", .unit = "s", .range = from(0)});
  v.value("values", s.values, {.meaning = "steps: the references, in the unit of control.mode"});
  v.value("high", s.high, {.meaning = "square: first half of each period, in the unit of control.mode"});
  v.value("low", s.low, {.meaning = "square: second half of each period, in the unit of control.mode"});
  v.value("period_s", s.period_s,
          {.meaning = "square: length of one period", .unit = "s", .range = from(shortest_period_s)});
  v.value("unit", s.unit,
          {.meaning = "unit of the reference, to be checked: 1, A, rad/s or deg as control.mode asks"});
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
void describe(Visitor& v, Measure& s) {
  v.choice("metric", s.metric, metric_choices,
           {.meaning = "figure that is taken of the signal", .required = true});
  v.choice("signal", s.signal, signal_choices, {.meaning = "signal that the figure is taken of"});
  v.value("from_s", s.from_s,
          {.meaning = "start of the window; without it the start of the run", .unit = "s", .range = from(0)});
  v.value("to_s", s.to_s,
          {.meaning = "end of the window; without it the end of the run", .unit = "s", .range = above(0)});
  v.value("level", s.level, {.meaning = "value to be reached, in the signal's unit"});
  v.value("start", s.start,
          {.meaning = "value the step starts from, in the signal's unit; without it the value at from_s"});
  v.value("fraction", s.fraction,
          {.meaning = "reach_time_s: part of the way from start to level",
           .range = base::Range{0, 1, false, true}});
  v.value("band", s.band,
          {.meaning = "settling_time_s: half width of the band as part of the step", .range = above(0)});
  v.value("sampled", s.sampled, {.meaning = "whether only the controller's samples are looked at"});
  v.value("label", s.label, {.meaning = "name of the figure, instead of metric and signal"});
}

template <class Visitor>
void describe(Visitor& v, Requirement& s) {
  describe(v, s.measure);
  v.value("min", s.min, {.meaning = "the figure must be at least this, in the figure's unit"});
  v.value("max", s.max, {.meaning = "the figure must be at most this, in the figure's unit"});
}

template <class Visitor>
void describe(Visitor& v, Comparison& s) {
  describe(v, s.measure);
  v.value("value", s.value, {.meaning = "what the source says, in the figure's unit", .required = true});
  v.value("source", s.source, {.meaning = "where the value comes from", .required = true});
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
           .range = above(0)});
  v.value("cut_sigma", s.cut_sigma,
          {.meaning = "normal: standard deviations beyond which no value is drawn", .range = from(1)});
  v.value("source", s.source, {.meaning = "where the width comes from"});
}

template <class Visitor>
void describe(Visitor& v, Scenario& s) {
  v.value("title", s.title, {.meaning = "one line that names the run"});
  v.value(
      "motor", s.motor,
      {.meaning =
           "motor file: a path, or a name looked up beside the scenario, in --data and in the built-in list",
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
  v.table("reference", s.reference, {.meaning = "what is wanted over time"});
  v.table("load", s.load, {.meaning = "what the shaft drives"});
  v.table("initial", s.initial, {.meaning = "state at the start"});
  v.table("record", s.record, {.meaning = "what is written to the trace"});
  v.list("require", s.require, {.meaning = "figures that decide whether the run passes"});
  v.list("compare", s.compare, {.meaning = "figures shown beside those of a source; they decide nothing"});
  v.list("spread", s.spread,
         {.meaning = "how drives of a series differ, for sixstep run --runs; the controller stays designed "
                     "for the values as written"});
}

}  // namespace sixstep::study

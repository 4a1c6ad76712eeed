// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/scenario_description.hpp"

#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/scenario/at_description.hpp"
#include "sixstep/study/scenario/believed_description.hpp"
#include "sixstep/study/scenario/bridge_description.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/control_description.hpp"
#include "sixstep/study/scenario/linear_words.hpp"
#include "sixstep/study/scenario/load_description.hpp"
#include "sixstep/study/scenario/measure_description.hpp"
#include "sixstep/study/scenario/protection_description.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"
#include "sixstep/study/scenario/supply_description.hpp"

namespace sixstep::study {

using base::above;
using base::between;
using base::from;

void describe(base::Visitor& v, Pwm& s) {
  v.value("period_s", s.period_s,
          {.meaning = "PWM period, 1 over its frequency, and the controller's sampling period",
           .unit = "s",
           .range = between(shortest_period_s, 1)});
  v.choice("alignment", s.alignment, alignment_choices, {.meaning = "where the on-time lies in the period"});
  v.choice("chopping", s.chopping, chopping_choices, {.meaning = "chopped switches"});
  v.choice("pattern", s.pattern, pattern_choices,
           {.meaning = "which switch of the pair is chopped, where chopping is soft or complementary"});
  v.choice("commutation", s.commutation, commutation_choices, {.meaning = "when the driven pair changes"});
  v.choice("sample", s.sample, sample_choices, {.meaning = "when the controller samples in the period"});
  v.value("delay_periods", s.delay_periods,
          {.meaning = "control periods from a sample until the command that follows from it takes effect",
           .range = between(0, 1)});
  v.value("timer_Hz", s.timer_Hz,
          {.meaning = "clock of the PWM timer, which rounds on-times and dead time; 0: not rounded",
           .unit = "Hz",
           .range = from(0)});
  v.value(
      "minimum_pulse_s", s.minimum_pulse_s,
      {.meaning =
           "on-time below which a pulse is omitted, and off-time below which the gap is closed, as gate drivers do; applies to duties, not to comparators",
       .unit = "s",
       .range = from(0)});
}

void describe(base::Visitor& v, Initial& s) {
  v.value("speed_rad_s", s.speed_rad_s,
          {.meaning = "mechanical speed at the start", .unit = "rad/s", .also = words::speed});
  v.value("angle_rad", s.angle_rad,
          {.meaning = "mechanical angle at the start", .unit = "rad", .also = words::position});
  v.value("bus_V", s.bus_V,
          {.meaning = "bus voltage at the start. Default: supply.voltage_V", .unit = "V", .range = above(0)});
}

void describe(base::Visitor& v, Record& s) {
  v.value("grid_s", s.grid_s,
          {.meaning = "spacing of the recorded rows. Default: pwm.period_s",
           .unit = "s",
           .range = from(shortest_period_s)});
  v.value(
      "events", s.events,
      {.meaning =
           "whether rows are recorded at every event, with both sides of each jump, instead of on the grid"});
  v.value("columns", s.columns, {.meaning = "columns to record, t_s always first. Default: all columns"});
}

void describe(base::Visitor& v, Spread& s) {
  v.value(
      "key", s.key,
      {.meaning =
           "number that differs from run to run, such as supply.voltage_V. Allowed: motor_override "
           "(resistance_ohm, inductance_mH, torque_constant_mNm_A or back_emf_mV_s, inertia_gcm2, "
           "viscous_friction_Nm_s, coulomb_friction_mNm, iron_viscous_Nm_s, iron_coulomb_mNm, flat_deg); "
           "supply, bridge, load, initial or believed; a Hall edge (sensors.hall_edges_deg[0], the first one), "
           "sensors.hall_offset_deg, or offset_deg of sensors.encoder, absolute or resolver",
       .required = true});
  v.choice("distribution", s.distribution, distribution_choices,
           {.meaning = "probability distribution of the values"});
  v.value("relative", s.relative,
          {.meaning = "half width (uniform) or standard deviation (normal), as a fraction of the key's value",
           .range = above(0)});
  v.value("absolute", s.absolute,
          {.meaning = "half width or standard deviation in the key's unit, instead of relative",
           .range = above(0),
           .unit_of = s.key});
  v.value("cut_sigma", s.cut_sigma,
          {.meaning = "normal: standard deviations beyond which no value is drawn", .range = from(1)});
  v.value("source", s.source, {.meaning = "where the width comes from, such as a data sheet"});
}

void describe(base::Visitor& v, Scenario& s) {
  v.value("title", s.title, {.meaning = "title of the run, one line"});
  v.value(
      "extends", s.extends,
      {.meaning =
           "another scenario file, or a list of files, whose keys apply where this file does not set them; a later file of the list overrides an earlier file. Lists of tables are appended; an empty list [] or table {} removes the inherited list or table"});
  v.value(
      "motor", s.motor,
      {.meaning =
           "motor file: a path, or a name that is searched beside the scenario, in the data folder and in the built-in list",
       .required = true});
  v.value("duration_s", s.duration_s,
          {.meaning = "simulated time",
           .unit = "s",
           .range = base::Range{0, longest_s, false, true},
           .required = true});
  v.value("notes", s.notes, {.meaning = "notes on the purpose of the run, shown in the report"});
  v.value(
      "not_usable", s.not_usable,
      {.meaning =
           "reason for which the design is not usable. A design writes this line and each run prints it; while this line is present, no header is exported"});
  v.table("motor_override", s.sheet,
          {.meaning = "values that replace single values of the motor file", .partial = true});
  v.table(
      "believed", s.believed,
      {.meaning =
           "wrong values of motor and sensor that the drive assumes; the drive's design, firmware and exported header use these values, the simulated motor uses the true values"});
  v.table("supply", s.supply, {.meaning = "source of the bus"});
  v.table("bridge", s.bridge, {.meaning = "six switches with antiparallel diodes"});
  v.table("heat", s.heat,
          {.meaning = "whether the run simulates the temperatures of motor and switches; not by default"});
  v.table("pwm", s.pwm, {.meaning = "modulation, sampling and commutation"});
  v.table("control", s.control, {.meaning = "controlled quantity and its controllers"});
  v.table("sensors", s.sensors, {.meaning = "sensors of the controller; ideal by default"});
  v.table("protection", s.protection,
          {.meaning = "fault thresholds of the product drive, its start and its stop; with control.drive = "
                      "\"product\""});
  v.table("reference", s.reference, {.meaning = "setpoint over time"});
  v.table("load", s.load, {.meaning = "load on the shaft"});
  v.list("at", s.at, {.meaning = "changes during the run", .cure = what_may_change});
  v.table("initial", s.initial, {.meaning = "state at the start"});
  v.table("record", s.record, {.meaning = "columns and times of the trace"});
  v.list("require", s.require, {.meaning = "figures that decide whether the run passes"});
  v.list("compare", s.compare,
         {.meaning = "figures shown beside the values of a source, or a recording laid over a signal; only "
                     "tolerance_percent makes them affect the verdict"});
  v.list("spread", s.spread,
         {.meaning = "differences between the drives of a series; the controller stays designed for the "
                     "values as written"});
}

}  // namespace sixstep::study

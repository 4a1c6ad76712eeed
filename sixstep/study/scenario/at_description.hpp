// SPDX-License-Identifier: Apache-2.0
// The keys of [[at]]: values that can change during a run.
#pragma once
#include "sixstep/base/visitor.hpp"
#include "sixstep/study/scenario/at_sensors_description.hpp"
#include "sixstep/study/scenario/control_description.hpp"
#include "sixstep/study/scenario/linear_words.hpp"
#include "sixstep/study/scenario/reference_description.hpp"

namespace sixstep::study {

inline void describe(base::Visitor& v, AtSupply& s) {
  v.value("voltage_V", s.voltage_V,
          {.meaning = "voltage of the source from time_s on; a stiff bus takes this voltage at once",
           .unit = "V",
           .range = base::above(0)});
  v.value("sinks", s.sinks, {.meaning = "whether the source takes current back from time_s on"});
}

inline void describe(base::Visitor& v, AtLoad& s) {
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "load torque from time_s on, until the next of load.times_s",
           .unit = "N m",
           .also = words::force});
  v.value("locked", s.locked,
          {.meaning = "true: a clamp stops the rotor at once and holds it; false: the rotor is released"});
}

inline constexpr base::Choice<AtMode> at_mode_choices[] = {
    {"same", AtMode::same, "as before"},
    {"off", AtMode::off, mode_choices[0].meaning},
    {"duty", AtMode::duty, mode_choices[1].meaning},
    {"current", AtMode::current, mode_choices[2].meaning},
    {"speed", AtMode::speed, mode_choices[3].meaning},
    {"position", AtMode::position, mode_choices[4].meaning},
};
inline constexpr base::Choice<AtChopping> at_chopping_choices[] = {
    {"same", AtChopping::same, "as before"},
    {"soft", AtChopping::soft, chopping_choices[0].meaning},
    {"hard", AtChopping::hard, chopping_choices[1].meaning},
    {"complementary", AtChopping::complementary, chopping_choices[2].meaning},
};

inline void describe(base::Visitor& v, AtCurrentLoop& s) {
  describe_gains(v, s, current_gain_meanings);
  v.value("band_A", s.band_A,
          {.meaning = "hysteresis: half width of the band around the reference from time_s on",
           .unit = "A",
           .range = above(0)});
  v.value("limit_A", s.limit_A,
          {.meaning = "bound on an outer loop's current reference from time_s on",
           .unit = "A",
           .range = above(0)});
}

inline void describe(base::Visitor& v, AtSpeedLoop& s) {
  describe_gains(v, s, speed_gain_meanings);
  v.value("torque_limit_Nm", s.torque_limit_Nm,
          {.meaning = "torque at the speed controller's full output from time_s on",
           .unit = "N m",
           .range = above(0),
           .also = words::force_limit});
}

inline void describe(base::Visitor& v, AtPositionLoop& s) {
  v.value(
      "gain_rad_s_per_deg", s.gain_rad_s_per_deg,
      {.meaning = "gain of the position loop from time_s on: speed reference per degree of position error",
       .unit = "rad/s/deg",
       .range = above(0),
       .also = words::position_gain});
  v.value("speed_limit_rad_s", s.speed_limit_rad_s,
          {.meaning = "bound on the position loop's speed reference from time_s on",
           .unit = "rad/s",
           .range = above(0),
           .also = words::speed_limit});
}

inline void describe(base::Visitor& v, AtLimits& s) {
  v.value("current_A", s.current_A,
          {.meaning = "bound on the current reference from time_s on", .unit = "A", .range = above(0)});
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "bound on the current reference as a torque: the torque divided by K_t is the current",
           .unit = "N m",
           .range = above(0),
           .also = words::force});
  v.value(
      "speed_rad_s", s.speed_rad_s,
      {.meaning =
           "speed limit of the drive's own torque from time_s on; above this speed all gates are off, unless the drive brakes",
       .unit = "rad/s",
       .range = above(0),
       .also = words::speed});
}

inline constexpr base::Choice<AtCommutates> at_commutates_choices[] = {
    {"same", AtCommutates::same, "as before"},
    {"back-emf", AtCommutates::back_emf, commutates_choices[0].meaning},
    {"hall", AtCommutates::hall, commutates_choices[1].meaning},
};

inline void describe(base::Visitor& v, AtSensorless& s) {
  v.choice(
      "commutates", s.commutates, at_commutates_choices,
      {.meaning =
           "sensorless drive: source of the commutation, from the instant at which both sources give the same sector"});
}

inline void describe(base::Visitor& v, AtControl& s) {
  v.choice(
      "mode", s.mode, at_mode_choices,
      {.meaning =
           "controlled quantity from the next control sample on; the event must give a reference in the unit of this mode"});
  v.table("current", s.current, {.meaning = "the current controller", .cure = what_may_change});
  v.table("speed", s.speed, {.meaning = "the speed controller", .cure = what_may_change});
  v.table("position", s.position, {.meaning = "the position controller", .cure = what_may_change});
  v.value("slew", s.slew,
          {.meaning = "fastest change of the setpoint from time_s on, in the mode's unit per second",
           .range = above(0),
           .mode_unit = "*/s"});
  v.table("limits", s.limits, {.meaning = "limits of the current reference", .cure = what_may_change});
  v.table("sensorless", s.sensorless, {.meaning = "the sensorless drive", .cure = what_may_change});
}

inline void describe(base::Visitor& v, AtPwm& s) {
  v.choice("chopping", s.chopping, at_chopping_choices,
           {.meaning = "chopped switches from the next control sample on"});
}

inline constexpr base::Choice<Switch> switch_choices[] = {
    {"none", Switch::none, "none fails"},        {"T1", Switch::T1, "upper switch of leg a"},
    {"T2", Switch::T2, "lower switch of leg a"}, {"T3", Switch::T3, "upper switch of leg b"},
    {"T4", Switch::T4, "lower switch of leg b"}, {"T5", Switch::T5, "upper switch of leg c"},
    {"T6", Switch::T6, "lower switch of leg c"},
};
inline constexpr base::Choice<AtOrder> at_phase_order_choices[] = {
    {"same", AtOrder::same, "as before"},
    {"abc", AtOrder::abc, phase_order_choices[0].meaning},
    {"bca", AtOrder::bca, phase_order_choices[1].meaning},
    {"cab", AtOrder::cab, phase_order_choices[2].meaning},
    {"acb", AtOrder::acb, phase_order_choices[3].meaning},
    {"cba", AtOrder::cba, phase_order_choices[4].meaning},
    {"bac", AtOrder::bac, phase_order_choices[5].meaning},
};

inline void describe(base::Visitor& v, AtBridge& s) {
  v.choice("open_switch", s.open_switch, switch_choices,
           {.meaning = "a switch that stays off from time_s on; its diode still conducts"});
  v.choice(
      "shorted_switch", s.shorted_switch, switch_choices,
      {.meaning =
           "a switch that stays on from time_s on: turning on the other switch of its leg causes shoot-through"});
  v.choice("phases", s.phases, at_phase_order_choices,
           {.meaning = "phases of the motor at legs a, b, c of the bridge from time_s on"});
  v.value(
      "dead_time_s", s.dead_time_s,
      {.meaning =
           "pause between the turn-off of one switch of a leg and the turn-on of the other switch, from time_s on",
       .unit = "s",
       .range = from(0)});
}

inline constexpr base::Choice<Wire> wire_choices[] = {
    {"none", Wire::none, "all three wires are intact"},
    {"a", Wire::a, "the wire of terminal a"},
    {"b", Wire::b, "the wire of terminal b"},
    {"c", Wire::c, "the wire of terminal c"},
};

inline void describe(base::Visitor& v, AtMotor& s) {
  v.choice(
      "broken_wire", s.broken_wire, wire_choices,
      {.meaning =
           "a wire that breaks at time_s: the wire opens when its current is next zero, and stays open"});
}

inline void describe(base::Visitor& v, At& s) {
  v.value("time_s", s.time_s,
          {.meaning = "when", .unit = "s", .range = base::between(0, longest_s), .required = true});
  v.table("reference", s.reference,
          {.meaning = "the reference from time_s on; its times count from time_s", .cure = what_may_change});
  v.table("supply", s.supply, {.meaning = "the source from time_s on", .cure = what_may_change});
  v.table("load", s.load, {.meaning = "the load from time_s on", .cure = what_may_change});
  v.table("sensors", s.sensors, {.meaning = "changes and faults of the sensors", .cure = what_may_change});
  v.choice("request", s.request, request_choices, {.meaning = "request to the product drive"});
  v.table(
      "control", s.control,
      {.meaning =
           "changes of the controller from the next control sample on; loops that stay active keep their state",
       .cure = what_may_change});
  v.table("pwm", s.pwm, {.meaning = "the modulation from time_s on", .cure = what_may_change});
  v.table("bridge", s.bridge, {.meaning = "the bridge from time_s on", .cure = what_may_change});
  v.table("motor", s.motor, {.meaning = "faults of the motor", .cure = what_may_change});
}

}  // namespace sixstep::study

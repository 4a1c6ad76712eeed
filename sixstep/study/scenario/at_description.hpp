// SPDX-License-Identifier: Apache-2.0
// The keys of [[at]]: what may change while a run goes on.
#pragma once
#include "sixstep/study/scenario/control_description.hpp"
#include "sixstep/study/scenario/reference_description.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

/// What is told to whoever asks for anything else.
inline constexpr std::string_view what_may_change =
    "during a run change only: reference; supply.voltage_V, supply.sinks; load.torque_Nm, load.locked; "
    "sensors.hall_break; request; control.mode, .slew, .current (its gains, band_A, limit_A), .speed (its "
    "gains, torque_limit_Nm), .position, .limits (current_A, torque_Nm, speed_rad_s); pwm.chopping; "
    "bridge.dead_time_s; motor.broken_wire";

template <class Visitor>
void describe(Visitor& v, AtSupply& s) {
  v.value("voltage_V", s.voltage_V,
          {.meaning = "voltage of the source from then on; a stiff bus follows at once",
           .unit = "V",
           .range = base::above(0)});
  v.value("sinks", s.sinks, {.meaning = "whether the source takes current back from then on"});
}

template <class Visitor>
void describe(Visitor& v, AtLoad& s) {
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "load torque from then on, until the next of load.times_s", .unit = "N m"});
  v.value("locked", s.locked,
          {.meaning = "true: a clamp stops the rotor at once and holds it; false: it is let go"});
}

inline constexpr base::Choice<PinLevel> pin_level_choices[] = {
    {"low", PinLevel::low, "0, as a line that is shorted to ground"},
    {"high", PinLevel::high, "1, as a line that is cut before its pull-up"},
    {"probe", PinLevel::probe, "what its probe says: the break is over, and was a glitch"},
};

template <class Visitor>
void describe(Visitor& v, AtHallBreak& s) {
  v.value("line", s.line, {.meaning = "which of H1, H2, H3", .range = base::between(1, 3)});
  v.choice("level", s.level, pin_level_choices, {.meaning = "what the pin reads from then on"});
}

template <class Visitor>
void describe(Visitor& v, AtSensors& s) {
  v.table("hall_break", s.hall_break, {.meaning = "a Hall line that breaks then, or is whole again"});
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

template <class Visitor>
void describe(Visitor& v, AtCurrentLoop& s) {
  describe_gains(v, s);
  v.value("band_A", s.band_A,
          {.meaning = "hysteresis: half width of the band from then on", .unit = "A", .range = above(0)});
  v.value("limit_A", s.limit_A,
          {.meaning = "bound on the current reference that an outer loop asks for from then on",
           .unit = "A",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, AtSpeedLoop& s) {
  describe_gains(v, s);
  v.value("torque_limit_Nm", s.torque_limit_Nm,
          {.meaning = "torque at the speed controller's full output from then on",
           .unit = "N m",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, AtPositionLoop& s) {
  v.value("gain_rad_s_per_deg", s.gain_rad_s_per_deg,
          {.meaning = "speed asked for per degree of position error from then on",
           .unit = "rad/s/deg",
           .range = above(0)});
  v.value("speed_limit_rad_s", s.speed_limit_rad_s,
          {.meaning = "bound on the speed that the position loop asks for from then on",
           .unit = "rad/s",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, AtLimits& s) {
  v.value("current_A", s.current_A,
          {.meaning = "bound on the current reference from then on", .unit = "A", .range = above(0)});
  v.value("torque_Nm", s.torque_Nm,
          {.meaning = "the same as a torque, over K_t", .unit = "N m", .range = above(0)});
  v.value("speed_rad_s", s.speed_rad_s,
          {.meaning = "speed that the drive's own torque does not pass from then on",
           .unit = "rad/s",
           .range = above(0)});
}

template <class Visitor>
void describe(Visitor& v, AtControl& s) {
  v.choice("mode", s.mode, at_mode_choices,
           {.meaning = "what is controlled from the next control sample on; with a reference in its unit"});
  v.table("current", s.current, {.meaning = "the current controller", .cure = what_may_change});
  v.table("speed", s.speed, {.meaning = "the speed controller", .cure = what_may_change});
  v.table("position", s.position, {.meaning = "the position controller", .cure = what_may_change});
  v.value("slew", s.slew,
          {.meaning = "fastest change of the setpoint from then on, in the mode's unit per second",
           .range = above(0),
           .mode_unit = "*/s"});
  v.table("limits", s.limits, {.meaning = "limits of the current reference", .cure = what_may_change});
}

template <class Visitor>
void describe(Visitor& v, AtPwm& s) {
  v.choice("chopping", s.chopping, at_chopping_choices,
           {.meaning = "which switches are chopped from the next control sample on"});
}

template <class Visitor>
void describe(Visitor& v, AtBridge& s) {
  v.value("dead_time_s", s.dead_time_s,
          {.meaning =
               "pause between turning one switch of a leg off and the other on, of the changes from then on",
           .unit = "s",
           .range = from(0)});
}

inline constexpr base::Choice<Wire> wire_choices[] = {
    {"none", Wire::none, "all three are whole"},
    {"a", Wire::a, "the wire of terminal a"},
    {"b", Wire::b, "the wire of terminal b"},
    {"c", Wire::c, "the wire of terminal c"},
};

template <class Visitor>
void describe(Visitor& v, AtMotor& s) {
  v.choice("broken_wire", s.broken_wire, wire_choices,
           {.meaning = "a wire that breaks then: it opens at its current's next zero, and stays open"});
}

template <class Visitor>
void describe(Visitor& v, At& s) {
  v.value("time_s", s.time_s,
          {.meaning = "when", .unit = "s", .range = base::between(0, longest_s), .required = true});
  v.table("reference", s.reference,
          {.meaning = "the reference from then on; its times count from time_s", .cure = what_may_change});
  v.table("supply", s.supply, {.meaning = "the source from then on", .cure = what_may_change});
  v.table("load", s.load, {.meaning = "the load from then on", .cure = what_may_change});
  v.table("sensors", s.sensors, {.meaning = "what happens to the sensors", .cure = what_may_change});
  v.choice("request", s.request, request_choices, {.meaning = "what the product drive is asked for"});
  v.table("control", s.control,
          {.meaning = "the controller from its next sample on; loops that go on keep their state",
           .cure = what_may_change});
  v.table("pwm", s.pwm, {.meaning = "the modulation from then on", .cure = what_may_change});
  v.table("bridge", s.bridge, {.meaning = "the bridge from then on", .cure = what_may_change});
  v.table("motor", s.motor, {.meaning = "what happens to the motor", .cure = what_may_change});
}

}  // namespace sixstep::study

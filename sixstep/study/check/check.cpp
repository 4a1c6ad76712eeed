// SPDX-License-Identifier: Apache-2.0
// What no range of a single value can say: keys that contradict each other or ask for what is not there.
#include "sixstep/study/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/check/measures.hpp"
#include "sixstep/study/check/numbers.hpp"
#include "sixstep/study/check/pace.hpp"
#include "sixstep/study/check/product.hpp"
#include "sixstep/study/check/reference.hpp"
#include "sixstep/study/check/sensors.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace sixstep::study {

namespace {

std::string number(double v) { return base::rounded(v, 6); }

void check_brake(const Supply& s, bool has_capacitor, base::Problems& out) {
  const double R = s.brake_resistance_ohm;
  if (!(R > 0)) {
    if (s.brake_on_V > 0 || s.brake_off_V > 0)
      out.push_back({s.brake_on_V > 0 ? "supply.brake_on_V" : "supply.brake_off_V",
                     number(s.brake_on_V > 0 ? s.brake_on_V : s.brake_off_V),
                     "has no brake resistor to switch", "give supply.brake_resistance_ohm"});
    return;
  }
  if (!has_capacitor)
    out.push_back({"supply.brake_resistance_ohm", number(R), "needs a bus whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (!(s.brake_on_V > s.brake_off_V) || !(s.brake_off_V > 0))
    out.push_back({"supply.brake_on_V", number(s.brake_on_V),
                   "must be above supply.brake_off_V = " + number(s.brake_off_V) + ", and that above 0",
                   "give both, as brake_on_V = 30, brake_off_V = 28"});
  else if (!(s.brake_off_V > s.voltage_V))
    out.push_back({"supply.brake_off_V", number(s.brake_off_V),
                   "must be above supply.voltage_V = " + number(s.voltage_V),
                   "the resistor would never be off again"});
}

void check_shaft(const Scenario& s, base::Problems& out) {
  const Load& l = s.load;
  if (l.stiffness_Nm_rad > 0 && !(l.inertia_kg_m2 > 0))
    out.push_back({"load.stiffness_Nm_rad", number(l.stiffness_Nm_rad),
                   "has no mass behind it that could swing", "give load.inertia_kg_m2"});
  if (l.damping_Nm_s_rad > 0 && !(l.stiffness_Nm_rad > 0))
    out.push_back({"load.damping_Nm_s_rad", number(l.damping_Nm_s_rad),
                   "is of an elastic shaft, and this one is rigid",
                   "give load.stiffness_Nm_rad, or leave it away"});
  if (l.gravity_angle_deg != 0 && l.gravity_Nm == 0)
    out.push_back({"load.gravity_angle_deg", number(l.gravity_angle_deg), "is of a weight that is not there",
                   "give load.gravity_Nm"});
  if (s.bridge.saturation_V > 0 && s.bridge.device != Device::igbt)
    out.push_back({"bridge.saturation_V", number(s.bridge.saturation_V),
                   "is of an IGBT, and bridge.device is \"mosfet\"",
                   "write device = \"igbt\", or give on_resistance_ohm alone"});
}

void check_supply(const Scenario& s, base::Problems& out) {
  const bool R = s.supply.resistance_ohm > 0, C = s.supply.capacitance_F > 0;
  if (R && !C)
    out.push_back({"supply.resistance_ohm", number(s.supply.resistance_ohm),
                   "needs a bus capacitor behind it",
                   "give supply.capacitance_F too, or leave both away for a stiff bus"});
  if (C && !R)
    out.push_back({"supply.capacitance_F", number(s.supply.capacitance_F), "needs the source's resistance",
                   "give supply.resistance_ohm too, or leave both away for a stiff bus"});
  if (!s.supply.sinks && !(R && C))
    out.push_back({"supply.sinks", "false", "needs a bus whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  if (s.supply.inductance_H > 0 && !(R && C))
    out.push_back({"supply.inductance_H", number(s.supply.inductance_H), "needs a bus capacitor behind it",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  check_brake(s.supply, C, out);
  if (s.initial.bus_V && !C)
    out.push_back({"initial.bus_V", number(*s.initial.bus_V), "has no meaning on a stiff bus",
                   "leave it away, or give supply.resistance_ohm and supply.capacitance_F"});
}

void check_regeneration(const Scenario& s, base::Problems& out) {
  const Regeneration& r = s.control.regeneration;
  if (!r.limit_V) return;
  if (!(*r.limit_V > s.supply.voltage_V))
    out.push_back({"control.regeneration.limit_V", number(*r.limit_V),
                   "must be above supply.voltage_V = " + number(s.supply.voltage_V),
                   "the drive could never brake"});
  if (!r.gain_A_per_V && !(s.supply.capacitance_F > 0))
    out.push_back({"control.regeneration.gain_A_per_V", "", "is missing, and no capacitance to take it from",
                   "give it, or supply.capacitance_F"});
}

/// Without a current loop there is nothing that could hold a current, or a torque, within bounds.
void check_speed_output(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  if (c.speed.output != SpeedOutput::duty) return;
  const auto refuse = [&out](const char* key) {
    out.push_back({key, "", "needs a current loop, and control.speed.output = \"duty\" has none",
                   "remove it, or set control.speed.output = \"current\""});
  };
  if (c.current.type == CurrentLoopType::hysteresis) refuse("control.current.type");
  if (c.current.limit_A) refuse("control.current.limit_A");
  if (c.speed.torque_limit_Nm) refuse("control.speed.torque_limit_Nm");
  if (c.limits.current_A) refuse("control.limits.current_A");
  if (c.limits.torque_Nm) refuse("control.limits.torque_Nm");
  if (c.limits.speed_rad_s) refuse("control.limits.speed_rad_s");
  if (c.regeneration.limit_V) refuse("control.regeneration.limit_V");
}

/// A duty is set whatever flows.
void check_limited_mode(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  if (c.mode != control::Mode::off && c.mode != control::Mode::duty) return;
  const auto refuse = [&out](const char* key, const std::optional<double>& value) {
    if (value)
      out.push_back({key, number(*value), "needs a current loop, and control.mode has none",
                     "leave it away, or control current, speed or position"});
  };
  refuse("control.limits.current_A", c.limits.current_A);
  refuse("control.limits.torque_Nm", c.limits.torque_Nm);
  refuse("control.limits.speed_rad_s", c.limits.speed_rad_s);
  refuse("control.regeneration.limit_V", c.regeneration.limit_V);
}

/// What only the positional form has.
void check_speed_form(const Scenario& s, base::Problems& out) {
  const SpeedLoop& loop = s.control.speed;
  const auto refuse = [&](const char* key, const std::optional<double>& value) {
    if (value && loop.form != SpeedForm::positional)
      out.push_back({std::string("control.speed.") + key, number(*value), "is of the positional form only",
                     "set control.speed.form = \"positional\", or remove it"});
  };
  refuse("anti_windup", loop.anti_windup);
  refuse("derivative_s", loop.derivative_s);
  refuse("derivative_filter_s", loop.derivative_filter_s);
  if (loop.derivative_filter_s && !loop.derivative_s && loop.form == SpeedForm::positional)
    out.push_back({"control.speed.derivative_filter_s", number(*loop.derivative_filter_s),
                   "has no derivative to smooth", "give control.speed.derivative_s too"});
}

/// A loop of second order takes two samples at least until it stands: dead beat.
void check_settling(const std::optional<double>& settle_s, const char* key, const Scenario& s,
                    base::Problems& out) {
  const double least = 2 * s.pwm.period_s;
  if (settle_s && *settle_s < least)
    out.push_back({key, number(*settle_s),
                   "is shorter than two control periods, the least that any loop takes",
                   "write at least " + number(least) + ", better 10 periods, " + number(5 * least) +
                       "; or shorten pwm.period_s"});
}

void check_control(const Scenario& s, base::Problems& out) {
  check_settling(s.control.current.settle_s, "control.current.settle_s", s, out);
  check_settling(s.control.speed.settle_s, "control.speed.settle_s", s, out);
  check_regeneration(s, out);
  check_speed_output(s, out);
  check_limited_mode(s, out);
  check_speed_form(s, out);
  const auto add = [&](const base::Problems& more) { out.insert(out.end(), more.begin(), more.end()); };
  add(given_gains(s.control.current, "control.current").problems);
  add(given_gains(s.control.speed, "control.speed").problems);
  const CurrentLoop& c = s.control.current;
  if (c.type == CurrentLoopType::hysteresis && c.comparator == Comparator::sampled &&
      c.on == HysteresisOn::phase)
    out.push_back({"control.current.on", "\"phase\"", "needs comparators on the board",
                   "set comparator = \"event\", or on = \"motor\""});
  if (c.type == CurrentLoopType::hysteresis && c.comparator == Comparator::event && s.pwm.delay_periods > 0)
    out.push_back({"pwm.delay_periods", std::to_string(s.pwm.delay_periods),
                   "has no meaning for event comparators",
                   "set delay_periods = 0, or comparator = \"sampled\""});
  if (c.type == CurrentLoopType::hysteresis && (c.d1 || c.d0 || c.kp || c.ki || c.settle_s || c.damping))
    out.push_back({"control.current.type", "\"hysteresis\"", "has no PI gains",
                   "remove d1, d0, kp, ki, settle_s and damping, or set type = \"pi\""});
}

/// The speed controller's full output is a torque; where the sheet says what the motor stands it is 2.5 times
/// the nominal current's.
void check_torque_limit(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  const bool speed = s.control.mode == control::Mode::speed || s.control.mode == control::Mode::position;
  const bool asks_torque = speed && s.control.speed.output == SpeedOutput::current;
  if (asks_torque && !s.control.speed.torque_limit_Nm && !(motor.nominal_current_A > 0))
    out.push_back({"control.speed.torque_limit_Nm", "",
                   "is missing, and the motor's sheet names no nominal current",
                   "give the torque that the drive may ask for"});
}

/// What a controller can be wrong in, as an event leaves it: what was so from the start has been told.
void check_tunings(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  const auto wrong = [&motor](const Scenario& then) {
    base::Problems found;
    check_control(then, found);
    check_extras(then, found);
    check_product(then, std::nullopt, found);
    if (motor) check_torque_limit(then, *motor, found);
    return found;
  };
  if (std::none_of(s.at.begin(), s.at.end(), retunes)) return;
  const base::Problems told = wrong(s);
  const auto is_told = [&told](const base::Problem& p) {
    return std::any_of(told.begin(), told.end(), [&p](const base::Problem& other) {
      return p.where == other.where && p.limit == other.limit;
    });
  };
  for (const At* at : in_order(s)) {
    if (!retunes(*at)) continue;
    base::Problems found = wrong(settled(s, at));
    std::erase_if(found, is_told);
    const base::Problems of_event = told_of_event(s, *at, std::move(found));
    out.insert(out.end(), of_event.begin(), of_event.end());
  }
}

}  // namespace

base::Problems check(const Scenario& s) {
  // What follows computes with the numbers: an absurd one makes no sense of it.
  if (base::Problems absurd = check_numbers(s); !absurd.empty()) return absurd;
  base::Problems out;
  std::optional<double> sector_rad;
  std::optional<design::MotorModel> model;
  if (const auto motor = design::motor_model(s.sheet)) {
    model = *motor;
    check_torque_limit(s, *motor, out);
    check_pace(s, *motor, out);
    sector_rad = base::pi / 3 / motor->machine.pole_pairs;
  } else {
    out = motor.problems();
  }
  check_supply(s, out);
  check_shaft(s, out);
  const std::size_t before = out.size();
  check_references(s, out);
  check_events(s, out);
  const bool sound_reference = out.size() == before;
  check_steps(s.load.times_s, s.load.torques_Nm, "load", "torques_Nm", s.duration_s, out);
  check_control(s, out);
  check_tunings(s, model, out);
  check_sensors(s, out);
  check_product(s, sector_rad, out);
  check_extras(s, out);
  check_measures(s, sound_reference, out);
  if (!(s.bridge.dead_time_s < s.pwm.period_s))
    out.push_back({"bridge.dead_time_s", number(s.bridge.dead_time_s),
                   "must be shorter than pwm.period_s = " + number(s.pwm.period_s),
                   "a leg would never turn on"});
  if (s.load.locked && s.initial.speed_rad_s != 0)
    out.push_back({"initial.speed_rad_s", number(s.initial.speed_rad_s), "contradicts load.locked = true",
                   "set it to 0 or unlock the rotor"});
  if (const base::Problems spread = check_spread(s); !spread.empty())
    out.insert(out.end(), spread.begin(), spread.end());
  if (const auto columns = record_indices(s); !columns)
    out.insert(out.end(), columns.problems().begin(), columns.problems().end());
  return out;
}

}  // namespace sixstep::study

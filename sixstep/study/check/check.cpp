// SPDX-License-Identifier: Apache-2.0
// Finds contradictions that no single value's range shows: keys that contradict each other, or that need an
// absent part.
#include "sixstep/study/check/check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/check/believed.hpp"
#include "sixstep/study/check/converter_ends.hpp"
#include "sixstep/study/check/field.hpp"
#include "sixstep/study/check/heat.hpp"
#include "sixstep/study/check/measures.hpp"
#include "sixstep/study/check/numbers.hpp"
#include "sixstep/study/check/own.hpp"
#include "sixstep/study/check/pace.hpp"
#include "sixstep/study/check/position.hpp"
#include "sixstep/study/check/product.hpp"
#include "sixstep/study/check/reference.hpp"
#include "sixstep/study/check/sensorless.hpp"
#include "sixstep/study/check/sensors.hpp"
#include "sixstep/study/check/shaft.hpp"
#include "sixstep/study/check/shaft_sensor.hpp"
#include "sixstep/study/check/speed.hpp"
#include "sixstep/study/check/supply.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace sixstep::study {

namespace {

void check_bridge(const Scenario& s, base::Problems& out) {
  if (s.bridge.saturation_V > 0 && s.bridge.device != Device::igbt)
    out.push_back({"bridge.saturation_V", base::six_digits(s.bridge.saturation_V),
                   "applies to an IGBT only, and bridge.device is \"mosfet\"",
                   "set bridge.device = \"igbt\", or remove saturation_V"});
  check_dead_time("bridge.dead_time_s", s.bridge.dead_time_s, s.pwm, out);
}

void check_regeneration(const Scenario& s, base::Problems& out) {
  const Regeneration& r = s.control.regeneration;
  if (!r.limit_V) return;
  if (!(*r.limit_V > s.supply.voltage_V))
    out.push_back({"control.regeneration.limit_V", base::six_digits(*r.limit_V),
                   "must be above supply.voltage_V = " + base::six_digits(s.supply.voltage_V),
                   "raise this value: below the supply voltage the drive could never brake"});
  if (s.sensors.bus == BusSensing::adc && s.sensors.bus_range_V && !(*r.limit_V < bus_end_V(s.sensors)))
    out.push_back({"control.regeneration.limit_V", base::six_digits(*r.limit_V),
                   "can never be exceeded: the converter measures only up to " +
                       base::six_digits(bus_end_V(s.sensors)) +
                       ", by sensors.bus_range_V = " + base::six_digits(*s.sensors.bus_range_V),
                   "lower this value, or raise sensors.bus_range_V"});
  if (!r.gain_A_per_V && !(s.supply.capacitance_F > 0))
    out.push_back({"control.regeneration.gain_A_per_V", "",
                   "is missing, and its default needs supply.capacitance_F",
                   "give control.regeneration.gain_A_per_V, or supply.capacitance_F"});
}

/// Refuses limits of current or torque if the speed loop's output is a duty: without a current loop the drive
/// cannot apply them.
void check_speed_output(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  if (c.speed.output != SpeedOutput::duty) return;
  const auto refuse = [&out](const char* key) {
    out.push_back({key, "", "needs a current loop, which control.speed.output = \"duty\" does not have",
                   "remove this key, or set control.speed.output = \"current\""});
  };
  if (c.current.type == CurrentLoopType::hysteresis) refuse("control.current.type");
  if (c.current.limit_A) refuse("control.current.limit_A");
  if (c.speed.torque_limit_Nm) refuse("control.speed.torque_limit_Nm");
  if (c.limits.current_A) refuse("control.limits.current_A");
  if (c.limits.torque_Nm) refuse("control.limits.torque_Nm");
  if (c.limits.speed_rad_s) refuse("control.limits.speed_rad_s");
  if (c.regeneration.limit_V) refuse("control.regeneration.limit_V");
}

/// Refuses limits and regeneration in a mode without a current loop, because they would have no effect.
void check_limited_mode(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  if (c.mode != control::Mode::off && c.mode != control::Mode::duty) return;
  const auto refuse = [&out](const char* key, const std::optional<double>& value) {
    if (value)
      out.push_back({key, base::six_digits(*value),
                     "needs a current loop, which this control.mode does not have",
                     "remove this key, or set control.mode = \"current\", \"speed\" or \"position\""});
  };
  refuse("control.limits.current_A", c.limits.current_A);
  refuse("control.limits.torque_Nm", c.limits.torque_Nm);
  refuse("control.limits.speed_rad_s", c.limits.speed_rad_s);
  refuse("control.regeneration.limit_V", c.regeneration.limit_V);
}

/// A second-order loop needs at least two samples to settle (dead beat).
void check_settling(const std::optional<double>& settle_s, const char* key, const Scenario& s,
                    base::Problems& out) {
  const double least = 2 * s.pwm.period_s;
  if (settle_s && *settle_s < least)
    out.push_back({key, base::six_digits(*settle_s),
                   "is shorter than two control periods, in which no loop can settle",
                   "write at least " + base::six_digits(least) + ", better 10 periods, " +
                       base::six_digits(5 * least) + "; or shorten pwm.period_s"});
}

void check_control(const Scenario& s, base::Problems& out) {
  check_settling(s.control.current.settle_s, "control.current.settle_s", s, out);
  check_settling(s.control.speed.settle_s, "control.speed.settle_s", s, out);
  check_regeneration(s, out);
  check_speed_output(s, out);
  check_limited_mode(s, out);
  check_speed_law(s, out);
  check_position(s, out);
  append(out, given_gains(s.control.current, s.pwm.period_s, "control.current").problems);
  append(out, given_gains(s.control.speed, s.pwm.period_s, "control.speed").problems);
  const CurrentLoop& c = s.control.current;
  if (c.type == CurrentLoopType::hysteresis && c.comparator == Comparator::sampled &&
      c.on == HysteresisOn::phase)
    out.push_back({"control.current.on", "\"phase\"",
                   "needs a comparator in each driven phase, and comparator = \"sampled\" has none",
                   "set comparator = \"event\", or on = \"motor\""});
  if (c.type == CurrentLoopType::hysteresis && c.comparator == Comparator::event && s.pwm.delay_periods > 0)
    out.push_back({"pwm.delay_periods", std::to_string(s.pwm.delay_periods),
                   "has no effect with comparator = \"event\", which acts at once",
                   "set delay_periods = 0, or comparator = \"sampled\""});
  if (c.type == CurrentLoopType::hysteresis && (gives_gains(c)))
    out.push_back({"control.current.type", "\"hysteresis\"", "has no PI gains",
                   "remove d1, d0, kp, ki, ki_per_s, settle_s and damping, or set type = \"pi\""});
}

/// Requires the torque of the speed controller's full output. If the sheet has a nominal current, the default
/// is 2.5 times the torque at this current.
void check_torque_limit(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  const bool speed = s.control.mode == control::Mode::speed || s.control.mode == control::Mode::position;
  const bool asks_torque = speed && s.control.speed.output == SpeedOutput::current;
  if (asks_torque && !s.control.speed.torque_limit_Nm && !(motor.nominal_current_A > 0))
    out.push_back({"control.speed.torque_limit_Nm", "",
                   "is missing, and the motor's sheet names no nominal current",
                   "give control.speed.torque_limit_Nm, the drive's torque limit"});
}

/// Checks the controller's configuration after each event. Problems that exist from the start are not
/// repeated.
void check_tunings(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  const auto wrong = [&motor](const Scenario& then) {
    base::Problems found;
    check_control(then, found);
    check_extras(then, found);
    check_product(then, motor, found);
    check_sensorless(then, found);
    check_field(then, found);
    check_own(then, found);
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
    append(out, told_of_event(s, *at, std::move(found)));
  }
}

}  // namespace

/// Refuses keys that need a rotation.
void check_linear(const Scenario& s, base::Problems& out) {
  if (s.sheet.kind != design::MotorKind::linear) return;
  if (s.load.gravity_Nm != 0)
    out.push_back({"load.gravity_Nm", base::six_digits(s.load.gravity_Nm),
                   "applies to a rotary motor only, and this motor is linear",
                   "give the force of the weight as load.force_N"});
  if (s.load.gear != 1)
    out.push_back({"load.gear", base::six_digits(s.load.gear),
                   "applies to a rotary motor only, and this motor is linear",
                   "give mass, force and friction of the load as they act on the motor's slide"});
}

base::Problems check(const Scenario& s, std::size_t known_events) {
  // The checks below compute with the numbers. With a number out of range, their results would have no
  // meaning.
  if (base::Problems absurd = check_numbers(s, known_events); !absurd.empty()) return absurd;
  base::Problems out;
  std::optional<design::MotorModel> model;
  if (const auto motor = design::motor_model(s.sheet)) {
    model = *motor;
    check_torque_limit(s, *motor, out);
    check_pace(s, *motor, out);
    check_believed(s, out);
  } else {
    out = motor.problems();
  }
  check_supply(s, out);
  check_bridge(s, out);
  check_heat(s, out);
  check_shaft(s, out);
  check_linear(s, out);
  const std::size_t before = out.size();
  check_references(s, out);
  check_events(s, out);
  const bool sound_reference = out.size() == before;
  check_control(s, out);
  check_tunings(s, model, out);
  check_sensors(s, model, out);
  check_shaft_sensor(s, model, out);
  check_product(s, model, out);
  check_sensorless(s, out);
  check_field(s, out);
  check_own(s, out);
  check_extras(s, out);
  check_measures(s, sound_reference, out);
  append(out, check_spread(s));
  if (const auto columns = record_indices(s); !columns) append(out, columns.problems());
  return out;
}

}  // namespace sixstep::study

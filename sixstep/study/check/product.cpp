// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/product.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/study/check/converter_ends.hpp"
#include "sixstep/study/scenario/believed_motor.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

using base::written;
using control::Mode;

/// Requires sensors whose values are in a register, because the product drive reads registers only.
void check_registers(const Scenario& s, base::Problems& out) {
  const std::string asks =
      "has no converter, and control.drive = \"product\" reads the registers of converters and pins";
  if (s.sensors.currents == rig::CurrentMeasurement::ideal)
    out.push_back({"sensors.currents", "\"ideal\"", asks,
                   "set currents = \"phases\" (or \"dc-link\") and current_range_A"});
  if (s.sensors.currents == rig::CurrentMeasurement::low_side)
    out.push_back({"sensors.currents", "\"low-side\"",
                   "is not read by the product drive, which measures all phases or the DC link",
                   "set currents = \"phases\" or \"dc-link\", or control.drive = \"lean\""});
  if (s.sensors.bus == BusSensing::ideal)
    out.push_back({"sensors.bus", "\"ideal\"", asks, "set bus = \"adc\" and bus_range_V"});
  if (s.sensors.rotor == RotorSensing::ideal)
    out.push_back({"sensors.rotor", "\"ideal\"", asks, "set rotor = \"hall\""});
  else if (s.sensors.rotor != RotorSensing::hall)
    out.push_back({"sensors.rotor", std::string(base::word(rotor_sensing_choices, s.sensors.rotor)),
                   "is not decoded by the product drive, which reads Hall probes",
                   "set rotor = \"hall\", or control.drive = \"lean\""});
  if (s.sensors.currents == rig::CurrentMeasurement::dc_link && s.pwm.delay_periods > 0)
    out.push_back(
        {"pwm.delay_periods", std::to_string(s.pwm.delay_periods),
         "assigns the duty to another period than the shunt sample",
         "set delay_periods = 0: with pwm.sample = \"middle\" the answer acts at the next period's start"});
}

void check_missing(const char* key, const std::optional<double>& threshold, const char* cure,
                   base::Problems& out) {
  if (!threshold)
    out.push_back({std::string("protection.") + key, "",
                   "is missing: without this threshold the product drive never starts", cure});
}

/// Refuses a threshold beyond the converter's range.
void check_threshold(const char* key, const std::optional<double>& threshold, double end,
                     const std::string& range, base::Problems& out) {
  if (threshold && !(*threshold < end))
    out.push_back({std::string("protection.") + key, written(*threshold),
                   "can never be exceeded: the converter measures only up to " + base::rounded(end, 6) +
                       ", by " + range,
                   "lower this value, or raise " + range.substr(0, range.find(' '))});
}

void check_thresholds(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  check_missing("over_current_A", p.over_current_A, "give a value below sensors.current_range_A", out);
  check_missing("over_voltage_V", p.over_voltage_V, "give a value below sensors.bus_range_V", out);
  check_missing("under_voltage_V", p.under_voltage_V, "give a value below protection.over_voltage_V", out);
  check_missing("over_speed_rad_s", p.over_speed_rad_s, "give one", out);
  if (s.sensors.current_range_A) {
    const std::string range = "sensors.current_range_A = " + written(*s.sensors.current_range_A);
    check_threshold("over_current_A", p.over_current_A, current_end_A(s.sensors), range, out);
    check_threshold("stall_current_A", p.stall_current_A, current_end_A(s.sensors), range, out);
  }
  if (s.sensors.bus_range_V)
    check_threshold("over_voltage_V", p.over_voltage_V, bus_end_V(s.sensors),
                    "sensors.bus_range_V = " + written(*s.sensors.bus_range_V), out);
  if (p.under_voltage_V && p.over_voltage_V && !(*p.under_voltage_V < *p.over_voltage_V))
    out.push_back({"protection.under_voltage_V", written(*p.under_voltage_V),
                   "must be below protection.over_voltage_V = " + written(*p.over_voltage_V),
                   "lower this value"});
  if (p.under_voltage_V && s.sensors.bus_offset_V >= *p.under_voltage_V)
    out.push_back({"protection.under_voltage_V", written(*p.under_voltage_V),
                   "is never reached: with the bus at 0 V the converter reads sensors.bus_offset_V = " +
                       written(s.sensors.bus_offset_V),
                   "raise this value"});
  if (p.stall_current_A.has_value() != p.stall_s.has_value())
    out.push_back({p.stall_s ? "protection.stall_current_A" : "protection.stall_s", "",
                   "is missing, and stall detection needs protection.stall_current_A and protection.stall_s",
                   "give both keys, or remove both"});
}

void check_activities(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  const bool has_current_loop = s.control.mode != Mode::off && s.control.mode != Mode::duty;
  const std::string needs = "needs a current loop, which this control.mode does not have";
  if (p.align.current_A && !has_current_loop)
    out.push_back({"protection.align.current_A", written(*p.align.current_A), needs,
                   "remove this key, or set control.mode = \"current\", \"speed\" or \"position\""});
  if (p.brake_current_A > 0 && !has_current_loop)
    out.push_back({"protection.brake_current_A", written(p.brake_current_A), needs,
                   "remove this key, or set control.mode = \"current\", \"speed\" or \"position\""});
  if (p.off_at_s && !(*p.off_at_s < s.duration_s))
    out.push_back({"protection.off_at_s", written(*p.off_at_s),
                   "is not before the end of the run (duration_s = " + written(s.duration_s) + ")",
                   "lengthen duration_s, or lower off_at_s"});
}

void check_advance(const Scenario& s, base::Problems& out) {
  const Advance& a = s.control.advance;
  if (a.angle_deg > a.limit_deg)
    out.push_back({"control.advance.angle_deg", written(a.angle_deg),
                   "is above limit_deg = " + written(a.limit_deg) + ", which limits the advance",
                   "lower this value, or raise limit_deg"});
}

/// If a sector is shorter than hall_stable_samples samples, the drive does not detect it, and the next Hall
/// code looks like a jump of two sectors.
void check_hall_filter(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  const std::optional<double>& fastest = s.protection.over_speed_rad_s;
  const double stands_s = s.sensors.hall_stable_samples * s.pwm.period_s;
  const double sector_rad = base::sector_rad / motor.machine.pole_pairs;
  if (s.sensors.hall_stable_samples < 2 || !fastest || stands_s * *fastest <= sector_rad) return;
  const double most = std::floor(sector_rad / (*fastest * s.pwm.period_s));
  const std::string sector = written(sector_rad / *fastest);
  out.push_back(
      {"sensors.hall_stable_samples", std::to_string(s.sensors.hall_stable_samples),
       "last longer than a sector, " + sector + " s at protection.over_speed_rad_s = " + written(*fastest),
       most >= 2 ? "lower this value to " + written(most) + " at most, or lower over_speed_rad_s"
                 : "set this value to 1, shorten pwm.period_s, or lower over_speed_rad_s"});
}

void check_braking(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  if (p.over_current_A && p.brake_current_A >= *p.over_current_A)
    out.push_back({"protection.brake_current_A", written(p.brake_current_A),
                   "is not below protection.over_current_A = " + written(*p.over_current_A) +
                       ": braking would trip the drive",
                   "lower this value"});
}

/// Refuses keys that only the product drive has: the lean drive reads sector and edges directly.
void check_lean(const Scenario& s, base::Problems& out) {
  const Protection& p = s.protection;
  const auto refuse = [&out](const char* key, const std::string& value, const char* limit,
                             const char* otherwise) {
    out.push_back({key, value, limit, "set control.drive = \"product\", or " + std::string(otherwise)});
  };
  if (p.over_current_A || p.over_voltage_V || p.under_voltage_V || p.over_speed_rad_s || p.stall_current_A ||
      p.stall_s || p.off_at_s || p.align.current_A || p.brake_current_A > 0)
    refuse("protection", "", "is checked by the product drive only", "remove [protection]");
  if (advances(s.control.advance))
    refuse("control.advance", "", "applies to the product drive only", "remove this key");
  if (s.sensors.hall_stable_samples > 1)
    refuse("sensors.hall_stable_samples", std::to_string(s.sensors.hall_stable_samples),
           "applies to the product drive only", "remove this key");
}

}  // namespace

std::optional<double> current_limit_A(const Scenario& s) {
  const bool cascade = s.control.mode == Mode::speed || s.control.mode == Mode::position;
  if (!cascade || s.control.speed.output == SpeedOutput::duty) return std::nullopt;
  const std::optional<double>& limit_A = s.control.current.limit_A;
  const base::Result<design::MotorModel> motor = believed_motor(s);
  if (!motor) return limit_A;
  const double torque =
      s.control.speed.torque_limit_Nm.value_or(design::usual_torque_limit_Nm(*motor, s.supply.voltage_V));
  double per_A = motor->K_t_Nm_A;
  if (s.control.drive == FirmwareKind::field) {
    const design::FieldMachine machine = design::field_machine(*motor, believed_sheet(s));
    // The torque of a salient rotor is not proportional to its current.
    if (machine.L_d_H != machine.L_q_H) return std::nullopt;
    per_A = design::torque_per_q_A(machine);
  }
  if (!(per_A > 0.0) || !(torque > 0.0)) return limit_A;
  return std::min(torque / per_A, limit_A.value_or(HUGE_VAL));
}

void check_product(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  if (s.control.drive != FirmwareKind::product) return check_lean(s, out);
  check_registers(s, out);
  check_thresholds(s, out);
  check_activities(s, out);
  check_advance(s, out);
  if (!motor) return;
  check_hall_filter(s, *motor, out);
  check_braking(s, out);
}

namespace {

/// A deadbeat loop has only one design, which includes the back-EMF.
void check_deadbeat(const CurrentLoop& loop, base::Problems& out) {
  const auto refuse = [&out](bool given, const char* key, const char* limit, const char* cure) {
    if (given) out.push_back({std::string("control.current.") + key, "", limit, cure});
  };
  if (loop.type != CurrentLoopType::deadbeat) {
    refuse(loop.correction.has_value(), "correction", "applies to a deadbeat loop only",
           "set type = \"deadbeat\", or remove this key");
    return;
  }
  const char* const whole = "has no effect in a deadbeat loop, which is computed from R, L and the period";
  refuse(loop.settle_s.has_value(), "settle_s", whole, "remove this key, or set type = \"pi\"");
  refuse(loop.damping.has_value(), "damping", whole, "remove this key, or set type = \"pi\"");
  refuse(loop.d1 || loop.d0, "d1", whole, "remove d1 and d0, or set type = \"pi\"");
  refuse(loop.kp || loop.ki || loop.ki_per_s, "kp", whole,
         "remove kp, ki and ki_per_s, or set type = \"pi\"");
  refuse(loop.back_emf_feed_forward, "back_emf_feed_forward",
         "has no effect, because a deadbeat loop always adds the back-EMF", "remove this key");
}

/// Refuses duty_step and overlap for a hysteresis, which sets no duty, for a deadbeat loop, whose prediction
/// does not include them, and for hard chopping, which turns off both switches of the pair.
void check_commutation_step(const Scenario& s, base::Problems& out) {
  if (s.control.current.commutation == CurrentCommutation::plain) return;
  const std::string word(base::word(current_commutation_choices, s.control.current.commutation));
  const auto refuse = [&](bool given, const char* limit, const char* cure) {
    if (given) out.push_back({"control.current.commutation", '"' + word + '"', limit, cure});
  };
  const char* const leave = "remove this key, or set type = \"pi\"";
  refuse(s.control.current.type == CurrentLoopType::hysteresis,
         "sets a duty during a commutation, and a hysteresis has no duty", leave);
  refuse(s.control.current.type == CurrentLoopType::deadbeat,
         "sets a duty during a commutation, which the deadbeat loop's prediction does not include", leave);
  refuse(s.pwm.chopping == control::Chopping::hard && !s.control.smooth_chopping.on,
         "keeps the current with one switch of the pair on, and pwm.chopping = \"hard\" chops both",
         "set chopping = \"soft\" or \"complementary\"");
}

void check_pattern(const Scenario& s, base::Problems& out) {
  if (s.pwm.pattern == control::PwmPattern::upper) return;
  const std::string word(base::word(pattern_choices, s.pwm.pattern));
  if (s.pwm.chopping == control::Chopping::hard && !s.control.smooth_chopping.on)
    out.push_back({"pwm.pattern", word,
                   "leaves one switch of the pair on, and pwm.chopping = \"hard\" chops both",
                   "remove this key, or set chopping = \"soft\" or \"complementary\""});
  if (s.control.current.type == CurrentLoopType::hysteresis)
    out.push_back({"pwm.pattern", word,
                   "applies to a PWM only, and a hysteresis always chops the upper switch",
                   "remove this key, or set control.current.type = \"pi\""});
}

}  // namespace

void check_extras(const Scenario& s, base::Problems& out) {
  const CurrentLoop& loop = s.control.current;
  check_deadbeat(loop, out);
  check_commutation_step(s, out);
  check_pattern(s, out);
  if (loop.type == CurrentLoopType::hysteresis && loop.back_emf_feed_forward)
    out.push_back({"control.current.back_emf_feed_forward", "true",
                   "has no effect in a hysteresis, which sets no voltage",
                   "remove this key, or set type = \"pi\""});
  if (loop.type == CurrentLoopType::hysteresis && loop.feedback != CurrentFeedback::mean)
    out.push_back(
        {"control.current.feedback", "\"staying-phase\"",
         "applies to a PI or deadbeat loop; a hysteresis reads the current that control.current.on names",
         "remove this key, or set type = \"pi\""});
  if (loop.type == CurrentLoopType::hysteresis && loop.measured_bus_from_V)
    out.push_back({"control.current.measured_bus_from_V", written(*loop.measured_bus_from_V),
                   "has no effect in a hysteresis, which has no duty",
                   "remove this key, or set type = \"pi\""});
  if (s.control.limits.gain_A_s_per_rad && !s.control.limits.speed_rad_s)
    out.push_back({"control.limits.gain_A_s_per_rad", written(*s.control.limits.gain_A_s_per_rad),
                   "has no effect without control.limits.speed_rad_s",
                   "add control.limits.speed_rad_s, or remove this key"});
  const SmoothChopping& smooth = s.control.smooth_chopping;
  if (smooth.soft_above_A && smooth.complementary_below_A &&
      !(*smooth.soft_above_A > *smooth.complementary_below_A))
    out.push_back({"control.smooth_chopping.soft_above_A", written(*smooth.soft_above_A),
                   "must lie above complementary_below_A = " + written(*smooth.complementary_below_A),
                   "raise this value"});
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Refuses a limit that the drive cannot guarantee (design/loops/limit_bounds.hpp), and proposes a cure.
#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/timeline.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

double highest_start_V(const Scenario& s) {
  return std::max(highest_supply_V(s), s.initial.bus_V.value_or(0.0));
}

/// Refuses currents beyond the converter's range: a loop that reads less than its reference increases the
/// current without end.
void check_converter(const Scenario& s, const control::DriveConfig<double>& drive, base::Problems& out) {
  const Sensors& sensors = s.sensors;
  if (sensors.currents == rig::CurrentMeasurement::ideal || !sensors.current_range_A) return;
  const bool limited = drive.extras.limits_current;
  double asked = s.control.mode == Mode::current ? largest_reference(s) : drive.current_limit_A;
  if (limited) asked = 1.25 * std::min(asked, drive.extras.limits.current_A);
  const double range = *sensors.current_range_A;
  const double read =
      range - 2 * range / std::ldexp(1.0, sensors.adc_bits) - std::fabs(sensors.current_offset_A);
  if (asked < read) return;
  const double enough = base::shortened((asked + std::fabs(sensors.current_offset_A)) /
                                            (1 - 2 / std::ldexp(1.0, sensors.adc_bits)) * (1 + 1e-9),
                                        3, base::Towards::up);
  out.push_back({"sensors.current_range_A", base::three_digits(range),
                 "lets the converter read up to " + base::three_digits(read) + " A, and the drive " +
                     (limited ? "turns off only above " : "may command ") + base::three_digits(asked) + " A",
                 "raise this value to " + base::three_digits(enough) +
                     (s.control.mode == Mode::current ? " A or more, or lower the reference"
                                                      : " A or more, or lower control.current.limit_A")});
}

/// Refuses limits with shunts: one in the DC link does not show a current that flows through the lower
/// switches, or in a pulse that is too short; those in the legs show only currents of the lower switches.
void check_shunt(const Scenario& s, base::Problems& out) {
  const bool link = s.sensors.currents == rig::CurrentMeasurement::dc_link;
  if (!link && s.sensors.currents != rig::CurrentMeasurement::low_side) return;
  const auto refuse = [&](const char* key, const std::optional<double>& value) {
    if (value)
      out.push_back({key, base::three_digits(*value),
                     std::string("needs the current of every phase, and ") +
                         (link ? "a DC-link shunt does" : "low-side shunts do") + " not measure all of them",
                     "set sensors.currents = \"phases\", or remove this key"});
  };
  refuse("control.limits.current_A", s.control.limits.current_A);
  refuse("control.limits.torque_Nm", s.control.limits.torque_Nm);
  refuse("control.regeneration.limit_V", s.control.regeneration.limit_V);
}

/// Refuses a limit that the current exceeds within one PWM period with full voltage: the drive, which decides
/// once per period, cannot keep such a limit.
void check_current(const Scenario& s, const design::LimitSetting& setting, base::Problems& out) {
  const Limits& wanted = s.control.limits;
  if (!wanted.current_A && !wanted.torque_Nm) return;
  const double pulse_A = setting.bus_V * s.pwm.period_s / (2 * setting.machine.L_H);
  if (pulse_A <= setting.current_A) return;
  const bool by_current = wanted.current_A.has_value();
  // The current loop's reference never exceeds the loop's own limit.
  const bool narrowed = by_current && setting.current_A < *wanted.current_A;
  out.push_back(
      {by_current ? "control.limits.current_A" : "control.limits.torque_Nm",
       base::three_digits(by_current ? *wanted.current_A : *wanted.torque_Nm),
       "cannot be held: one PWM period on a bus of up to " + base::three_digits(setting.bus_V) +
           " V drives " + base::three_digits(pulse_A) + " A into the held rotor, more than the " +
           base::three_digits(setting.current_A) + (narrowed ? " A of the reference" : " A of the limit"),
       "shorten pwm.period_s to " +
           base::written(
               base::shortened(s.pwm.period_s * setting.current_A / pulse_A, 3, base::Towards::down)) +
           (narrowed ? ", or remove the limit" : ", or raise the limit")});
}

/// Mechanical angle in rad that the rotor turns while a measured speed is delayed: the sectors over which the
/// speed is averaged, the present sector, and the filter's delay of the edges. A sensorless drive averages
/// over six crossings.
double late_rad(const Scenario& s, const plant::Machine& machine, double speed_rad_s) {
  const bool crossings = s.control.drive == FirmwareKind::sensorless;
  if (crossings) return 7 * base::pi / 3 / machine.pole_pairs;
  if (s.sensors.rotor != RotorSensing::hall) return 0.0;
  const bool learns = s.sensors.hall_angle == rig::HallAngleFrom::learned_edges;
  const int edges = learns ? 6 : s.sensors.speed_edges;  // six until the edges are calibrated
  return (edges + 1) * base::pi / 3 / machine.pole_pairs +
         (s.sensors.hall_stable_samples - 1) * s.pwm.period_s * speed_rad_s;
}

void check_speed(const Scenario& s, const design::LimitSetting& setting, base::Problems& out) {
  if (!s.control.limits.speed_rad_s || s.load.locked) return;
  const double limit = *s.control.limits.speed_rad_s, fastest = 1.25;
  if (limit >= setting.speed_rad_s) return;  // the bus cannot drive the motor as fast as the limit
  const auto most = [&](double w) {
    return design::most_speed_rad_s(setting, w, late_rad(s, setting.machine, w * fastest));
  };
  if (most(limit) <= fastest * limit) return;
  double least = limit;
  while (most(least) > fastest * least) least *= 1.02;
  out.push_back(
      {"control.limits.speed_rad_s", base::three_digits(limit),
       "cannot be held: until the next sample, the drive's own torque may accelerate the rotor to " +
           base::three_digits(most(limit)) + " rad/s",
       "raise this value to " + base::three_digits(least) + ", lower control.limits.current_A" +
           (s.sensors.rotor == RotorSensing::hall ? ", or lower sensors.speed_edges"
                                                  : ", or shorten pwm.period_s")});
}

void check_bus(const Scenario& s, design::LimitSetting setting, base::Problems& out) {
  const std::optional<double>& wanted = s.control.regeneration.limit_V;
  if (!wanted || !(s.supply.capacitance_F > 0)) return;
  const double from = highest_start_V(s);
  if (!(*wanted > from)) {  // check.cpp checks the supply at the start
    out.push_back({"control.regeneration.limit_V", base::three_digits(*wanted),
                   "must be above the highest voltage of the supply or at the start, " +
                       base::three_digits(from) + " V",
                   "raise this value: with a lower limit the drive could never brake"});
    return;
  }
  // At worst the bus exceeds the limit by as much as the limit exceeds the supply.
  const auto holds = [&](double limit_V, double C_F) {
    setting.bus_V = 2 * limit_V - from + 2 * s.bridge.diode_drop_V;
    return design::most_bus_V(setting, limit_V, C_F) <= 2 * limit_V - from;
  };
  const double C = s.supply.capacitance_F;
  if (holds(*wanted, C)) return;
  const double reached = design::most_bus_V(setting, *wanted, C);
  double limit_V = *wanted, C_F = C;
  while (!holds(limit_V, C) && limit_V < 100 * from) limit_V = from + 1.05 * (limit_V - from);
  while (!holds(*wanted, C_F) && C_F < 1e6 * C) C_F *= 1.05;
  const bool can_store = holds(*wanted, C_F);
  out.push_back({"control.regeneration.limit_V", base::three_digits(*wanted),
                 "cannot be held: the current in the windings when the drive turns off, up to " +
                     base::three_digits(design::most_current_A(setting)) + " A, may lift the bus to " +
                     base::three_digits(reached) + " V",
                 "raise this value to " + base::three_digits(limit_V) +
                     (can_store ? " or supply.capacitance_F to " + base::three_digits(C_F) : std::string()) +
                     ", or lower the current limit"});
}

/// The bounds assume one inductance. A salient rotor's torque and current at the limit depend on its angle.
void check_saliency(const Scenario& s, const design::Sheet& sheet, base::Problems& out) {
  const double ratio = sheet.q_axis_inductance_mH->value / sheet.d_axis_inductance_mH->value;
  const auto refuse = [&](const char* key, const std::optional<double>& value) {
    if (value)
      out.push_back(
          {key, base::three_digits(*value),
           "can be kept only for a rotor with equal L_d and L_q, and this rotor's L_q is " +
               base::three_digits(ratio) + " times its L_d",
           "remove this key, and limit the references: control.current.limit_A, control.speed.torque_limit_Nm"});
  };
  refuse("control.limits.current_A", s.control.limits.current_A);
  refuse("control.limits.torque_Nm", s.control.limits.torque_Nm);
  refuse("control.limits.speed_rad_s", s.control.limits.speed_rad_s);
  refuse("control.regeneration.limit_V", s.control.regeneration.limit_V);
}

}  // namespace

design::LimitSetting limit_setting(const Scenario& s, const Basis& basis,
                                   const control::DriveConfig<double>& drive) {
  const double J = basis.shaft.J_kg_m2, C = s.supply.capacitance_F;
  const std::optional<double>& limit_V = s.control.regeneration.limit_V;
  design::LimitSetting out{basis.motor.machine, J, s.pwm.period_s};
  out.current_A = drive.extras.limits.current_A;
  const double from = highest_start_V(s);
  double bus = std::max(from, limit_V.value_or(0.0));
  out.speed_rad_s = std::max(std::fabs(s.initial.speed_rad_s), from / basis.motor.K_t_Nm_A);
  // Energy that the source does not take back raises the bus; at worst it is all of the rotor's energy.
  if (C > 0 && s.supply.sinks) bus += 1.25 * out.current_A * s.supply.resistance_ohm;
  if (C > 0 && !s.supply.sinks && !limit_V)
    bus = std::sqrt(bus * bus + J * out.speed_rad_s * out.speed_rad_s / C);
  out.bus_V = bus + 2 * s.bridge.diode_drop_V;
  return out;
}

base::Problems check_limits(const Scenario& s, const Basis& basis,
                            const control::DriveConfig<double>& drive) {
  base::Problems out;
  const bool has_current_loop = s.control.mode == Mode::current || drive.current_limit_A > 0;
  if (has_current_loop && s.control.current.type == CurrentLoopType::pi) check_converter(s, drive, out);
  if (!drive.extras.limits_current) return out;
  if (design::is_salient(basis.sheet)) {
    check_saliency(s, basis.sheet, out);
    return out;
  }
  check_shunt(s, out);
  const design::LimitSetting setting = limit_setting(s, basis, drive);
  check_current(s, setting, out);
  check_speed(s, setting, out);
  check_bus(s, setting, out);
  return out;
}

}  // namespace sixstep::study

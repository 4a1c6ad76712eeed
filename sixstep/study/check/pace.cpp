// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/pace.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/plant/pace.hpp"

namespace sixstep::study {

namespace {

using base::written;
using plant::fastest_answer_1_s;
using plant::fastest_field_rad_s;

/// Returns, for example, "3.2 ns, and on no board it is below 100 ns".
std::string too_short(double rate_1_s) {
  return base::three_digits(1e9 / rate_1_s) + " ns, and no board has less than " +
         base::three_digits(1e9 / fastest_answer_1_s) + " ns";
}

void check_bridge(const Scenario& s, const plant::Machine& m, base::Problems& out) {
  const Bridge& b = s.bridge;
  const double rate = plant::winding_rate(m, {b.on_resistance_ohm, b.diode_drop_V, b.diode_resistance_ohm});
  if (!(rate > fastest_answer_1_s)) return;
  const bool diode = b.diode_resistance_ohm > b.on_resistance_ohm;
  out.push_back({diode ? "bridge.diode_resistance_ohm" : "bridge.on_resistance_ohm",
                 written(diode ? b.diode_resistance_ohm : b.on_resistance_ohm),
                 "gives winding and bridge a time constant of " + too_short(rate),
                 "correct the unit of this value: a MOSFET has milliohms"});
}

void check_bus(const Scenario& s, const plant::Machine& m, base::Problems& out) {
  const Supply& from = s.supply;
  // A missing value is reported by check_supply().
  if (!(from.resistance_ohm > 0 && from.capacitance_F > 0)) return;
  const double rate =
      plant::bus_rate(m, {from.voltage_V, from.resistance_ohm, from.capacitance_F, from.sinks});
  if (rate > fastest_answer_1_s)
    out.push_back(
        {"supply.capacitance_F", written(from.capacitance_F),
         "gives the bus, with supply.resistance_ohm = " + written(from.resistance_ohm) +
             " and the winding, a time constant of " + too_short(rate),
         "correct the unit of this value: a bus has hundreds of microfarads; for a stiff bus remove resistance and capacitance"});
}

void check_friction(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  plant::Shaft shaft = motor.shaft;
  shaft.J_kg_m2 += s.load.inertia_kg_m2;
  shaft.B_Nm_s += s.load.viscous_Nm_s;
  const double rate = plant::friction_rate(shaft);
  if (rate > fastest_answer_1_s)
    out.push_back({"load.viscous_Nm_s", written(s.load.viscous_Nm_s),
                   "stops the rotor within " + too_short(rate),
                   "correct the unit of this value, or set load.locked = true to hold the rotor"});
}

/// Time constant of a battery's recovery: the recovery capacitor C_1 discharges through its resistor R_1, and
/// through the source's resistance R_b into the bus.
void check_recovery(const Supply& from, base::Problems& out) {
  if (!(from.battery_recovery_ohm > 0 && from.battery_recovery_F > 0 && from.resistance_ohm > 0))
    return;  // check_supply() reports the missing value
  const double rate = (1 / from.battery_recovery_ohm + 1 / from.resistance_ohm) / from.battery_recovery_F;
  if (rate > fastest_answer_1_s)
    out.push_back({"supply.battery_recovery_F", written(from.battery_recovery_F),
                   "gives the battery's recovery, with supply.battery_recovery_ohm = " +
                       written(from.battery_recovery_ohm) + ", a time constant of " + too_short(rate),
                   "correct the unit of this value: a cell recovers over milliseconds to minutes"});
}

/// Checks the time constants of the source's inductance, of the bus capacitor and of the brake resistor.
void check_source(const Scenario& s, const plant::Machine& m, base::Problems& out) {
  const Supply& from = s.supply;
  if (!(from.capacitance_F > 0)) return;  // check_supply() reports the missing value
  const double L = std::min(2 * m.L_H, from.inductance_H > 0 ? from.inductance_H : 2 * m.L_H);
  if (const double rate = from.capacitor_resistance_ohm / L; rate > fastest_answer_1_s)
    out.push_back({"supply.capacitor_resistance_ohm", written(from.capacitor_resistance_ohm),
                   "gives, with the inductances of source and winding, a time constant of " + too_short(rate),
                   "correct the unit of this value: a bus capacitor has milliohms"});
  if (from.inductance_H > 0) {
    const double rate =
        from.resistance_ohm / from.inductance_H + 1 / std::sqrt(from.inductance_H * from.capacitance_F);
    if (rate > fastest_answer_1_s)
      out.push_back({"supply.inductance_H", written(from.inductance_H),
                     "gives the source a time constant of " + too_short(rate),
                     "correct the unit of this value: a cable has microhenries; or remove this key"});
  }
  if (from.brake_resistance_ohm > 0) {
    const double rate = 1 / (from.brake_resistance_ohm * from.capacitance_F);
    if (rate > fastest_answer_1_s)
      out.push_back({"supply.brake_resistance_ohm", written(from.brake_resistance_ohm),
                     "empties the bus within " + too_short(rate), "correct the unit of this value"});
  }
}

/// Checks the oscillation of an elastic shaft, and loads that grow with the square of the speed.
void check_coupling(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  const Load& l = s.load;
  const double square = l.gear * l.gear, J_1 = motor.shaft.J_kg_m2 * square, J_2 = l.inertia_kg_m2;
  const auto look = [&](const char* key, double value, double rate) {
    if (rate > fastest_answer_1_s)
      out.push_back({key, written(value), "gives the shaft a time constant of " + too_short(rate),
                     "correct the unit of this value, of load.gear or of the inertias"});
  };
  const bool elastic = l.stiffness_Nm_rad > 0 && J_2 > 0;
  if (elastic) {
    const double both = 1 / J_1 + 1 / J_2;
    look("load.stiffness_Nm_rad", l.stiffness_Nm_rad, std::sqrt(l.stiffness_Nm_rad * both));
    look("load.damping_Nm_s_rad", l.damping_Nm_s_rad, l.damping_Nm_s_rad * both);
  }
  const double fastest_load = fastest_field_rad_s / motor.machine.pole_pairs / l.gear;
  const SquareLaw fan = square_law(l);
  look(fan.key.c_str(), fan.Nm_s2, fan.Nm_s2 * fastest_load / (elastic ? J_2 : J_1 + J_2));
}

/// Refuses a torque that accelerates the rotor beyond all bounds within a few PWM periods.
void check_torque(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  if (s.load.locked) return;
  const double J = motor.shaft.J_kg_m2 + s.load.inertia_kg_m2 / (s.load.gear * s.load.gear);
  const double most_Nm = plant::fastest_field_rad_s2 / motor.machine.pole_pairs * J;
  const auto look = [&](const std::string& key, double torque_Nm) {
    if (std::fabs(torque_Nm) > most_Nm)
      out.push_back({key, written(torque_Nm),
                     "is too large for a moment of inertia of " + base::three_digits(J) + " kg m2: at most " +
                         base::three_digits(most_Nm) + " N m are simulated",
                     "check the units of the torque and of the inertia"});
  };
  look("load.torque_Nm", s.load.torque_Nm);
  look("load.gravity_Nm", s.load.gravity_Nm);
  for (std::size_t n = 0; n < s.sheet.cogging_mNm.size(); ++n)
    look("motor_override.cogging_mNm[" + std::to_string(n) + "]", 1e-3 * s.sheet.cogging_mNm[n]);
  for (std::size_t n = 0; n < s.load.torques_Nm.size(); ++n)
    if (std::fabs(s.load.torques_Nm[n]) > most_Nm) {
      look("load.torques_Nm[" + std::to_string(n) + "]", s.load.torques_Nm[n]);
      break;
    }
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (const auto& torque_Nm = s.at[n].load.torque_Nm)
      look("at[" + std::to_string(n) + "].load.torque_Nm", *torque_Nm);
}

void check_field_pace(const Scenario& s, const plant::Machine& m, base::Problems& out) {
  const auto look = [&](const std::string& key, double value, double field_rad_s, const char* cure) {
    if (std::fabs(field_rad_s) > fastest_field_rad_s)
      out.push_back({key, written(value),
                     "turns the field at " + base::three_digits(std::fabs(field_rad_s)) +
                         " electrical rad/s, and no motor reaches more than " +
                         base::three_digits(fastest_field_rad_s),
                     cure});
  };
  constexpr const char* too_high =
      "lower supply.voltage_V, or correct the unit of the motor's torque constant";
  look("supply.voltage_V", s.supply.voltage_V, plant::field_at(m, s.supply.voltage_V), too_high);
  if (s.initial.bus_V)
    look("initial.bus_V", *s.initial.bus_V, plant::field_at(m, *s.initial.bus_V), too_high);
  for (std::size_t n = 0; n < s.at.size(); ++n)
    if (const auto& voltage_V = s.at[n].supply.voltage_V)
      look("at[" + std::to_string(n) + "].supply.voltage_V", *voltage_V, plant::field_at(m, *voltage_V),
           too_high);
  look("initial.speed_rad_s", s.initial.speed_rad_s, m.pole_pairs * s.initial.speed_rad_s,
       "give the mechanical speed of the shaft in rad/s, not the electrical speed");
}

/// Checks the time in which the current crosses the hysteresis band. At worst the whole bus voltage drives
/// it.
void check_band(const Scenario& s, const plant::Machine& m, base::Problems& out) {
  const CurrentLoop& loop = s.control.current;
  if (loop.type != CurrentLoopType::hysteresis || loop.comparator != Comparator::event) return;
  const double per_s = s.supply.voltage_V / (2.0 * m.L_H), rate = per_s / (2.0 * loop.band_A);
  if (rate > fastest_answer_1_s)
    out.push_back({"control.current.band_A", written(loop.band_A), "is crossed within " + too_short(rate),
                   "widen this value to at least " + base::three_digits(per_s / (2.0 * fastest_answer_1_s)) +
                       " A, or set comparator = \"sampled\""});
}

void check_timer(const Scenario& s, base::Problems& out) {
  if (s.pwm.timer_Hz > 0 && s.pwm.timer_Hz * s.pwm.period_s < 2.0)
    out.push_back({"pwm.timer_Hz", written(s.pwm.timer_Hz),
                   "counts less than twice in pwm.period_s = " + written(s.pwm.period_s),
                   "give the timer's clock in Hz, for example 16e6, or 0 for no rounding"});
}

/// A minimum pulse longer than half a period would allow no duty except 0 and 1.
void check_minimum_pulse(const Scenario& s, base::Problems& out) {
  if (s.pwm.minimum_pulse_s > s.pwm.period_s / 2)
    out.push_back({"pwm.minimum_pulse_s", written(s.pwm.minimum_pulse_s),
                   "leaves no room for a pulse in pwm.period_s = " + written(s.pwm.period_s),
                   "set pwm.minimum_pulse_s to at most half of pwm.period_s"});
}

}  // namespace

double dead_time_in_counts_s(double dead_time_s, const Pwm& pwm) {
  return pwm.timer_Hz > 0 ? std::floor(dead_time_s * pwm.timer_Hz + 0.5) / pwm.timer_Hz : dead_time_s;
}

void check_dead_time(const std::string& where, double dead_time_s, const Pwm& pwm, base::Problems& out) {
  constexpr double worth_a_word = 0.9;
  // A leg that turns on and off within a period waits for two dead times.
  if (!(2 * dead_time_s < pwm.period_s)) {
    out.push_back({where, written(dead_time_s),
                   "must be shorter than half of pwm.period_s = " + written(pwm.period_s),
                   "give the gate driver's dead time, some microseconds: each period has two dead times"});
    return;
  }
  const double counted_s = dead_time_in_counts_s(dead_time_s, pwm);
  if (counted_s >= worth_a_word * dead_time_s) return;
  out.push_back({where, written(dead_time_s),
                 (counted_s > 0 ? "becomes " + base::three_digits(1e6 * counted_s) + " us" : "is lost") +
                     " on a timer that counts " + base::three_digits(1e6 / pwm.timer_Hz) +
                     " us, pwm.timer_Hz = " + written(pwm.timer_Hz),
                 "give whole counts, for example " +
                     base::six_digits(std::ceil(dead_time_s * pwm.timer_Hz) / pwm.timer_Hz)});
}

void check_pace(const Scenario& s, const design::MotorModel& motor, base::Problems& out) {
  check_bridge(s, motor.machine, out);
  check_bus(s, motor.machine, out);
  check_source(s, motor.machine, out);
  check_recovery(s.supply, out);
  check_friction(s, motor, out);
  check_coupling(s, motor, out);
  check_torque(s, motor, out);
  check_field_pace(s, motor.machine, out);
  check_band(s, motor.machine, out);
  check_timer(s, out);
  check_minimum_pulse(s, out);
}

}  // namespace sixstep::study

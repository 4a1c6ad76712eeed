// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/operating_limits.hpp"

#include <cmath>
#include <limits>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

namespace {

/// Ripple, A peak to peak, of a pair that switches between two voltages with the difference `swing_V`.
double swing_ripple_A(const MotorModel& motor, double swing_V, double duty, double period_s) {
  const double R = 2.0 * motor.machine.R_ohm, x = period_s * motor.machine.R_ohm / motor.machine.L_H;
  // R b0 = 1 - exp(-R T/L) without cancellation; b0 is computed by pole_placement's plant with R = L = 1.
  const auto rise = [](double t) { return t > 0.0 ? current_plant(1.0, 1.0, t).b0 : 0.0; };
  return swing_V / R * rise(duty * x) * rise((1.0 - duty) * x) / rise(x);
}

}  // namespace

double volts_per_duty(control::Chopping chopping) { return chopping == control::Chopping::hard ? 2.0 : 1.0; }

// Inverts u/U = s d - (s - 1), with s = volts_per_duty(); u: mean voltage, U: bus voltage, d: duty.
double duty_for_voltage(control::Chopping chopping, double part_of_bus) {
  const double s = volts_per_duty(chopping);
  return (part_of_bus + s - 1.0) / s;
}

double current_ripple_A(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping,
                        double duty) {
  return swing_ripple_A(motor, volts_per_duty(chopping) * bus_V, duty, period_s);
}

double ripple_between_A(const MotorModel& motor, double on_V, double off_V, double mean_V, double period_s) {
  if (!(off_V < mean_V && mean_V < on_V)) return 0.0;
  return swing_ripple_A(motor, on_V - off_V, (mean_V - off_V) / (on_V - off_V), period_s);
}

Ripple worst_ripple(const MotorModel& motor, double bus_V, double period_s, control::Chopping chopping) {
  Ripple r;
  r.worst_A = current_ripple_A(motor, bus_V, period_s, chopping, r.worst_duty);
  r.continuous_above_A = r.worst_A / 2.0;
  return r;
}

// At the duty 1/2 the ripple is (dU/R) tanh(x/4), with x = R T/L and the swing dU of the voltage. Therefore x
// = 2 ln((1 + y)/(1 - y)) with y = ripple R/dU.
double period_for_ripple_s(const MotorModel& motor, double bus_V, control::Chopping chopping,
                           double ripple_A) {
  const double y = ripple_A * 2.0 * motor.machine.R_ohm / (volts_per_duty(chopping) * bus_V);
  if (!(y < 1.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * base::log((1.0 + y) / (1.0 - y)) * motor.machine.L_H / motor.machine.R_ohm;
}

NominalCurrent nominal_current(const MotorModel& motor, double bus_V) {
  if (motor.nominal_current_A > 0.0) return {motor.nominal_current_A, true};
  return {bus_V / (2.0 * motor.machine.R_ohm) / 10.0, false};
}

double usual_torque_limit_Nm(const MotorModel& motor, double bus_V) {
  const double stall_A = bus_V / (2.0 * motor.machine.R_ohm);
  return motor.K_t_Nm_A * std::fmin(usual_overload * nominal_current(motor, bus_V).A, stall_A);
}

double headroom_V(const MotorModel& motor, double bus_V, double current_A, double speed_rad_s) {
  return bus_V - 2.0 * motor.machine.R_ohm * current_A - motor.K_t_Nm_A * speed_rad_s;
}

double speed_for_current_rad_s(const MotorModel& motor, double bus_V, double current_A) {
  return (bus_V - 2.0 * motor.machine.R_ohm * current_A) / motor.K_t_Nm_A;
}

double commutation_loss(const MotorModel& motor, double current_A) {
  return 3.0 * motor.machine.pole_pairs * motor.machine.L_H * current_A / (base::pi * motor.K_t_Nm_A);
}

TestSpeeds test_speeds(const MotorModel& motor, double bus_V, double torque_limit_Nm) {
  constexpr double part_of_top = 0.9, room_above_lowest = 1.2, usual_loss = 1.2;
  const double nominal_A = nominal_current(motor, bus_V).A;
  const auto reached = [&](double current_A) {
    return speed_for_current_rad_s(motor, bus_V, current_A) /
           (1.0 + usual_loss * commutation_loss(motor, current_A));
  };
  TestSpeeds t{.load_A = std::fmin(nominal_A, torque_limit_Nm / motor.K_t_Nm_A) / 2};
  const double ideal = bus_V / motor.K_t_Nm_A;
  const double friction_A = (motor.shaft.B_Nm_s * ideal + motor.shaft.coulomb_Nm) / motor.K_t_Nm_A;
  t.top_rad_s = part_of_top * reached(t.load_A + friction_A);
  const double most = std::fmin(t.top_rad_s / room_above_lowest, high_speed_part * reached(nominal_A));
  if (most > 0.0) t.most_lowest_rad_s = base::shortened(most, 2, base::Towards::down);
  return t;
}

double soft_braking_limit_rad_s(const MotorModel& motor, double current_A) {
  return current_A / motor.K_t_Nm_A * 2.0 * motor.machine.R_ohm;
}

// At the edge the staying phase is in the middle of its top. The other two phases are 120 degrees from the
// middle of their tops.
double commutation_emfs(const plant::Machine& machine) {
  if (machine.back_emf == plant::BackEmf::sine) return 3.0;
  const double ramp_deg = 90.0 - machine.flat_deg / 2;
  return 2.0 + 2.0 * std::fmin(1.0, 30.0 / ramp_deg);
}

double commutation_limit_rad_s(const MotorModel& motor, double bus_V, double current_A) {
  const plant::Machine& m = motor.machine;
  return std::fmax((bus_V - 3.0 * m.R_ohm * current_A) / (commutation_emfs(m) * m.K_e_V_s), 0.0);
}

}  // namespace sixstep::design

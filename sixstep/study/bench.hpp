// SPDX-License-Identifier: Apache-2.0
// A motor on a test bench that holds its speed: what the torque-speed curve is taken of.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/parameters.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::study {

/// Stiff bus, commutation at the Hall edges, duty held: open loop.
struct Bench {
  design::MotorModel motor;
  plant::Devices devices{};
  double voltage_V = 0.0;
  double duty = 1.0;  ///< in [-1, 1], not 0; a negative one drives backwards
  control::Chopping chopping = control::Chopping::soft;
  double pwm_period_s = 30e-6;
};

/// What no curve can be taken of; `where` is the member's name.
base::Problems check(const Bench& bench);

/// Friction at a speed, B w + T_c sign(w), N m: positive against a forward rotation.
inline double friction_Nm(const plant::Shaft& shaft, double speed_rad_s) {
  const double sign = speed_rad_s > 0 ? 1.0 : speed_rad_s < 0 ? -1.0 : 0.0;
  return shaft.B_Nm_s * speed_rad_s + sign * shaft.coulomb_Nm;
}

/// Mean voltage across the driven pair while current flows throughout, V: d U, or (2 |d| - 1) U where both
/// switches chop and the off part of a period drives the current back into the bus.
inline double mean_voltage_V(const Bench& b) {
  if (b.chopping != control::Chopping::hard) return b.duty * b.voltage_V;
  return b.duty > 0 ? (2 * b.duty - 1) * b.voltage_V : (2 * b.duty + 1) * b.voltage_V;
}

/// The straight line of an ideal six-step motor, T = K_t (u - K_t w)/R_tt with that voltage, N m: no
/// inductance, no friction, ideal devices.
inline double ideal_torque_Nm(const Bench& b, double speed_rad_s) {
  const double K_t = b.motor.K_t_Nm_A;
  return K_t * (mean_voltage_V(b) - K_t * speed_rad_s) / (2 * b.motor.machine.R_ohm);
}

/// Where that line meets the axis, rad/s.
inline double ideal_no_load_rad_s(const Bench& b) { return mean_voltage_V(b) / b.motor.K_t_Nm_A; }

}  // namespace sixstep::study

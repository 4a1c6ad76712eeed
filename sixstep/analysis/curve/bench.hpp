// SPDX-License-Identifier: Apache-2.0
// A motor on a test bench that imposes its speed, for the torque-speed curve.
#pragma once
#include <cstdint>
#include <functional>

#include "sixstep/base/problem.hpp"
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::analysis {

/// The bench has a stiff bus, commutates at the Hall edges and applies a constant duty, without a loop.
struct Bench {
  design::MotorModel motor;
  plant::Devices devices{};
  double voltage_V = 0.0;
  double duty = 1.0;  ///< from -1 to 1, except 0; a negative duty drives backwards
  control::Chopping chopping = control::Chopping::soft;
  double pwm_period_s = 30e-6;
  /// Called repeatedly, on any thread. If it returns false, the computation ends with a Problem. May be
  /// empty.
  std::function<bool()> keep_going{};
};

/// told_to_stop(): true if keep_going ends the computation. interrupted_work(): the Problem of the ended
/// computation.
inline bool told_to_stop(const Bench& b) { return b.keep_going && !b.keep_going(); }
inline base::Problem interrupted_work() { return {"curve", "", "was interrupted", "start it again"}; }

/// Passes a run's segments to `observer`, which must not end the run. Calls keep_going every 256 segments.
template <class Observer>
struct Asking {
  const std::function<bool()>& keep_going;
  Observer& observer;
  std::uint32_t segments = 0;

  void segment(const auto& system, double s) { observer.segment(system, s); }
  bool done(const auto&) { return keep_going && ++segments % 256 == 0 && !keep_going(); }
};

/// Returns the Problems of a bench for which no curve can be computed; `where` is the member's name.
base::Problems check(const Bench& bench);

/// Mean voltage across the driven pair in V while current flows throughout: d U, or (2 |d| - 1) U with hard
/// chopping; d: duty, U: bus voltage. With hard chopping both switches chop, and the current flows back into
/// the bus during the off part of a period.
inline double mean_voltage_V(const Bench& b) {
  if (b.chopping != control::Chopping::hard) return b.duty * b.voltage_V;
  return b.duty > 0 ? (2 * b.duty - 1) * b.voltage_V : (2 * b.duty + 1) * b.voltage_V;
}

/// The straight line of an ideal six-step motor, in N m: T = K_t (u - K_t w)/R_tt. K_t: torque constant, u:
/// mean_voltage_V(), w: speed, R_tt: line-to-line resistance. The current is smooth, commutation takes no
/// time, devices are ideal, and there is no friction. Soft and hard chopping cannot drive the current
/// backwards; the line then ends at zero torque.
inline double ideal_torque_Nm(const Bench& b, double speed_rad_s) {
  const double K_t = b.motor.K_t_Nm_A, R_tt = 2 * b.motor.machine.R_ohm;
  const double line = K_t * (mean_voltage_V(b) - K_t * speed_rad_s) / R_tt;
  const bool one_way = b.duty > -1 && b.duty < 1 && b.chopping != control::Chopping::complementary;
  return one_way && line * b.duty < 0 ? 0.0 : line;
}

/// Speed in rad/s at which this line reaches zero torque; 0 if the mean voltage does not drive the motor.
inline double ideal_no_load_rad_s(const Bench& b) {
  const double reached = mean_voltage_V(b) / b.motor.K_t_Nm_A;
  return reached * b.duty > 0 ? reached : 0.0;
}

}  // namespace sixstep::analysis

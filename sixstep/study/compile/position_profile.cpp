// SPDX-License-Identifier: Apache-2.0
// Designs the position loop's profile and its feed-forward (control/profiled_position.hpp). Values that a
// scenario does not give follow from the drive:
// - Acceleration: four fifths of the torque limit; a fifth is reserved for unknown loads.
// - Speed: nine tenths of the speed that the bus voltage allows at this torque, or of the loop's speed limit
//   if that is lower; a tenth is reserved to catch up.
// - Jerk: the acceleration rises within the settling time of the speed loop.
#include <algorithm>
#include <numbers>
#include <string>

#include "sixstep/base/linear.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

namespace {

constexpr double torque_part = 0.8, speed_part = 0.9, least_speed_part = 0.1;

bool sets_duty(const Scenario& s) { return s.control.speed.output == SpeedOutput::duty; }

/// The largest torque that the drive can request.
double most_torque_Nm(const Scenario& s, const Basis& basis, const control::DriveConfig<double>& drive) {
  if (sets_duty(s)) return design::usual_torque_limit_Nm(basis.motor, basis.bus_V);
  double most_A = std::min(drive.current_at_full_torque_A, drive.current_limit_A);
  if (drive.extras.limits_current) most_A = std::min(most_A, drive.extras.limits.current_A);
  return most_A * torque_per_A(s, basis);
}

/// The highest speed in rad/s at which the bus voltage still allows this torque: with a driven pair, or with
/// three legs within their voltage circle.
double reached_rad_s(const Scenario& s, const Basis& basis, double torque_Nm) {
  const double per_A = torque_per_A(s, basis), i = torque_Nm / per_A, R_ohm = basis.motor.machine.R_ohm;
  const bool field = s.control.drive == FirmwareKind::field;
  const double U = field ? basis.bus_V / std::numbers::sqrt3 : basis.bus_V;
  const double e_V_s = field ? per_A / 1.5 : per_A, drop_V = field ? R_ohm * i : 2 * R_ohm * i;
  return std::max(U - drop_V, least_speed_part * U) / e_V_s;
}

control::JerkProfileLimits profile_limits(const Scenario& s, const Basis& basis,
                                          const control::DriveConfig<double>& drive) {
  const PositionProfile& wanted = s.control.position.profile;
  const double J = basis.shaft.J_kg_m2;
  control::JerkProfileLimits out;
  out.acceleration_rad_s2 =
      wanted.acceleration_rad_s2.value_or(torque_part * most_torque_Nm(s, basis, drive) / J);
  const double reached = reached_rad_s(s, basis, J * out.acceleration_rad_s2);
  out.speed_rad_s = wanted.speed_rad_s.value_or(speed_part * std::min(reached, drive.speed_limit_rad_s));
  out.smoothing_s =
      wanted.jerk_rad_s3
          ? out.acceleration_rad_s2 / *wanted.jerk_rad_s3
          : wanted.smoothing_s.value_or(s.control.speed.settle_s.value_or(design::usual_speed_settle_s));
  return out;
}

/// Feed-forward gains relative to the full torque. If the speed loop's output is a duty, they are relative to
/// the bus voltage and include the voltage for the torque's current and the back-EMF.
control::MotionFeedForwardConfig<double> told_ahead(const Scenario& s, const Basis& basis,
                                                    const control::DriveConfig<double>& drive) {
  if (!s.control.position.profile.feed_forward) return {};
  const plant::Shaft& shaft = basis.shaft;
  const double K_t = basis.motor.K_t_Nm_A, U = basis.bus_V;
  const double per_Nm = sets_duty(s) ? 2 * basis.motor.machine.R_ohm / (K_t * U)
                                     : 1 / (drive.current_at_full_torque_A * torque_per_A(s, basis));
  return {true, shaft.J_kg_m2 * per_Nm, shaft.B_Nm_s * per_Nm + (sets_duty(s) ? K_t / U : 0.0),
          shaft.coulomb_Nm * per_Nm};
}

}  // namespace

void add_position_profile(const Scenario& s, const Basis& basis, Tuned& out) {
  if (!s.control.position.profile.on || s.control.mode != control::Mode::position) return;
  control::DriveConfig<double>& drive = out.drive;
  const control::JerkProfileLimits limits = profile_limits(s, basis, drive);
  drive.extras.on = true;
  drive.extras.position = {true, control::jerk_profile(limits, s.pwm.period_s), told_ahead(s, basis, drive)};
  const control::JerkProfileConfig<double>& made = drive.extras.position.profile;
  const double rises_s = made.ticks * made.cells * s.pwm.period_s;
  const base::Motion motion{s.sheet.kind == design::MotorKind::linear};
  out.gains.back().steps = {
      {"v", "speed of the profile", limits.speed_rad_s, std::string(motion.unit("rad/s").linear)},
      {"a", "acceleration of the profile", limits.acceleration_rad_s2,
       std::string(motion.unit("rad/s2").linear)},
      {"a/j", "time in which the acceleration rises, in whole steps", rises_s, "s"},
      {"J a/T", "fraction of the full torque, or of the duty, that the acceleration needs",
       drive.extras.position.feed_forward.per_rad_s2 * limits.acceleration_rad_s2, ""}};
}

base::Problems check_position_profile(const Scenario& s, const Basis& basis,
                                      const control::DriveConfig<double>& drive) {
  base::Problems out;
  if (!drive.extras.position.on) return out;
  const PositionProfile& wanted = s.control.position.profile;
  const control::JerkProfileLimits limits = profile_limits(s, basis, drive);
  const double J = basis.shaft.J_kg_m2, most = most_torque_Nm(s, basis, drive);
  if (wanted.acceleration_rad_s2 && !sets_duty(s) && J * *wanted.acceleration_rad_s2 > most)
    out.push_back({"control.position.profile.acceleration_rad_s2", base::written(*wanted.acceleration_rad_s2),
                   "needs a torque J a = " + base::three_digits(J * *wanted.acceleration_rad_s2) +
                       " N m, and the drive's torque limit is " + base::three_digits(most) + " N m",
                   "lower this value to " + base::three_digits(torque_part * most / J) +
                       ", or raise control.speed.torque_limit_Nm"});
  const double no_load = reached_rad_s(s, basis, 0.0);
  if (wanted.speed_rad_s && *wanted.speed_rad_s > no_load)
    out.push_back({"control.position.profile.speed_rad_s", base::written(*wanted.speed_rad_s),
                   "is above the no-load speed of the bus, " + base::three_digits(no_load) + " rad/s",
                   "lower this value, or raise supply.voltage_V"});
  if (limits.smoothing_s > control::jerk_profile_longest * s.pwm.period_s)
    out.push_back(
        {wanted.jerk_rad_s3 ? "control.position.profile.jerk_rad_s3" : "control.position.profile.smoothing_s",
         base::written(wanted.jerk_rad_s3 ? *wanted.jerk_rad_s3 : limits.smoothing_s),
         "makes the acceleration rise over more than " + base::three_digits(control::jerk_profile_longest) +
             " periods",
         wanted.jerk_rad_s3 ? "raise this value" : "lower this value"});
  return out;
}

}  // namespace sixstep::study

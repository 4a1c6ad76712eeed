// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/designed_loop.hpp"

#include <cmath>

#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/design/loops/margins.hpp"
#include "sixstep/design/loops/speed_laws.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// Empty where every block of the loop is linear while no limit acts.
std::string nonlinear_block(const study::Scenario& s, const control::DriveConfig<double>& drive) {
  if (drive.current_control == control::CurrentControl::hysteresis) return "the current is held in a band";
  if (s.control.mode == Mode::current) return "";
  if (drive.speed_control == control::SpeedControl::duty) return "the speed controller sets the duty itself";
  if (s.control.mode == Mode::position && drive.extras.on && drive.extras.speed_law != control::SpeedLaw::pi)
    return "the speed controller within is another one than the PI in velocity form";
  return "";
}

design::DriveLoops loops_of(const study::Scenario& s, const study::Compiled& c,
                            const control::DriveConfig<double>& drive) {
  design::MotorModel motor = c.motor;
  motor.shaft = c.shaft;
  return {.motor = motor,
          .period_s = s.pwm.period_s,
          .delay_periods = c.board.delayed ? 1 : 0,
          .current = {drive.current.d1, drive.current.d0},
          .speed = {drive.speed.d1, drive.speed.d0},
          .current_at_full_torque_A = drive.current_at_full_torque_A,
          .position_gain_rad_s_per_deg = drive.position_gain};
}

/// What the measured answer to the setpoint makes of a speed controller.
design::Transfer speed_loop(const design::DriveLoops& loops, const control::DriveConfig<double>& drive) {
  const control::DriveExtras<double>& x = drive.extras;
  const control::SpeedLaw law = x.on ? x.speed_law : control::SpeedLaw::pi;
  switch (law) {
    case control::SpeedLaw::pi:
      break;
    case control::SpeedLaw::positional:
      return speed_loop_by_setpoint(loops, design::linear(x.speed, x.speed_derivative, x.speed_weight_off));
    case control::SpeedLaw::observed:
      return speed_loop_by_setpoint(loops, design::linear(x.laws.observed));
    case control::SpeedLaw::sliding:
      return speed_loop_by_setpoint(loops, design::linear(x.laws.sliding));
  }
  return open_speed_loop(loops);
}

/// The current across the magnet, decoupled, as field_current.hpp has it.
design::Transfer open_field_loop(const study::Scenario& s, const study::Compiled& c,
                                 const control::FieldDriveConfig<double>& field) {
  const double L_q_H = design::field_machine(c.motor, s.sheet).L_q_H;
  const design::ZohPlant plant = design::current_plant(c.motor.machine.R_ohm, L_q_H, s.pwm.period_s);
  const control::PiConfig<double>& q = field.current.q;
  const design::Transfer pi{{q.d1 + q.d0, q.d1}, {0.0, 1.0}}, held{{plant.b0}, {1.0 + plant.a0, 1.0}};
  return design::series(design::series(pi, held), design::delay(c.board.delayed ? 1 : 0));
}

/// What the speed loop sees of its speed through the scenario's sensor.
std::optional<design::SpeedLag> lag_of(const study::Scenario& s, const study::Compiled& c,
                                       const control::DriveConfig<double>& drive, double speed_rad_s) {
  const design::RotorSensing sensing = rotor_sensing_of(s);
  if (s.control.mode != Mode::speed || !sensing.lags() || speed_rad_s == 0.0) return std::nullopt;
  const double full = drive.current_at_full_torque_A * c.motor.K_t_Nm_A / c.shaft.J_kg_m2;
  return design::speed_lag(sensing, c.motor.machine.pole_pairs, std::fabs(speed_rad_s),
                           design::speed_crossover_rad_s(drive.speed.d1, full));
}

}  // namespace

DesignedLoop designed_loop(const study::Scenario& s, const study::Compiled& c, double speed_rad_s) {
  const control::DriveConfig<double>& drive = c.later.empty() ? c.drive : c.later.back().drive;
  DesignedLoop out;
  out.not_linear = nonlinear_block(s, drive);
  if (out.not_linear.empty() && c.board.sampled_in_middle)
    out.not_linear = "samples in the middle of a period are not in the linear model";
  if (c.field && s.control.mode != Mode::current)
    out.not_linear = "of a field-oriented drive it is laid beside the current alone";
  if (!out.not_linear.empty()) return out;
  if (c.field) {
    out.loop = open_field_loop(s, c, c.later.empty() ? *c.field : *c.later.back().field);
    return out;
  }
  const design::DriveLoops loops = loops_of(s, c, drive);
  if (s.control.mode == Mode::current)
    out.loop = s.load.locked ? open_current_loop(loops) : open_current_loop_turning(loops);
  else
    out.loop = s.control.mode == Mode::speed ? speed_loop(loops, drive) : open_position_loop(loops);
  out.lag = lag_of(s, c, drive, speed_rad_s);
  return out;
}

}  // namespace sixstep::analysis

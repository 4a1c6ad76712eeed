// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/designed_loop.hpp"

#include <cmath>

#include "sixstep/analysis/verify/scenario_loops.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/design/loops/deadbeat.hpp"
#include "sixstep/design/loops/margins.hpp"
#include "sixstep/design/loops/speed_laws.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;

/// The reason why the loop is not linear. Empty if every block is linear while no limit acts.
std::string nonlinear_block(const study::Scenario& s, const study::Compiled& c,
                            const control::DriveConfig<double>& drive) {
  if (drive.current_control == control::CurrentControl::hysteresis)
    return "the current controller is a hysteresis, which is not linear";
  if (c.field && c.field->finite_set.on)
    return "finite-set control chooses among the legs' states, which is not linear";
  if (s.control.mode == Mode::current) return "";
  if (drive.extras.on && drive.extras.predicts_current)
    return "with a predicted current only the current loop has a linear model";
  if (drive.speed_control == control::SpeedControl::duty)
    return "the speed controller sets the duty directly, without a current loop";
  if (s.control.mode == Mode::position && drive.extras.on && drive.extras.speed_law != control::SpeedLaw::pi)
    return "only with an inner speed controller of type PI in velocity form the position loop has a linear model";
  if (c.field && c.field->per_ampere.k_per_A != 0)
    return "a salient rotor's torque is not proportional to its current";
  return "";
}

/// The reason why the linear loop with half a period more delay does not describe samples in the middle of a
/// period. Empty if the linear loop describes them.
std::string beside_middle(const study::Scenario& s, const study::Compiled& c, bool predicts) {
  if (predicts) return "a current that is predicted from the middle of a period is not in the linear model";
  if (s.pwm.alignment == study::Alignment::edge && !c.field)
    return "with edge-aligned pulses the duty decides whether a sample in the middle of the period comes "
           "before or after the pulse's end";
  return "";
}

/// The speed loop to which the measured response to the setpoint belongs.
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

/// Lag of the measured speed by the scenario's sensor. Empty: no lag.
std::optional<design::SpeedLag> lag_of(const study::Scenario& s, const design::DriveLoops& loops,
                                       double speed_rad_s) {
  const design::RotorSensing sensing = rotor_sensing_of(s);
  if (s.control.mode != Mode::speed || !sensing.lags() || speed_rad_s == 0.0) return std::nullopt;
  const plant::Shaft& shaft = loops.motor.shaft;
  const double full = loops.current_at_full_torque_A * loops.winding.torque_Nm_A / shaft.J_kg_m2;
  return design::speed_lag(sensing, loops.motor.machine.pole_pairs, std::fabs(speed_rad_s),
                           design::speed_crossover_rad_s(loops.speed.d1, full));
}

}  // namespace

DesignedLoop designed_loop(const study::Scenario& s, const study::Compiled& c, double speed_rad_s) {
  const control::DriveConfig<double>& drive = c.later.empty() ? c.drive : c.later.back().drive;
  DesignedLoop out;
  out.not_linear = c.own.is ? "a user's controller has no linear model here" : nonlinear_block(s, c, drive);
  const bool predicts = drive.extras.on && drive.extras.predicts_current;
  if (out.not_linear.empty() && c.board.sampled_in_middle) out.not_linear = beside_middle(s, c, predicts);
  if (!out.not_linear.empty()) return out;
  if (predicts) {
    out.loop = design::open_deadbeat_loop(c.board.delayed ? 1 : 0);
    return out;
  }
  const design::DriveLoops loops = loops_of(s, c);
  if (s.control.mode == Mode::current)  // a decoupled axis has the same loop as a locked rotor
    out.loop = s.load.locked || c.field ? open_current_loop(loops) : open_current_loop_turning(loops);
  else
    out.loop = s.control.mode == Mode::speed ? speed_loop(loops, drive) : open_position_loop(loops);
  out.lag = lag_of(s, loops, speed_rad_s);
  return out;
}

}  // namespace sixstep::analysis

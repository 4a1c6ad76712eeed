// SPDX-License-Identifier: Apache-2.0
// Passes to a user's own controller the data for its design.
#include "sixstep/control/own/own_controller.h"

#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"

namespace sixstep::study {

namespace {

std::uint8_t mode_of(control::Mode mode) {
  switch (mode) {
    case control::Mode::current:
      return SIXSTEP_CURRENT;
    case control::Mode::speed:
      return SIXSTEP_SPEED;
    case control::Mode::position:
      return SIXSTEP_POSITION;
    default:
      return SIXSTEP_DUTY;
  }
}

sixstep_given given_of(const Scenario& s, const Basis& basis, const control::DriveConfig<double>& drive) {
  const design::Sheet& sheet = basis.sheet;
  const design::FieldMachine machine = design::field_machine(basis.motor, sheet);
  return {.mode = mode_of(s.control.mode),
          .delay_periods = static_cast<std::uint8_t>(s.pwm.delay_periods),
          .sampled_in_middle = s.pwm.sample == SampleAt::middle,
          .chopping = static_cast<std::uint8_t>(s.pwm.chopping),
          .period_s = s.pwm.period_s,
          .bus_V = basis.bus_V,
          .pole_pairs = machine.pole_pairs,
          .R_ohm = basis.motor.machine.R_ohm,
          .L_H = basis.motor.machine.L_H,
          .K_t_Nm_A = basis.motor.K_t_Nm_A,
          .magnet_Vs = machine.magnet_V_s / machine.pole_pairs,
          .J_kg_m2 = basis.shaft.J_kg_m2,
          .B_Nm_s = basis.shaft.B_Nm_s,
          .current_d1 = drive.current.d1,
          .current_d0 = drive.current.d0,
          .speed_d1 = drive.speed.d1,
          .speed_d0 = drive.speed.d0,
          .full_torque_Nm = drive.current_at_full_torque_A * basis.motor.K_t_Nm_A,
          .full_current_A = drive.current_at_full_torque_A,
          .current_limit_A = drive.current_limit_A,
          .position_gain_rad_s_per_deg = drive.position_gain,
          .speed_limit_rad_s = drive.speed_limit_rad_s};
}

std::vector<double> values_of(const Own& own) {
  std::vector<double> values;
  for (const UsedNumber& number : used_numbers(own)) values.push_back(number.value);
  values.push_back(0.0);  // an additional entry, so that the list is never empty
  return values;
}

}  // namespace

base::Result<rig::OwnConfig> own_designed(const Scenario& s, const Basis& basis,
                                          const control::DriveConfig<double>& drive) {
  const sixstep_controller& is = *s.control.own.loaded;
  rig::OwnConfig out{&is, rig::zero_bytes(is.config_bytes), s.control.mode, s.control.own.controller};
  const sixstep_given given = given_of(s, basis, drive);
  if (const char* wrong = is.design(&given, values_of(s.control.own).data(), out.config.data()))
    return base::Problem{"control.own", "", std::string(is.name) + " " + wrong,
                         "change the scenario, or the controller's numbers in control.own.number"};
  return out;
}

}  // namespace sixstep::study

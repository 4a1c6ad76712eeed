// SPDX-License-Identifier: Apache-2.0
// Data sheets for tests, and the messages about wrong sheets.
#pragma once
#include <string>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"

namespace sixstep::testing {

/// The sheet of the 251601 as printed.
inline design::Sheet printed_251601() {
  design::Sheet s;
  s.name = "maxon EC 45 flat 251601";
  s.pole_pairs = 8;
  s.nominal_voltage_V = {24, "", ""};
  s.resistance_ohm = {1.03, "terminal", ""};
  s.inductance_mH = {0.572, "terminal", ""};
  s.torque_constant_mNm_A = {33.5, "terminal", ""};
  s.speed_constant_rpm_V = {285, "six-step", ""};
  s.inertia_gcm2 = {135, "", ""};
  s.no_load_speed_rpm = {6710, "", ""};
  s.no_load_current_mA = {185, "", ""};
  s.nominal_torque_mNm = {83.4, "", ""};
  s.nominal_current_A = {2.33, "terminal", ""};
  s.stall_torque_mNm = {780, "", ""};
  s.stall_current_A = {23.3, "", ""};
  s.max_efficiency_percent = {83, "", ""};
  s.speed_torque_gradient_rpm_mNm = {8.76, "", ""};
  s.mechanical_time_constant_ms = {12.4, "", ""};
  return s;
}

/// Every problem of the motor model, one per line.
inline std::string told(const design::Sheet& sheet) {
  const base::Result<design::MotorModel> model = design::motor_model(sheet);
  std::string text;
  if (!model)
    for (const base::Problem& p : model.problems())
      text.append(text.empty() ? "" : "\n").append(to_string(p));
  return text;
}

}  // namespace sixstep::testing

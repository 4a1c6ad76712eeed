// SPDX-License-Identifier: Apache-2.0
// The reference motor on a bench with constant speed.
#pragma once
#include "sixstep/analysis/curve/bench.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline analysis::Bench maxon_bench() {
  analysis::Bench b;
  b.motor = *design::motor_model(maxon_sheet());
  b.motor.nominal_current_A = 2.33;
  b.voltage_V = 24.0;
  return b;
}

/// The same motor with another shape of the back-EMF, but with the same K_t.
inline analysis::Bench shaped(design::BackEmfShape shape, double flat_deg) {
  design::Sheet sheet = maxon_sheet();
  sheet.back_emf = shape;
  sheet.flat_deg = flat_deg;
  analysis::Bench b = maxon_bench();
  b.motor = *design::motor_model(sheet);
  return b;
}

/// The sheet of the reference motor with its nominal point, and with the thermal values of the similar
/// winding 339286.
inline design::Sheet curve_sheet() {
  design::Sheet s = maxon_sheet();
  const auto given = [](double value) { return base::Quantity{value, "", ""}; };
  s.nominal_speed_rpm = given(5240);
  s.nominal_torque_mNm = given(83.4);
  s.nominal_current_A = given(2.33);
  s.thermal_resistance_winding_housing_K_W = given(4.5);
  s.thermal_resistance_housing_ambient_K_W = given(4.25);
  s.thermal_time_constant_winding_s = given(16.6);
  s.thermal_time_constant_motor_s = given(212);
  s.max_winding_temperature_degC = given(125);
  return s;
}

inline const char* name_of(control::Chopping c) {
  return c == control::Chopping::soft ? "soft" : c == control::Chopping::hard ? "hard" : "complementary";
}

}  // namespace sixstep::testing

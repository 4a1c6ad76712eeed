// SPDX-License-Identifier: Apache-2.0
// Input of the sensorless designs that the tests compute by hand: the 251601 motor at 24 V.
#pragma once
#include "sixstep/design/loops/sensorless_start.hpp"

namespace sixstep::testing {

inline design::MotorModel maxon() {
  design::MotorModel m;
  m.machine = {.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8};
  m.shaft = {.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  m.K_t_Nm_A = 0.0335;
  m.nominal_current_A = 2.33;
  return m;
}

inline constexpr design::SensorlessSpec spec{.bus_V = 24, .period_s = 30e-6, .capture_Hz = 16e6};

}  // namespace sixstep::testing

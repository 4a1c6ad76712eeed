// SPDX-License-Identifier: Apache-2.0
// Scenarios of the reference motor, built in C++.
#pragma once
#include "sixstep/study/run/run.hpp"

namespace sixstep::testing {

inline design::Sheet maxon_sheet() {
  design::Sheet s;
  s.name = "maxon EC 45 flat 251601";
  s.pole_pairs = 8;
  s.nominal_voltage_V = {24.0, "", ""};
  s.resistance_ohm = {1.03, "terminal", ""};
  s.inductance_mH = {0.572, "terminal", ""};
  s.torque_constant_mNm_A = base::Quantity{33.5, "terminal", ""};
  s.inertia_gcm2 = {135.0, "", ""};
  s.viscous_friction_Nm_s = base::Quantity{7.3e-6, "", ""};
  s.stall_torque_mNm = base::Quantity{780.0, "", ""};
  return s;
}

/// The reference motor at 24 V for 20 ms, in the given mode, with ideal devices and soft chopping.
inline study::Scenario maxon_scenario(control::Mode mode, double reference) {
  study::Scenario s;
  s.sheet = maxon_sheet();
  s.duration_s = 20e-3;
  s.control.mode = mode;
  s.control.speed.torque_limit_Nm = 0.78;  // stall torque, as in the thesis's design
  s.reference.value = reference;
  return s;
}

/// The current step of the thesis: a square wave of +-5 A, with the printed gains.
inline study::Scenario current_square() {
  study::Scenario s = maxon_scenario(control::Mode::current, 0.0);
  s.control.current.d1 = 4.5;
  s.control.current.d0 = -4.04;
  s.reference.shape = study::Shape::square;
  s.reference.high = 5.0;
  s.reference.low = -5.0;
  s.reference.period_s = 10e-3;
  return s;
}

/// The same square wave with hysteresis control. The band is 0.2 A.
inline study::Scenario hysteresis() {
  study::Scenario s = current_square();
  s.control.current = {.type = study::CurrentLoopType::hysteresis, .band_A = 0.2};
  s.duration_s = 8e-3;
  return s;
}

/// A speed loop with an inner current loop. Both are designed by their settling times.
inline study::Scenario cascade(double duration_s = 8e-3) {
  study::Scenario s = maxon_scenario(control::Mode::speed, 100.0);
  s.control.current.settle_s = 1e-3;
  s.control.speed.settle_s = 10e-3;
  s.duration_s = duration_s;
  return s;
}

/// An external drive turns the motor at this constant speed, starting at this angle, so that angles have a
/// closed form. The windings carry current, so that the commutation by the sensor has a visible effect.
inline constexpr double turned_rad_s = 200, turned_from_rad = 0.3;
inline study::Scenario turned_by(study::RotorSensing rotor, double duration_s) {
  study::Scenario s = maxon_scenario(control::Mode::current, 0.5);
  s.duration_s = duration_s;
  s.control.current = {.type = study::CurrentLoopType::hysteresis, .band_A = 0.05};
  s.pwm.chopping = control::Chopping::hard;
  s.pwm.commutation = study::CommutationAt::sample;
  s.initial.angle_rad = turned_from_rad;
  s.load.dynamometer_times_s = {0};
  s.load.dynamometer_rad_s = {turned_rad_s};
  s.sensors.rotor = rotor;
  return s;
}

inline study::Measure measure(study::MetricKind metric, study::Signal signal) {
  study::Measure m;
  m.metric = metric;
  m.signal = signal;
  return m;
}
inline void ask(study::Scenario& s, const study::Measure& m) { s.compare.push_back({m, 0.0, ""}); }

}  // namespace sixstep::testing

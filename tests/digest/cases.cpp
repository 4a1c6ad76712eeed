// SPDX-License-Identifier: Apache-2.0
#include "tests/digest/cases.hpp"

#include "sixstep/study/scenario/spread.hpp"
#include "tests/support/product_scenarios.hpp"

namespace sixstep::testing {
namespace {

using namespace study;
using control::Chopping;
using control::Mode;

constexpr double thesis_d1 = 0.017225, thesis_d0 = -0.01707;  // gains of the speed loop

/// Adds figures whose computation needs roots, integrals and square roots of the trajectory.
Scenario judged(Scenario s) {
  for (const MetricKind kind :
       {MetricKind::final_value, MetricKind::mean, MetricKind::rms, MetricKind::maximum, MetricKind::minimum})
    for (const Signal signal :
         {Signal::phase_a, Signal::current, Signal::current_magnitude, Signal::speed, Signal::torque})
      ask(s, measure(kind, signal));
  ask(s, measure(MetricKind::final_value, Signal::position));
  ask(s, measure(MetricKind::mean, Signal::bus_current));
  return s;
}

Scenario duty(double value, double duration_s, Chopping chopping = Chopping::soft) {
  Scenario s = maxon_scenario(Mode::duty, value);
  s.duration_s = duration_s;
  s.pwm.chopping = chopping;
  return s;
}

Scenario stall() {
  Scenario s = duty(1.0, 5e-3);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  return s;
}

Scenario real_devices() {
  Scenario s = duty(0.5, 50e-3, Chopping::complementary);
  s.bridge.on_resistance_ohm = s.bridge.diode_resistance_ohm = 0.01;
  s.bridge.diode_drop_V = 0.7;
  s.bridge.dead_time_s = 1e-6;
  return s;
}

Scenario hysteresis(HysteresisOn on, Chopping chopping, Comparator comparator = Comparator::event) {
  Scenario s = current_square();
  s.control.current = {
      .type = CurrentLoopType::hysteresis, .band_A = 0.2, .on = on, .comparator = comparator};
  s.pwm.chopping = chopping;
  return s;
}

/// A current PI by pole placement. exp(), cos() and sqrt() determine its gains.
Scenario designed_current(double settle_s, double damping) {
  Scenario s = current_square();
  s.control.current.d1 = s.control.current.d0 = std::nullopt;
  s.control.current.settle_s = settle_s;
  s.control.current.damping = damping;
  return s;
}

Scenario speed_cascade(double reference_rad_s, double duration_s) {
  Scenario s = maxon_scenario(Mode::speed, reference_rad_s);
  s.duration_s = duration_s;
  s.control.current.d1 = 4.5;
  s.control.current.d0 = -4.04;
  s.control.speed.d1 = thesis_d1;
  s.control.speed.d0 = thesis_d0;
  s.control.speed.torque_limit_Nm = 0.78;
  return s;
}

Scenario designed_cascade() {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.2;
  s.control.speed.settle_s = 10e-3;
  s.control.speed.damping = 0.9;
  s.reference.shape = Shape::steps;
  s.reference.times_s = {0.0, 0.1};
  s.reference.values = {100.0, -40.0};
  return s;
}

Scenario hysteresis_cascade() {
  Scenario s = speed_cascade(100.0, 50e-3);
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2};
  return s;
}

Scenario position() {
  Scenario s = speed_cascade(1000.0, 0.1);
  s.control.mode = Mode::position;
  s.control.position.gain_rad_s_per_deg = 2.4;
  return s;
}

Scenario rectifier() {
  Scenario s = maxon_scenario(Mode::off, 0.0);
  s.initial.speed_rad_s = 900.0;
  return s;
}

Scenario with_sine(Scenario s) {
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.torque_constant_mNm_A = std::nullopt;  // with a sine shape, it would give another K_e
  s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  return s;
}

Scenario rc_bus(Scenario s) {
  s.supply.resistance_ohm = 0.1;
  s.supply.capacitance_F = 1000e-6;
  s.initial.bus_V = 24.0;
  ask(s, measure(MetricKind::maximum, Signal::bus_voltage));
  return s;
}

Scenario regeneration(bool sinks) {
  Scenario s = rc_bus(duty(0.3, 20e-3, Chopping::complementary));
  s.supply.sinks = sinks;
  s.bridge.dead_time_s = 1e-6;
  s.initial.speed_rad_s = 500.0;
  return s;
}

Scenario friction_and_load() {
  Scenario s = duty(0.5, 0.1);
  s.load.coulomb_Nm = 0.005;
  s.load.times_s = {0.0, 0.03, 0.06};
  s.load.torques_Nm = {0.0, 0.05, 0.25};
  return s;
}

/// The timing of a small chip: centre-aligned PWM with edges on timer counts, commutation at the sample, and
/// one period of delay.
Scenario small_chip(Scenario s) {
  s.pwm.alignment = Alignment::centre;
  s.pwm.timer_Hz = 16e6;
  s.pwm.commutation = CommutationAt::sample;
  s.pwm.delay_periods = 1;
  return s;
}

Scenario in_float(Scenario s) {
  s.control.arithmetic = Arithmetic::float32;
  return s;
}

Scenario narrow_flat() {
  Scenario s = duty(-0.7, 30e-3);
  s.sheet.flat_deg = 100.0;
  s.bridge.dead_time_s = 0.5e-6;
  s.bridge.dead_time_at_commutation = true;
  return s;
}

/// One drive of a [[spread]]. Its R and L are normally distributed, so they depend on the bits of the random
/// generator, of log(), cos() and sqrt().
Scenario series_drive() {
  Scenario s = current_square();
  for (const char* key : {"motor_override.resistance_ohm", "motor_override.inductance_mH"}) {
    Spread spread;
    spread.key = key;
    spread.distribution = Distribution::normal;
    spread.relative = 0.05;
    s.spread.push_back(spread);
  }
  return varied(s, 1, 17);
}

/// Current counts with noise, from one shunt, in 16-bit arithmetic.
Scenario one_shunt_q15() {
  Scenario s = designed_current(1e-3, 0.9);
  s.control.arithmetic = Arithmetic::q15;
  s.sensors = board_sensors();
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.sensors.current_noise_A = 0.02;
  s.sensors.seed = 5;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  return s;
}

/// The product's firmware as on a chip, with calibration, alignment, speed from Hall edges, and a broken
/// line.
Scenario product(Arithmetic arithmetic) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.3;
  s.control.arithmetic = arithmetic;
  s.sensors.current_noise_A = 0.01;
  s.protection.align = {.current_A = 3.0, .longest_s = 0.1, .settled_s = 5e-3};
  s.sensors.hall_break = {.at_s = 0.25, .line = 2, .level = Level01::high};
  return s;
}

Scenario with_extras(Scenario s) {
  s.control.slew = 2000.0;
  s.control.limits.current_A = 8.0;
  s.control.current.back_emf_feed_forward = true;
  s.control.current.measured_bus_from_V = 12.0;
  s.control.smooth_chopping.on = true;
  s.bridge.dead_time_s = 1e-6;
  return s;
}

// The cases below need the general kernel.
Scenario delta() {
  Scenario s = duty(0.5, 50e-3);
  s.sheet.connection = design::WindingConnection::delta;
  s.sheet.cogging_orders = {48};
  s.sheet.cogging_mNm = {8};
  return s;
}
Scenario salient_harmonics() {
  Scenario s = with_sine(duty(0.5, 50e-3));
  s.sheet.inductance_mH.reset();
  s.sheet.d_axis_inductance_mH = base::Quantity{0.24, "phase", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.34, "phase", ""};
  s.sheet.harmonic_orders = {3, 5};
  s.sheet.harmonic_sizes = {0.12, -0.05};
  s.sheet.phase_resistance_deviation = {0.05, -0.03, 0};
  return s;
}
Scenario elastic_gear(Scenario s) {
  s.load.gear = 2;
  s.load.inertia_kg_m2 = 5e-5;
  s.load.stiffness_Nm_rad = 2;
  s.load.damping_Nm_s_rad = 1e-4;
  s.load.fan_Nm_s2 = 1e-6;
  s.load.gravity_Nm = 0.01;
  s.load.coulomb_Nm = 0.003;
  return s;
}
Scenario igbts_and_chopper() {
  Scenario s = regeneration(false);
  s.bridge.device = Device::igbt;
  s.bridge.saturation_V = 0.9;
  s.supply.inductance_H = 5e-6;
  s.supply.brake_resistance_ohm = 2;
  s.supply.brake_on_V = 30;
  s.supply.brake_off_V = 28;
  return s;
}
/// Wires that are mirrored at the start and corrected in the middle of the run, and an amplifier that drifts.
Scenario crossed_wires() {
  Scenario s = small_chip(current_square());
  s.bridge.phases = rig::WireOrder::bac;
  s.sensors.hall_lines = rig::WireOrder::acb;
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 20.48;
  At straight;
  straight.time_s = 7.123e-3;
  straight.bridge.phases = AtOrder::abc;
  straight.sensors.hall_lines = AtOrder::abc;
  straight.sensors.current_gain_error = 0.1;
  s.at.push_back(straight);
  return s;
}

/// Each case has a separate function. Forty scenarios in one function would need a megabyte of stack, which
/// is the whole stack of WebAssembly.
struct Row {
  const char* name;
  Scenario (*scenario)();
};
constexpr Row kRows[] = {
    {"R1-stall", [] { return stall(); }},
    {"R2-no-load", [] { return duty(1.0, 0.3); }},
    {"R3-soft", [] { return duty(0.5, 0.1); }},
    {"R4-hard", [] { return duty(0.5, 50e-3, Chopping::hard); }},
    {"R5-devices", [] { return real_devices(); }},
    {"R6-current-pi", [] { return current_square(); }},
    {"R7-hysteresis-phase", [] { return hysteresis(HysteresisOn::phase, Chopping::hard); }},
    {"R7s-hysteresis-motor", [] { return hysteresis(HysteresisOn::motor, Chopping::soft); }},
    {"R8-speed-cascade", [] { return speed_cascade(100.0, 0.1); }},
    {"R9-position", [] { return position(); }},
    {"R10-rectifier", [] { return rectifier(); }},
    {"R11-sine", [] { return with_sine(duty(0.5, 50e-3)); }},
    {"R12-rc-bus", [] { return rc_bus(duty(0.5, 50e-3)); }},
    {"R12b-regeneration", [] { return regeneration(true); }},
    {"R13-friction", [] { return friction_and_load(); }},
    {"design-current", [] { return designed_current(1e-3, 0.9); }},
    {"design-current-weak", [] { return designed_current(2e-3, 0.4); }},
    {"design-current-stiff", [] { return designed_current(0.5e-3, 1.0); }},
    {"design-cascade", [] { return designed_cascade(); }},
    {"sine-design-current", [] { return with_sine(designed_current(1e-3, 0.9)); }},
    {"sine-design-cascade", [] { return with_sine(designed_cascade()); }},
    {"sine-rc-bus", [] { return with_sine(regeneration(true)); }},
    {"float-current-pi", [] { return in_float(current_square()); }},
    {"float-design-cascade", [] { return in_float(designed_cascade()); }},
    {"float-hysteresis", [] { return in_float(hysteresis(HysteresisOn::motor, Chopping::soft)); }},
    {"hysteresis-sampled",
     [] { return hysteresis(HysteresisOn::motor, Chopping::soft, Comparator::sampled); }},
    {"hysteresis-phase-soft", [] { return hysteresis(HysteresisOn::phase, Chopping::soft); }},
    {"hysteresis-cascade", [] { return hysteresis_cascade(); }},
    {"small-chip-current-pi", [] { return small_chip(current_square()); }},
    {"small-chip-cascade", [] { return small_chip(designed_cascade()); }},
    {"diode-source", [] { return regeneration(false); }},
    {"narrow-flat-reverse", [] { return narrow_flat(); }},
    {"series-drive", [] { return series_drive(); }},
    {"one-shunt-q15", [] { return one_shunt_q15(); }},
    {"product", [] { return product(Arithmetic::float64); }},
    {"product-q31", [] { return product(Arithmetic::q31); }},
    {"extras-cascade", [] { return with_extras(designed_cascade()); }},
    {"general-delta", [] { return delta(); }},
    {"general-salient", [] { return salient_harmonics(); }},
    {"general-elastic-cascade", [] { return elastic_gear(designed_cascade()); }},
    {"general-igbt-chopper", [] { return igbts_and_chopper(); }},
    {"general-product", [] { return elastic_gear(product(Arithmetic::q31)); }},
    {"general-crossed-wires", [] { return crossed_wires(); }},
};

}  // namespace

std::vector<Case> digest_cases() {
  std::vector<Case> cases;
  for (const Row& row : kRows) cases.push_back({row.name, judged(row.scenario())});
  return cases;
}

}  // namespace sixstep::testing

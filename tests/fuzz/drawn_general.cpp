// SPDX-License-Identifier: Apache-2.0
// Draws keys that need the general kernel. These keys are drawn last, so that the other values of a seed do
// not change.
#include <algorithm>
#include <numbers>

#include "tests/fuzz/drawn_parts.hpp"

namespace sixstep::testing {

using namespace study;

namespace {

void draw_machine(Draw& draw, Scenario& s, const Scales& of) {
  design::Sheet& sheet = s.sheet;
  if (draw.chance(0.2) && sheet.back_emf == design::BackEmfShape::sine) {
    sheet.harmonic_orders = {3, 5};
    sheet.harmonic_sizes = {draw.between(-0.2, 0.2), draw.between(-0.1, 0.1)};
  }
  if (draw.chance(0.2)) {
    sheet.phase_resistance_deviation = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), 0.0};
    sheet.phase_back_emf_deviation = {draw.between(-0.05, 0.05), 0.0, draw.between(-0.05, 0.05)};
  }
  if (draw.chance(0.2) && sheet.pole_pairs) {
    sheet.cogging_orders = {6.0 * *sheet.pole_pairs};
    sheet.cogging_mNm = {1e3 * draw.decades(1e-4, 0.05) * of.stall_Nm};
  }
}

void draw_shaft(Draw& draw, Scenario& s, const Scales& of) {
  Load& l = s.load;
  const double J = of.K_t_Nm_A * of.K_t_Nm_A / of.R_tt_ohm * 1e-2;
  if (draw.chance(0.25)) l.gear = draw.decades(0.5, 20.0);
  if (l.gear != 1 && draw.chance(0.4)) l.gear_efficiency = draw.between(0.4, 0.99);
  if (draw.chance(0.2)) {
    l.inertia_kg_m2 = J * draw.decades(0.1, 10.0) * l.gear * l.gear;
    l.stiffness_Nm_rad = l.inertia_kg_m2 * draw.decades(1e2, 1e7);
    if (draw.chance(0.5)) l.damping_Nm_s_rad = l.inertia_kg_m2 * draw.decades(1e-1, 1e3);
  }
  const double top = of.top_rad_s / l.gear, torque = of.stall_Nm * l.gear;
  if (draw.chance(0.15)) l.fan_Nm_s2 = draw.decades(1e-3, 0.3) * torque / (top * top);
  if (draw.chance(0.15)) {
    l.gravity_Nm = draw.between(-0.3, 0.3) * torque;
    l.gravity_angle_deg = draw.between(-180, 180);
  }
  if (draw.chance(0.15)) {
    l.at_speeds_rad_s = {-top, 0, draw.between(0.1, 0.5) * top, top};
    l.at_speeds_Nm = {draw.between(-0.2, 0.2) * torque, 0, draw.between(0, 0.2) * torque,
                      draw.between(0, 0.3) * torque};
  }
  if (!l.times_s.empty() && draw.chance(0.4)) l.between = Between::lines;
}

void draw_source(Draw& draw, Scenario& s, const Scales& of) {
  Supply& v = s.supply;
  if (!(v.capacitance_F > 0)) return;
  if (draw.chance(0.3)) v.capacitor_resistance_ohm = draw.decades(1e-3, 0.3) * v.resistance_ohm;
  if (draw.chance(0.3)) v.inductance_H = draw.decades(0.1, 100.0) * of.L_tt_H * 1e-2;
  if (!v.sinks && draw.chance(0.4)) v.sink_limit_A = draw.decades(1e-3, 0.3) * of.stall_A;
  const bool moves = !s.at.empty() && std::any_of(s.at.begin(), s.at.end(), [](const At& at) {
    return at.supply.voltage_V.has_value();
  });
  if (moves) return;
  if (draw.chance(0.25)) {
    v.source = SourceKind::battery;
    v.battery_charges = {0, 0.3, 1};
    v.battery_voltages_V = {0.8 * v.voltage_V, 0.95 * v.voltage_V, 1.05 * v.voltage_V};
    v.battery_capacity_Ah = draw.decades(1e-6, 1.0);
    v.battery_charge = draw.between(0.2, 1.0);
    if (draw.chance(0.5)) {
      v.battery_recovery_ohm = draw.decades(0.1, 1.0) * v.resistance_ohm;
      v.battery_recovery_F = draw.decades(1.0, 100.0) * v.capacitance_F;
    }
  } else if (draw.chance(0.25)) {
    v.source = draw.chance(0.5) ? SourceKind::single_phase : SourceKind::three_phase;
    v.mains_rms_V = v.voltage_V / std::numbers::sqrt2;
    v.mains_Hz = draw.decades(16.7, 1000.0);
    if (draw.chance(0.5)) v.rectifier_drop_V = 0.01 * v.voltage_V;
  }
  if (draw.chance(0.2)) {
    v.brake_resistance_ohm = draw.decades(1.0, 10.0) * of.R_tt_ohm;
    v.brake_on_V = 1.4 * v.voltage_V;
    v.brake_off_V = 1.2 * v.voltage_V;
  }
}

void draw_failures(Draw& draw, Scenario& s) {
  At at;
  at.time_s = draw.between(0.2, 0.9) * s.duration_s;
  if (draw.chance(0.1)) at.motor.broken_wire = static_cast<Wire>(1 + draw.one_of(3));
  if (draw.chance(0.1)) at.bridge.open_switch = static_cast<Switch>(1 + draw.one_of(6));
  if (at.motor.broken_wire != Wire::none || at.bridge.open_switch != Switch::none) s.at.push_back(at);
}

void draw_probes(Draw& draw, Scenario& s, const Scales& of) {
  Sensors& x = s.sensors;
  if (draw.chance(0.4)) x.hall_spacing = control::HallArrangement::degrees_60;
  if (draw.chance(0.6)) x.hall_offset_deg = draw.between(-25, 25);
  if (draw.chance(0.4)) x.hall_hysteresis_deg = draw.between(0, 6);
  if (draw.chance(0.6)) {
    const bool by_magnet = s.sheet.pole_pairs && draw.chance(0.4);
    x.hall_edges_deg.resize(by_magnet ? 6 * static_cast<std::size_t>(*s.sheet.pole_pairs) : 6);
    for (double& own : x.hall_edges_deg) own = draw.between(-8, 8);
  }
  if (draw.chance(0.3)) x.hall_delay_s = std::min(2e-4, draw.decades(1e-4, 0.1) / of.top_rad_s);
  if (draw.chance(0.1)) {
    x.hall_glitches_Hz = 3 / s.duration_s;
    x.hall_glitch_s = draw.decades(1e-8, 1e-5);
  }
}

void draw_shaft_sensor(Draw& draw, Scenario& s) {
  if (s.control.drive != FirmwareKind::lean) return;
  Sensors& x = s.sensors;
  s.pwm.commutation = CommutationAt::sample;
  const RotorSensing kinds[] = {RotorSensing::encoder, RotorSensing::absolute, RotorSensing::resolver};
  x.rotor = kinds[draw.one_of(3)];
  x.encoder = {64 << draw.one_of(8), draw.chance(0.7)};
  x.absolute = {10 + draw.one_of(9), draw.between(0, 0.9) * s.pwm.period_s, 1 + draw.one_of(8)};
  x.resolver.excitation_Hz = 0.5 / (s.pwm.period_s * (1 + draw.one_of(3)));
  x.resolver.bandwidth_Hz = draw.between(0.01, 0.2) * x.resolver.excitation_Hz;
  x.resolver.imbalance = draw.between(-0.02, 0.02);
  x.resolver.quadrature_deg = draw.between(-1, 1);
  x.resolver.noise_V = draw.decades(1e-5, 1e-2);
}

/// Draws how the shaft sensor is read, where it is mounted, and its faults. This happens after all other
/// values of a seed.
void draw_shaft_faults(Draw& draw, Scenario& s) {
  Sensors& x = s.sensors;
  if (s.control.drive == FirmwareKind::product || x.rotor == RotorSensing::ideal) return;
  if (x.rotor == RotorSensing::hall) {
    const rig::HallAngleFrom from[] = {rig::HallAngleFrom::sectors, rig::HallAngleFrom::angle,
                                       rig::HallAngleFrom::learned_edges};
    x.hall_angle = from[draw.one_of(3)];
    x.hall_calibration_turns = 1 + draw.one_of(16);
    return;
  }
  if (draw.chance(0.25)) x.shaft = SensorShaft::load;
  if (draw.chance(0.4)) {
    x.resolver.reading = rig::ResolverReading::tracking;
    x.resolver.bits = 10 + draw.one_of(7);
    x.resolver.latency_s = draw.between(0, 0.9) * s.pwm.period_s;
  } else {
    x.resolver.calibrated = x.resolver.quadrature_deg > 0;
  }
  if (x.resolver.imbalance < 0) x.resolver.sine_phase_deg = 500 * x.resolver.imbalance;
  if (draw.chance(0.3)) x.encoder.missed_Hz = draw.decades(1.0, 100.0) / s.duration_s;
  if (!draw.chance(0.3)) return;
  At at;
  at.time_s = draw.between(0, 0.9) * s.duration_s;
  if (x.rotor == RotorSensing::encoder) at.sensors.missed_edges = 1 + draw.one_of(100);
  if (x.rotor == RotorSensing::absolute)
    at.sensors.bad_track = AtTrack{1 + draw.one_of(x.absolute.bits), EncoderLevel::high};
  if (x.rotor == RotorSensing::resolver) at.sensors.broken_winding = Winding::sine;
  x.watched = draw.chance(0.5);
  if (draw.chance(0.5)) {
    const EncoderLevel levels[] = {EncoderLevel::low, EncoderLevel::high, EncoderLevel::whole};
    const EncoderLine lines[] = {EncoderLine::A, EncoderLine::B, EncoderLine::Z};
    if (x.rotor == RotorSensing::encoder)
      at.sensors.encoder_line = AtEncoderLine{lines[draw.one_of(3)], levels[draw.one_of(3)]};
    if (x.rotor == RotorSensing::encoder) at.sensors.false_index = draw.chance(0.3);
    if (x.rotor == RotorSensing::resolver) at.sensors.excitation = draw.between(0, 2);
    if (x.rotor == RotorSensing::absolute) at.sensors.bad_track->level = levels[draw.one_of(3)];
  }
  s.at.push_back(at);
}

}  // namespace

void draw_general(Draw& draw, Scenario& s, const Scales& of) {
  if (!draw.chance(0.4)) return;
  if (draw.chance(0.4)) draw_machine(draw, s, of);
  if (draw.chance(0.5)) draw_shaft(draw, s, of);
  if (draw.chance(0.6)) draw_source(draw, s, of);
  if (draw.chance(0.2)) {
    s.bridge.device = Device::igbt;
    s.bridge.saturation_V = draw.between(0.5, 2.0);
  }
  if (draw.chance(0.2)) {
    s.heat.devices = true;
    s.bridge.junction_K_W = draw.decades(0.1, 10.0);
    s.bridge.on_resistance_percent_K = 0.6;
  }
  draw_failures(draw, s);
  if (draw.chance(0.4)) draw_probes(draw, s, of);
  if (draw.chance(0.3)) draw_shaft_sensor(draw, s);
  draw_shaft_faults(draw, s);
}

}  // namespace sixstep::testing

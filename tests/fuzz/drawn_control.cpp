// SPDX-License-Identifier: Apache-2.0
// Draws controllers, sensors and protection.
#include <algorithm>

#include "tests/fuzz/drawn_parts.hpp"

namespace sixstep::testing {

using namespace study;
using control::Mode;

namespace {

/// Draws gains in one of three forms: settling time with damping, d1 with d0, or k_p with k_i. `natural` is a
/// proportional gain of usual size.
template <class Loop>
void draw_gains(Draw& draw, Loop& loop, double natural, double period_s, double slowest_periods) {
  const double d1 = natural * draw.decades(0.1, 1.5), ratio = draw.between(-1.0, -0.6);
  switch (draw.one_of(3)) {
    case 0:
      loop.settle_s = period_s * draw.decades(4.0, slowest_periods);
      loop.damping = draw.between(0.3, 1.0);
      return;
    case 1:
      loop.d1 = d1;
      loop.d0 = d1 * ratio;
      return;
    default:
      loop.kp = d1;
      loop.ki = d1 * (1 + ratio);
  }
}

void draw_current_loop(Draw& draw, Scenario& s, const Scales& of, bool outer) {
  CurrentLoop& loop = s.control.current;
  const double per_period = of.L_tt_H / s.pwm.period_s;
  if (draw.chance(0.35)) {
    loop.type = CurrentLoopType::hysteresis;
    loop.band_A = draw.decades(0.2, 10.0) * of.U_V / per_period;
    const bool sampled = draw.chance(0.4) || s.pwm.delay_periods > 0 || s.pwm.sample == SampleAt::middle;
    loop.comparator = sampled ? Comparator::sampled : Comparator::event;
    if (!sampled && draw.chance(0.5)) loop.on = HysteresisOn::phase;
  } else {
    draw_gains(draw, loop, per_period, s.pwm.period_s, 60.0);
    loop.back_emf_feed_forward = draw.chance(0.3);
    if (draw.chance(0.3)) loop.measured_bus_from_V = draw.between(0.3, 0.8) * of.U_V;
  }
  if (outer && draw.chance(0.7)) loop.limit_A = of.kept_A;
}

void draw_limits(Draw& draw, Scenario& s, const Scales& of) {
  Limits& l = s.control.limits;
  if (draw.chance(0.2)) l.current_A = draw.between(0.3, 1.0) * of.kept_A;
  if (draw.chance(0.2)) l.torque_Nm = draw.between(0.3, 1.0) * of.kept_A * of.K_t_Nm_A;
  if (draw.chance(0.2)) l.speed_rad_s = draw.between(0.2, 1.0) * of.top_rad_s;
  if (s.supply.capacitance_F > 0 && draw.chance(0.4))
    s.control.regeneration.limit_V = draw.between(1.05, 1.5) * of.U_V;
}

/// The full output of the speed loop is a torque. With the natural gain, the output is full at an error of a
/// tenth of the top speed.
void draw_speed_loop(Draw& draw, Scenario& s, const Scales& of) {
  SpeedLoop& loop = s.control.speed;
  if (draw.chance(0.2)) loop.output = SpeedOutput::duty;
  if (draw.chance(0.3)) loop.form = SpeedForm::positional;
  draw_gains(draw, loop, 10.0 / of.top_rad_s, s.pwm.period_s, 500.0);
  if (loop.output == SpeedOutput::current) loop.torque_limit_Nm = of.kept_A * of.K_t_Nm_A;
  if (loop.form != SpeedForm::positional) return;
  if (draw.chance(0.5)) loop.anti_windup = draw.unit();
  if (draw.chance(0.5)) loop.derivative_s = draw.decades(0.5, 20.0) * s.pwm.period_s;
  if (loop.derivative_s && draw.chance(0.5)) loop.derivative_filter_s = *loop.derivative_s * draw.unit();
}

/// Draws a sensorless start and the run after it, with or without Hall probes.
void draw_sensorless(Draw& draw, Scenario& s) {
  s.control.drive = FirmwareKind::sensorless;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  Sensorless& x = s.control.sensorless;
  x.greatest_load = draw.between(0.0, 0.6);
  x.overload = draw.between(1.0, 3.0);
  x.lowest_part = draw.between(0.02, 0.2);
  if (draw.chance(0.3)) x.advance_deg = draw.between(0.0, 20.0);
  if (draw.chance(0.3)) x.blanking_s = draw.unit() * s.pwm.period_s;
  x.follows = static_cast<control::Follow>(draw.one_of(4));
  x.catches_spin = draw.chance(0.7);
  if (draw.chance(0.3)) x.starts_by = StartsBy::pulses;
  x.falls_back = draw.chance(0.7);
  if (draw.chance(0.3)) x.commutates = Commutates::hall;
}

}  // namespace

void draw_control(Draw& draw, Scenario& s, Scales& of) {
  static constexpr Mode modes[] = {Mode::off,     Mode::duty,  Mode::duty,  Mode::current,  Mode::current,
                                   Mode::current, Mode::speed, Mode::speed, Mode::position, Mode::speed};
  Control& c = s.control;
  of.kept_A = of.stall_A * draw.decades(0.05, 0.8);
  c.mode = modes[draw.one_of(10)];
  c.arithmetic = static_cast<Arithmetic>(draw.one_of(6));
  if (draw.chance(0.3)) c.drive = FirmwareKind::product;
  const bool speed = c.mode == Mode::speed || c.mode == Mode::position;
  if (speed) draw_speed_loop(draw, s, of);
  const bool current = c.mode == Mode::current || (speed && c.speed.output == SpeedOutput::current);
  if (current) {
    draw_current_loop(draw, s, of, speed);
    draw_limits(draw, s, of);
  }
  if (c.mode == Mode::position) c.position.gain_rad_s_per_deg = draw.decades(1e-3, 0.1) * of.top_rad_s;
  if (c.mode == Mode::position && draw.chance(0.6))
    c.position.speed_limit_rad_s = draw.between(0.1, 0.9) * of.top_rad_s;
  if (c.mode != Mode::off && draw.chance(0.15)) {
    const double unit = c.mode == Mode::duty      ? 1.0
                        : c.mode == Mode::current ? of.kept_A
                        : c.mode == Mode::speed   ? of.top_rad_s
                                                  : 90.0;
    c.slew = unit / (s.pwm.period_s * draw.decades(1.0, 200.0));
  }
  if (c.drive == FirmwareKind::lean && c.mode != Mode::position && c.current.type == CurrentLoopType::pi &&
      draw.chance(0.15))
    draw_sensorless(draw, s);
  c.smooth_chopping.on = current && c.current.type == CurrentLoopType::pi && draw.chance(0.15);
}

void draw_sensors(Draw& draw, Scenario& s, const Scales& of) {
  Sensors& sensors = s.sensors;
  const bool product = s.control.drive == FirmwareKind::product;
  const bool by_hall = s.control.sensorless.commutates == Commutates::hall;
  const bool by_pulses = s.control.sensorless.starts_by == StartsBy::pulses;
  if (!product && !by_hall && !by_pulses && draw.chance(0.5)) return;
  const bool narrow = s.control.arithmetic == Arithmetic::q15 || s.control.arithmetic == Arithmetic::q14;
  sensors.adc_bits = narrow ? 8 + draw.one_of(5) : 8 + draw.one_of(9);
  sensors.seed = draw.one_of(1000);
  if (product || by_pulses || draw.chance(0.6)) {
    const bool late = product && s.pwm.delay_periods > 0;
    sensors.currents = s.pwm.sample == SampleAt::middle && !late && !by_pulses && draw.chance(0.5)
                           ? rig::CurrentMeasurement::dc_link
                           : rig::CurrentMeasurement::phases;
    sensors.current_range_A = of.kept_A * draw.decades(1.5, 6.0);
    if (draw.chance(0.5)) sensors.current_offset_A = draw.between(-0.01, 0.01) * *sensors.current_range_A;
    if (draw.chance(0.5)) sensors.current_gain_error = draw.between(-0.05, 0.05);
    if (draw.chance(0.5)) sensors.current_noise_A = draw.decades(1e-4, 1e-2) * *sensors.current_range_A;
    if (draw.chance(0.3)) sensors.current_bandwidth_Hz = draw.decades(0.5, 500.0) / s.pwm.period_s;
    if (draw.chance(0.2)) sensors.current_delay_s = draw.between(0.0, 0.99) * s.pwm.period_s;
    sensors.calibrated = draw.chance(0.7);
    sensors.shunt_settle_s = draw.decades(1e-3, 0.1) * s.pwm.period_s;
  }
  if (product || draw.chance(0.5)) {
    sensors.bus = BusSensing::adc;
    sensors.bus_range_V = of.U_V * draw.between(1.6, 3.0);
    if (draw.chance(0.5)) sensors.bus_offset_V = draw.between(-0.02, 0.02) * of.U_V;
    if (draw.chance(0.5)) sensors.bus_gain_error = draw.between(-0.03, 0.03);
    if (draw.chance(0.3)) sensors.bus_bandwidth_Hz = draw.decades(0.01, 100.0) / s.pwm.period_s;
    if (draw.chance(0.5)) sensors.bus_noise_V = draw.decades(1e-4, 1e-2) * of.U_V;
  }
  if (product || by_hall || draw.chance(0.6)) {
    sensors.rotor = RotorSensing::hall;
    sensors.speed_edges = 1 + draw.one_of(6);
    sensors.capture_Hz = narrow ? draw.decades(1e4, 1e6) : draw.decades(1e5, 1e8);
    sensors.timeout_s = std::min(draw.decades(1e-3, 0.1), 0x1p30 / sensors.capture_Hz);
  }
  if (draw.chance(0.1))
    sensors.hall_break = {draw.between(0.0, 0.99) * s.duration_s, 1 + draw.one_of(3),
                          static_cast<Level01>(draw.one_of(2))};
}

/// Draws thresholds that are within the converters' range and that normal operation does not reach.
void draw_protection(Draw& draw, Scenario& s, const Scales& of) {
  Protection& p = s.protection;
  const bool loop = s.control.mode != Mode::off && s.control.mode != Mode::duty &&
                    s.control.speed.output == SpeedOutput::current;
  p.over_current_A = draw.between(0.8, 0.98) * s.sensors.current_range_A.value_or(1.0);
  p.over_voltage_V = std::min(1.5 * of.U_V, 0.98 * s.sensors.bus_range_V.value_or(1.0));
  p.under_voltage_V = draw.between(0.1, 0.6) * of.U_V;
  const bool floating =
      s.control.arithmetic == Arithmetic::float64 || s.control.arithmetic == Arithmetic::float32;
  p.over_speed_rad_s = of.top_rad_s * (floating ? draw.between(1.2, 2.0) : draw.between(0.7, 0.95));
  p.voltage_samples = 1 + draw.one_of(10);
  if (draw.chance(0.4)) {
    p.stall_current_A = draw.between(0.2, 0.7) * *p.over_current_A;
    // A threshold above the speed loop's limit would never trigger.
    if (loop && s.control.mode != Mode::current)
      p.stall_current_A = std::min(*p.stall_current_A, 0.5 * of.kept_A);
    p.stall_s = draw.between(5.0, 200.0) * s.pwm.period_s;
  }
  if (draw.chance(0.3)) p.offset_tolerance_A = draw.between(0.02, 0.1) * *s.sensors.current_range_A;
  if (loop && draw.chance(0.4))
    p.align = {draw.between(0.05, 0.5) * *p.over_current_A, draw.between(20.0, 100.0) * s.pwm.period_s,
               draw.between(1.0, 15.0) * s.pwm.period_s, draw.one_of(6)};
  if (loop && draw.chance(0.4)) p.brake_current_A = draw.between(0.05, 0.5) * *p.over_current_A;
  if (draw.chance(0.3)) p.short_below_rad_s = draw.between(0.0, 0.2) * of.top_rad_s;
  if (draw.chance(0.3)) p.standing_rad_s = draw.between(0.0, 0.1) * of.top_rad_s;
  if (draw.chance(0.4)) p.off_at_s = draw.between(0.2, 0.95) * s.duration_s;
  const double samples_per_sector = of.sector_rad / (*p.over_speed_rad_s * s.pwm.period_s);
  if (samples_per_sector >= 3 && draw.chance(0.3)) s.sensors.hall_stable_samples = 2;
  if (draw.chance(0.3))
    s.control.advance = {draw.between(0.0, 25.0), draw.decades(1e-3, 1e-1) * 30.0 / of.top_rad_s, 30.0};
}

}  // namespace sixstep::testing

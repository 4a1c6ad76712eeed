// SPDX-License-Identifier: Apache-2.0
// Draws supply, bridge, modulation, load and start.
#include "tests/fuzz/drawn_parts.hpp"

#include <algorithm>
#include <numbers>

#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::testing {

using namespace study;
using control::Mode;

namespace {

void draw_supply(Draw& draw, Scenario& s, const design::MotorModel& motor) {
  s.supply.voltage_V = motor.nominal_voltage_V * draw.decades(0.4, 1.5);
  if (!draw.chance(0.35)) return;
  // The capacitance C is at least L/R^2, so that the stall current of the winding cannot discharge the
  // capacitor below 0 V.
  const double R = motor.machine.R_ohm, least = motor.machine.L_H / (R * R);
  s.supply.resistance_ohm = draw.decades(1e-2, 0.5) * R;
  s.supply.capacitance_F = draw.decades(1.0, 300.0) * least;
  s.supply.sinks = draw.chance(0.5);
  if (draw.chance(0.4)) s.initial.bus_V = draw.between(0.8, 1.2) * s.supply.voltage_V;
}

void draw_bridge(Draw& draw, Scenario& s, double R_ohm) {
  if (draw.chance(0.5)) s.bridge.on_resistance_ohm = draw.decades(1e-3, 0.3) * R_ohm;
  if (draw.chance(0.5)) s.bridge.diode_drop_V = draw.between(0.2, 1.2);
  if (draw.chance(0.5)) s.bridge.diode_resistance_ohm = draw.decades(1e-3, 0.3) * R_ohm;
  if (draw.chance(0.6)) s.bridge.dead_time_s = draw.decades(1e-3, 0.3) * s.pwm.period_s;
  // The check refuses a timer whose counts shorten the dead time.
  if (s.pwm.timer_Hz > 0)
    s.bridge.dead_time_s = std::ceil(s.bridge.dead_time_s * s.pwm.timer_Hz) / s.pwm.timer_Hz;
  s.bridge.dead_time_at_commutation = draw.chance(0.4);
}

void draw_pwm(Draw& draw, Scenario& s, const Scales& of) {
  Pwm& p = s.pwm;
  p.period_s = draw.chance(0.3) ? 30e-6 : draw.decades(2e-2, 0.5) * of.L_tt_H / of.R_tt_ohm;
  p.period_s = std::clamp(p.period_s, 4e-6, 5e-4);
  p.alignment = draw.chance(0.4) ? Alignment::centre : Alignment::edge;
  p.chopping = static_cast<control::Chopping>(draw.one_of(3));
  p.commutation = draw.chance(0.3) ? CommutationAt::sample : CommutationAt::hall_edge;
  p.sample = draw.chance(0.3) ? SampleAt::middle : SampleAt::start;
  p.delay_periods = draw.chance(0.3) ? 1 : 0;
  if (draw.chance(0.4)) p.timer_Hz = draw.chance(0.5) ? 16e6 : draw.decades(1e6, 2e8);
}

void draw_load(Draw& draw, Scenario& s, const Scales& of) {
  Load& load = s.load;
  if (draw.chance(0.3)) load.torque_Nm = draw.between(-0.4, 0.4) * of.stall_Nm;
  if (draw.chance(0.2)) {
    load.torque_Nm = 0.0;
    load.times_s = {0.0, draw.between(0.1, 0.5) * s.duration_s, draw.between(0.6, 0.9) * s.duration_s};
    for (int n = 0; n < 3; ++n) load.torques_Nm.push_back(draw.between(-0.4, 0.4) * of.stall_Nm);
  }
  if (draw.chance(0.3)) load.viscous_Nm_s = draw.decades(1e-5, 0.1) * of.stall_Nm / of.top_rad_s;
  if (draw.chance(0.3)) load.coulomb_Nm = draw.decades(1e-4, 0.3) * of.stall_Nm;
  if (draw.chance(0.2)) load.static_Nm = draw.decades(1e-3, 0.5) * of.stall_Nm;
  if (draw.chance(0.3)) load.inertia_kg_m2 = draw.decades(1e-7, 1e-3);
  load.locked = draw.chance(0.08);
}

void draw_start(Draw& draw, Scenario& s, const Scales& of) {
  if (!s.load.locked && draw.chance(0.5)) s.initial.speed_rad_s = draw.between(-1.0, 1.0) * of.top_rad_s;
  s.initial.angle_rad = draw.chance(0.3) ? (draw.one_of(13) - 6) * of.sector_rad : draw.between(-7.0, 7.0);
}

void draw_record(Draw& draw, Scenario& s) {
  if (draw.chance(0.3)) s.record.grid_s = draw.decades(0.1, 20.0) * s.pwm.period_s;
  s.record.events = draw.chance(0.3);
  if (draw.chance(0.3)) s.record.columns = {"i_a_A", "speed_rad_s", "bus_V"};
}

void draw_spread(Draw& draw, Scenario& s) {
  if (!draw.chance(0.15)) return;
  Spread spread;
  spread.key = draw.chance(0.5) ? "supply.voltage_V" : "motor_override.resistance_ohm";
  spread.distribution = draw.chance(0.5) ? Distribution::normal : Distribution::uniform;
  spread.relative = draw.between(0.01, 0.1);
  s.spread.push_back(spread);
}

}  // namespace

void draw_parts(Draw& draw, Scenario& s) {
  const auto motor = design::motor_model(s.sheet);
  if (!motor) return;  // the check reports the reason
  draw_supply(draw, s, *motor);
  const double U = s.supply.voltage_V, R = 2 * motor->machine.R_ohm, K_t = motor->K_t_Nm_A;
  Scales of{U,
            R,
            2 * motor->machine.L_H,
            K_t,
            U / R,
            U / K_t,
            K_t * U / R,
            std::numbers::pi / 3 / motor->machine.pole_pairs,
            0.0};
  draw_pwm(draw, s, of);
  draw_bridge(draw, s, motor->machine.R_ohm);
  draw_control(draw, s, of);
  const bool product = s.control.drive == FirmwareKind::product;  // the first 64 periods measure the offsets
  s.duration_s = s.pwm.period_s * (product ? draw.between(90.0, 400.0) : draw.between(10.0, 150.0));
  draw_load(draw, s, of);
  draw_start(draw, s, of);
  draw_sensors(draw, s, of);
  if (s.control.mode != Mode::off) s.reference = drawn_reference(draw, s, of, s.duration_s);
  if (product) draw_protection(draw, s, of);
  draw_events(draw, s, of);
  draw_measures(draw, s);
  draw_record(draw, s);
  draw_spread(draw, s);
  if (draw.chance(0.2)) s.pwm.minimum_pulse_s = draw.decades(1e-3, 0.3) * s.pwm.period_s;
  draw_general(draw, s, of);
  draw_field(draw, s, of);
  draw_six_step(draw, s);
  draw_profile(draw, s);
}

}  // namespace sixstep::testing

// SPDX-License-Identifier: Apache-2.0
// A random drive: machine, devices, supply, load, board, controller and start. Parameters are drawn as ratios
// to the scales of the machine (stall current, no-load speed, PWM period). They therefore span decades, and
// most drives still run.
#pragma once
#include <algorithm>
#include <sstream>
#include <string>

#include "tests/fuzz/draw.hpp"
#include "tests/support/board.hpp"

namespace sixstep::testing {

struct DrawnDrive : Board {
  double length_s = 0.0;

  explicit DrawnDrive(std::uint64_t seed) {
    Draw draw(seed);
    draw_machine(draw);
    draw_load(draw);
    draw_devices(draw);
    draw_board(draw);
    draw_controller(draw);
    draw_start(draw);
    draw_timeline(draw);
  }
  double stall_A() const { return supply.V_0_V / R_tt(); }
  double top_speed() const { return supply.V_0_V / (2 * machine.K_e_V_s); }
  double stall_Nm() const { return 2 * machine.K_e_V_s * stall_A(); }
  double period_s() const { return static_cast<double>(board.modulator.period_ticks) * 1e-12; }

 private:
  void draw_machine(Draw& draw) {
    supply.V_0_V = drive.nominal_bus_V = draw.decades(3.0, 600.0);
    machine.R_ohm = draw.decades(5e-3, 20.0);
    machine.L_H = machine.R_ohm * draw.decades(3e-5, 2e-2);
    const double top = draw.decades(20.0, 5000.0);
    machine.K_e_V_s = supply.V_0_V / (2 * top);
    machine.pole_pairs = 1 + draw.one_of(std::min(21, static_cast<int>(2e4 / top)));
    if (draw.chance(0.3)) machine.back_emf = plant::BackEmf::sine;
    if (draw.chance(0.5)) machine.flat_deg = draw.between(5.0, 178.0);
    if (draw.chance(0.1)) machine.flat_deg = 60.0;  // a kink at every sector edge, and none within a sector
    const double K_t = 2 * machine.K_e_V_s;
    shaft.J_kg_m2 = draw.decades(1e-3, 10.0) * K_t * K_t / R_tt();  // mechanical time constant
    shaft.B_Nm_s = draw.chance(0.3) ? 0.0 : draw.decades(1e-6, 0.3) * stall_Nm() / top;
  }

  void draw_load(Draw& draw) {
    if (draw.chance(0.4)) shaft.coulomb_Nm = draw.decades(1e-4, 0.5) * stall_Nm();
    if (draw.chance(0.3)) shaft.static_Nm = draw.decades(1e-4, 0.8) * stall_Nm();
    if (draw.chance(0.1)) shaft.locked = true;
  }

  void draw_devices(Draw& draw) {
    if (draw.chance(0.6))
      devices = {draw.chance(0.7) ? draw.decades(1e-3, 0.3) * machine.R_ohm : 0.0,
                 draw.chance(0.7) ? draw.between(0.2, 1.2) : 0.0,
                 draw.chance(0.7) ? draw.decades(1e-3, 0.3) * machine.R_ohm : 0.0};
    start.bus_V = supply.V_0_V;
    if (!draw.chance(0.4)) return;
    // The capacitance C is at least L/R^2, so that the stall current of the winding cannot discharge the
    // capacitor below 0 V.
    const double least = machine.L_H / (machine.R_ohm * machine.R_ohm);
    supply.R_b_ohm = draw.decades(1e-2, 0.5) * machine.R_ohm;
    supply.C_F = draw.decades(1.0, 300.0) * least;
    supply.sinks = draw.chance(0.5);
    if (draw.chance(0.6)) start.bus_V = draw.between(0.8, 1.3) * supply.V_0_V;
  }

  void draw_board(Draw& draw) {
    rig::ModulatorConfig& m = board.modulator;
    m.period_ticks = static_cast<std::int64_t>(draw.decades(5e6, 2e8));
    if (draw.chance(0.3)) m.period_ticks = 30'000'000;
    length_s = period_s() * draw.between(10.0, 120.0);
    drive.chopping = static_cast<control::Chopping>(draw.one_of(3));
    m.centre_aligned = draw.chance(0.3);
    if (draw.chance(0.4)) m.dead_ticks = draw.decades(1e-3, 0.4) * static_cast<double>(m.period_ticks);
    if (draw.chance(0.3)) m.dead_ticks = std::floor(m.dead_ticks);
    m.dead_time_at_commutation = draw.chance(0.4);
    if (draw.chance(0.3)) m.timer_ticks = 1e12 / draw.decades(1e6, 2e8);
    board.commutate_at_sample = draw.chance(0.3);
    board.delayed = draw.chance(0.3);
  }

  void draw_controller(Draw& draw) {
    using control::CurrentControl, control::Mode, control::Watch;
    static constexpr Mode modes[] = {Mode::off,     Mode::duty,  Mode::duty,  Mode::duty,     Mode::current,
                                     Mode::current, Mode::speed, Mode::speed, Mode::position, Mode::position};
    drive.mode = modes[draw.one_of(10)];
    const double L_per_period = L_tt() / period_s();
    const double d1 = draw.decades(0.02, 2.0) * L_per_period;
    drive.current = {d1, d1 * draw.between(-1.1, -0.5), supply.V_0_V};
    if (draw.chance(0.5)) {
      drive.current_control = CurrentControl::hysteresis;
      // The first factor is the number of periods in which the current changes by the band at full voltage.
      drive.hysteresis.band_A = draw.decades(0.1, 10.0) * period_s() / L_tt() * supply.V_0_V;
      drive.hysteresis.watch = static_cast<Watch>(draw.one_of(3));
      if (drive.hysteresis.watch != Watch::none) board.delayed = false;
    }
    const double s1 = draw.decades(0.1, 30.0) / top_speed();
    drive.speed = {s1, s1 * draw.between(-1.05, -0.5), 1.0};
    drive.current_at_full_torque_A = stall_A();
    drive.current_limit_A = draw.between(0.1, 1.0) * stall_A();
    drive.speed_limit_rad_s = draw.between(0.1, 1.0) * top_speed();
    drive.position_gain = draw.decades(1e-3, 1.0) * top_speed();
  }

  void draw_start(Draw& draw) {
    if (!shaft.locked && draw.chance(0.6)) start.speed_rad_s = draw.between(-1.2, 1.2) * top_speed();
    const double electrical = draw.chance(0.4) ? 60.0 * (draw.one_of(14) - 7)  // on an edge
                              : draw.chance(0.1)
                                  ? machine.flat_deg / 2 + 60.0 * (draw.one_of(6) - 3)  // on a kink
                                  : draw.between(-400.0, 400.0);
    start.angle_rad = electrical * base::pi / 180.0 / machine.pole_pairs;
  }

  double setpoint_value(Draw& draw) {
    switch (drive.mode) {
      case control::Mode::current:
        return draw.chance(0.1) ? 0.0 : draw.sign() * draw.decades(0.01, 1.2) * stall_A();
      case control::Mode::speed:
        return draw.chance(0.1) ? 0.0 : draw.between(-1.2, 1.2) * top_speed();
      case control::Mode::position:
        return draw.between(-90.0, 90.0);
      default:
        return draw.chance(0.2) ? draw.one_of(3) - 1.0 : draw.between(-1.0, 1.0);
    }
  }
  std::int64_t instant(Draw& draw) {
    const std::int64_t period = board.modulator.period_ticks;
    const auto any = static_cast<std::int64_t>(draw.unit() * length_s * 1e12);
    const std::int64_t tick = any / period * period;
    switch (draw.one_of(4)) {
      case 0:
        return tick;
      case 1:
        return tick + period / 2;
      case 2:
        return tick + draw.one_of(3);
      default:
        return any;
    }
  }
  void draw_timeline(Draw& draw) {
    setpoint(0, setpoint_value(draw));
    if (draw.chance(0.4)) load(0, draw.between(-0.5, 0.5) * stall_Nm());
    for (int n = draw.one_of(6); n > 0; --n) {
      const std::int64_t at = instant(draw);
      if (draw.chance(0.6))
        setpoint(at, setpoint_value(draw));
      else
        load(at, draw.between(-0.5, 0.5) * stall_Nm());
    }
    std::stable_sort(timeline.begin(), timeline.end(),
                     [](const rig::Action& x, const rig::Action& y) { return x.at < y.at; });
  }
};

/// The text for a failure: the command that repeats the case, and the drawn values.
inline std::string reproduce(std::uint64_t seed, const DrawnDrive& d) {
  const rig::ModulatorConfig& m = d.board.modulator;
  std::ostringstream s;
  s << "SIXSTEP_FUZZ_SEED=" << seed << ": mode " << int(d.drive.mode) << ", current control "
    << int(d.drive.current_control) << ", watch " << int(d.drive.hysteresis.watch) << ", chopping "
    << int(d.drive.chopping) << ", shape " << int(d.machine.back_emf) << " flat " << d.machine.flat_deg
    << ", V_0 " << d.supply.V_0_V << ", C " << d.supply.C_F << " sinks " << d.supply.sinks << ", V_f "
    << d.devices.V_f_V << " R_on " << d.devices.R_on_ohm << " r_d " << d.devices.r_d_ohm << ", stall "
    << d.stall_A() << " A " << d.stall_Nm() << " Nm, top " << d.top_speed() << " rad/s, coulomb "
    << d.shaft.coulomb_Nm << " static " << d.shaft.static_Nm << " locked " << d.shaft.locked << ", speed "
    << d.start.speed_rad_s << " angle " << d.start.angle_rad * d.machine.pole_pairs * 180 / base::pi
    << " deg, period " << m.period_ticks << " centre " << m.centre_aligned << " dead " << m.dead_ticks << "/"
    << m.dead_time_at_commutation << " timer " << m.timer_ticks << " sample " << d.board.commutate_at_sample
    << " delayed " << d.board.delayed << ", length " << d.length_s;
  return s.str();
}

}  // namespace sixstep::testing

// SPDX-License-Identifier: Apache-2.0
// Motors of the motor library on a board that identifies their parameters.
#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/rig/commissioning_drive.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/sim/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace sixstep::testing {

namespace general = plant::general;

struct CommissionedMotor {
  const char* name;
  double bus_V, period_s;
  double test_A;   ///< a large part of the motor's permissible current
  double range_A;  ///< range of the board's current converter, 12 bits
};

/// Three different kinds of motors: a flat motor with a trapezoidal back-EMF, a drone motor with an outer
/// rotor, and a wheel hub motor.
inline constexpr CommissionedMotor commissioned_motors[] = {{"maxon-251601", 24.0, 30e-6, 5.0, 10.24},
                                                            {"dji-2212-920kv", 12.0, 20e-6, 15.0, 30.0},
                                                            {"hoverboard-hub", 36.0, 50e-6, 12.0, 25.0}};

/// One motor on the bench. Its members may be changed before rig() is called.
struct CommissioningBench {
  using Rig = rig::Rig<double, rig::CommissioningDrive<double>, general::Plant<double>>;

  design::MotorModel model;
  general::Machine machine;
  general::Shaft shaft;
  general::Devices devices;
  general::Start at;
  rig::ProbeGiven probes;
  rig::Wiring wires;
  rig::BoardConfig board;
  rig::Timeline timeline;
  control::CommissioningBoard facts;
  control::CommissioningWish wish;

  explicit CommissioningBench(const CommissionedMotor& from) {
    const auto sheet = text::read_sheet(from.name);
    EXPECT_TRUE(sheet) << from.name;
    model = *design::motor_model(*sheet);
    const plant::Machine& m = model.machine;
    machine = {.R_ohm = {m.R_ohm, m.R_ohm, m.R_ohm},
               .K_e_V_s = {m.K_e_V_s, m.K_e_V_s, m.K_e_V_s},
               .L_H = m.L_H,
               .pole_pairs = m.pole_pairs};
    machine.shape.flat_deg = m.flat_deg;
    if (m.back_emf == plant::BackEmf::sine) machine.shape.harmonics = {{1, 1.0}};
    shaft = {.J_kg_m2 = model.shaft.J_kg_m2,
             .B_Nm_s = model.shaft.B_Nm_s,
             .coulomb_Nm = model.shaft.coulomb_Nm,
             .static_Nm = model.shaft.static_Nm};
    at.bus_V = from.bus_V;
    board.modulator.period_ticks = sim::to_instant(from.period_s).ticks;
    board.modulator.centre_aligned = true;
    board.sampled_in_middle = true;
    board.sensors.current = {.bits = 12, .range = from.range_A};
    board.sensors.bus = {.bits = 12, .range = 1.25 * from.bus_V, .both_signs = false};
    board.sensors.capture_Hz = 1e6;
    facts = {.V_per_count = board.sensors.bus.lsb(),
             .A_per_count = board.sensors.current.lsb(),
             .period_s = from.period_s,
             .timer_Hz = 1e6,
             .late_half_ticks = 1};
    wish.test_A = from.test_A;
  }

  /// Flux linkage of the fundamental, in V s. For a trapezoid with ramps of width 2 g, the fundamental has
  /// the factor c_1 = 4 sin g/(pi g) (model.md 1).
  double flux_linkage() const {
    const double g = (180.0 - machine.shape.flat_deg) / 2 * base::pi / 180;
    const double c_1 = machine.shape.harmonics.empty() ? 4 * std::sin(g) / (base::pi * g) : 1.0;
    return c_1 * machine.K_e_V_s[0] / machine.pole_pairs;
  }
  Rig rig() const {
    return Rig(general::Plant<double>(machine, shaft, devices, {.V_0_V = at.bus_V}, at),
               control::commissioning_config(facts, wish), board, timeline, {}, wires, probes);
  }
};

/// Runs until the state `until`, or until the commissioning is done or failed, and returns the result.
template <class Rig>
const control::CommissioningState& commission(
    Rig& rig, double most_s = 60.0, control::CommissioningPhase until = control::CommissioningPhase::done) {
  sim::NoObserver none;
  for (double t = 0.05; t < most_s; t += 0.05) {
    EXPECT_EQ(sim::run(rig, sim::to_instant(t), none).stop, sim::Stop::end);
    if (rig.firmware().found().phase >= until) break;
  }
  return rig.firmware().found();
}

}  // namespace sixstep::testing

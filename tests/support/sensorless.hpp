// SPDX-License-Identifier: Apache-2.0
// Motors of the motor library on a board without rotor sensors. design/loops/ computes the designs; no value
// is tuned by hand.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/loops/sensorless_start.hpp"
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/rig/sensorless_drive.hpp"
#include "sixstep/sim/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace sixstep::testing {

template <class Scalar>
using SensorlessRig = rig::Rig<double, rig::SensorlessDrive<Scalar>>;

struct SensorlessMotor {
  const char* name;
  double bus_V;
  double period_s;
};

/// Three different kinds of motors: a flat motor with a trapezoidal back-EMF, a drone motor with an outer
/// rotor, and a wheel hub motor.
inline constexpr SensorlessMotor three_motors[] = {
    {"maxon-251601", 24.0, 30e-6}, {"dji-2212-920kv", 12.0, 20e-6}, {"hoverboard-hub", 36.0, 50e-6}};

/// One drive on the bench. Its members may be changed before rig() is called.
struct SensorlessBench {
  design::MotorModel motor;
  design::SensorlessSpec spec;
  design::SensorlessStart start;
  control::DriveConfig<double> drive;
  control::SensorlessDriveConfig<double> chip;
  rig::BoardConfig board;
  rig::Timeline timeline;
  plant::Devices devices;
  plant::Start at;
  double load_part = 0.0;  ///< friction of the load, as a part of the nominal torque

  explicit SensorlessBench(const SensorlessMotor& from, control::Mode mode = control::Mode::speed,
                           control::Chopping chopping = control::Chopping::soft);

  double nominal_A() const { return design::nominal_current(motor, spec.bus_V).A; }
  double no_load_rad_s() const { return spec.bus_V / motor.K_t_Nm_A; }
  plant::Shaft shaft() const {
    plant::Shaft s = motor.shaft;
    s.coulomb_Nm += load_part * nominal_A() * motor.K_t_Nm_A;
    return s;
  }
  void setpoint(double t_s, double value) {
    timeline.push_back({sim::to_instant(t_s), rig::ActionKind::setpoint, value});
  }
  void act(double t_s, rig::ActionKind kind, double value) {
    timeline.push_back({sim::to_instant(t_s), kind, value});
  }
  plant::Plant<double> plant() const { return {motor.machine, shaft(), devices, {.V_0_V = spec.bus_V}, at}; }
  template <class Firmware = rig::SensorlessDrive<double>>
  auto rig() const {
    return rig::Rig<double, Firmware>(plant(), {.drive = chip}, board, timeline);
  }
};

inline SensorlessBench::SensorlessBench(const SensorlessMotor& from, control::Mode mode,
                                        control::Chopping chopping) {
  const auto sheet = text::read_sheet(from.name);
  EXPECT_TRUE(sheet) << from.name;
  motor = *design::motor_model(*sheet);
  design::DesignSpec loops = design::on_a_board();
  loops.mode = control::Mode::speed;
  loops.period_s = from.period_s;
  loops.voltage_V = from.bus_V;
  loops.lowest_speed_rad_s = 0.05 * from.bus_V / motor.K_t_Nm_A;
  const auto designed = design::design_drive(motor, loops);
  EXPECT_TRUE(designed) << (designed ? "" : base::to_string(designed.problems().front()));
  const design::PiGains current = designed->loop("current").gains, speed = designed->loop("speed").gains;
  drive.mode = mode;
  drive.chopping = chopping;
  drive.nominal_bus_V = from.bus_V;
  drive.current = {current.d1, current.d0, from.bus_V};
  drive.speed = {speed.d1, speed.d0, 1.0};
  drive.current_at_full_torque_A = designed->current_at_full_torque_A;
  drive.current_limit_A = designed->current_at_full_torque_A;
  const double full_rad_s2 = designed->current_at_full_torque_A * motor.K_t_Nm_A / motor.shaft.J_kg_m2;
  spec = {.bus_V = from.bus_V, .period_s = from.period_s};
  spec.chopping = chopping;
  spec.speed_window_s = design::hall_window_s(design::speed_crossover_rad_s(speed.d1, full_rad_s2));
  const auto designed_start = design::sensorless_start(motor, spec, designed->current_at_full_torque_A);
  EXPECT_TRUE(designed_start) << (designed_start ? "" : base::to_string(designed_start.problems().front()));
  start = *designed_start;
  chip = design::sensorless_drive(drive, start);
  board.modulator.period_ticks = sim::to_instant(from.period_s).ticks;
  board.modulator.centre_aligned = true;
  board.sampled_in_middle = true;
  board.sensors.bus = {.bits = spec.adc_bits, .range = 1.25 * from.bus_V, .both_signs = false};
  board.sensors.capture_Hz = spec.capture_Hz;
  at.bus_V = from.bus_V;
}

template <class Rig>
void run_until(Rig& rig, double t_s) {
  sim::NoObserver none;
  ASSERT_EQ(sim::run(rig, sim::to_instant(t_s), none).stop, sim::Stop::end);
}

inline const char* word(control::SensorlessPhase phase) {
  constexpr const char* words[] = {"off",     "catching",  "aligning", "ramping",
                                   "running", "following", "gave up"};
  return words[static_cast<std::size_t>(phase)];
}

/// Number of sectors from the sector of the rotor to the sector of the commutation, -2 to 3.
template <class Rig>
int ahead(const Rig& rig) {
  return control::sectors_between(static_cast<std::uint8_t>(rig.plant().sector()),
                                  rig.firmware().rotor().sector);
}

template <class Rig>
control::SensorlessPhase phase(const Rig& rig) {
  return rig.firmware().rotor().phase;
}

/// Runs until what() returns true, at most to `most_s`. It calls what() every `every_s`. Returns the time in
/// s, or -1.
template <class Rig, class What>
double run_until_true(Rig& rig, double most_s, double every_s, What&& what) {
  sim::NoObserver none;
  for (double t = rig.now().seconds() + every_s; t < most_s; t += every_s) {
    if (sim::run(rig, sim::to_instant(t), none).stop != sim::Stop::end) return -1;
    if (what()) return t;
  }
  return -1;
}

/// Continues the run and counts failed checks. A check fails if the drive's sector is wrong by more than one
/// sector, or if the drive has lost the rotor.
template <class Rig>
int wrong_looks(Rig& rig, double to_s, double every_s) {
  int wrong = 0;
  sim::NoObserver none;
  for (double t = rig.now().seconds() + every_s; t < to_s; t += every_s) {
    EXPECT_EQ(sim::run(rig, sim::to_instant(t), none).stop, sim::Stop::end);
    wrong += phase(rig) != control::SensorlessPhase::running || std::abs(ahead(rig)) > 1;
  }
  return wrong;
}

}  // namespace sixstep::testing

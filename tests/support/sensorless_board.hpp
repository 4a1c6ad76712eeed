// SPDX-License-Identifier: Apache-2.0
// The bench of sensorless.hpp with a board as one is built: channels of a tenth of the phase, diodes, dead time, amplifiers and
// dividers on 12 bits that are as noisy as one count, a measured bus, and terminals whose dividers are unlike.
#pragma once
#include "tests/support/observers.hpp"

namespace sixstep::testing {

/// Dividers of resistors of 0.1 %: two of them differ by 0.4 % at most. That of leg a reads so much more than that of leg b.
inline constexpr double unlike_dividers = 0.004;

template <class Scalar>
struct BuiltDrive : rig::SensorlessDrive<Scalar> {
  using rig::SensorlessDrive<Scalar>::SensorlessDrive;
  template <class Real>
  void look_at_terminals(const plant::PerLeg<Real>& u) {
    rig::SensorlessDrive<Scalar>::look_at_terminals(
        plant::PerLeg<Real>{(1 + unlike_dividers / 2) * u[0], (1 - unlike_dividers / 2) * u[1], u[2]});
  }
};

using BuiltRig = rig::Rig<double, BuiltDrive<double>>;

struct BuiltBoard {
  double dead_s = 0.5e-6;
  double noise_counts = 1.0;  ///< of each converter, root mean square
  bool delayed = true;        ///< an answer takes effect a period later
};

/// The board is built like that, and the drive designed for what is known of it: noise and dividers.
inline void build(SensorlessBench& bench, const BuiltBoard& board = {}) {
  const double R = bench.motor.machine.R_ohm, limit_A = bench.drive.current_limit_A;
  bench.devices = {.R_on_ohm = 0.1 * R, .V_f_V = 0.7, .r_d_ohm = 0.05 * R};
  bench.board.modulator.dead_ticks = board.dead_s * sim::ticks_per_second;
  bench.board.delayed = board.delayed;
  rig::SensorsConfig& sensors = bench.board.sensors;
  sensors.currents = rig::CurrentMeasurement::phases;
  sensors.current = {.bits = 12, .range = 2.0 * limit_A};
  sensors.current.noise = board.noise_counts * sensors.current.lsb();
  sensors.current.offset = 5.0 * sensors.current.lsb();
  sensors.measures_bus = true;
  sensors.bus.noise = board.noise_counts * sensors.bus.lsb();
  bench.spec.adc_noise_V = sensors.bus.noise;
  bench.spec.mismatch = unlike_dividers;
  bench.spec.diode_V = bench.devices.V_f_V;
  const auto start =
      design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A);
  ASSERT_TRUE(start) << base::to_string(start.problems().front());
  bench.start = *start;
  bench.chip = design::sensorless_drive(bench.drive, bench.start);
}

/// Losses of the lock while it runs on, and the last one's name.
struct Ride {
  int losses = 0;
  int wrong = 0;  ///< looks at which the drive was wrong by more than a sector's edge, or had lost the rotor
  control::LockLoss last = control::LockLoss::none;
};

template <class Rig>
Ride ride(Rig& rig, double to_s, double every_s) {
  const int before = rig.firmware().diagnosis().losses;
  const int wrong = wrong_looks(rig, to_s, every_s);
  return {rig.firmware().diagnosis().losses - before, wrong, rig.firmware().rotor().lock.last};
}

inline double aligned_by_s(const SensorlessBench& bench) {
  return 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
}

}  // namespace sixstep::testing

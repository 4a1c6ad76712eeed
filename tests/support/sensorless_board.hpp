// SPDX-License-Identifier: Apache-2.0
// The bench of sensorless.hpp with a realistic board. The resistance of a switch is a tenth of the phase
// resistance. The board has diodes, dead time, converters with one count of noise, unequal terminal dividers
// and a measured bus. Commands act one period later.
#pragma once
#include <random>

#include "tests/support/observers.hpp"

namespace sixstep::testing {

/// Largest relative difference of two dividers with resistors of 0.1 %. The divider of leg a reads higher
/// than the divider of leg b by this part.
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

/// Changes the bench to this board, and designs the drive for the board's noise, dividers and diodes.
inline void build(SensorlessBench& bench) {
  const double R = bench.motor.machine.R_ohm;
  bench.devices = {.R_on_ohm = 0.1 * R, .V_f_V = 0.7, .r_d_ohm = 0.05 * R};
  bench.board.modulator.dead_ticks = 0.5e-6 * sim::ticks_per_second;
  bench.board.delayed = true;
  rig::SensorsConfig& sensors = bench.board.sensors;
  sensors.currents = rig::CurrentMeasurement::phases;
  sensors.current = {.bits = 12, .range = 2.0 * bench.drive.current_limit_A};
  sensors.current.noise = sensors.current.lsb();
  sensors.current.offset = 5.0 * sensors.current.lsb();
  sensors.measures_bus = true;
  sensors.bus.noise = sensors.bus.lsb();
  bench.spec.adc_noise_V = sensors.bus.noise;
  bench.spec.mismatch = unlike_dividers;
  bench.spec.diode_V = bench.devices.V_f_V;
  const auto start = design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A);
  ASSERT_TRUE(start) << base::to_string(start.problems().front());
  bench.start = *start;
  bench.chip = design::sensorless_drive(bench.drive, bench.start);
}

inline SensorlessBench on_built_board(const SensorlessMotor& motor, control::Mode mode = control::Mode::speed,
                                      control::Chopping chopping = control::Chopping::soft) {
  SensorlessBench bench(motor, mode, chopping);
  build(bench);
  return bench;
}

/// The time, in s, at which both steps of the alignment have ended.
inline double aligned_s(const SensorlessBench& bench) {
  return 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
}

/// The duty at which the motor turns at a tenth of its no-load speed with its load. It includes the voltage
/// drops of copper, switches and diodes. With hard chopping, the mean voltage is 2 d - 1 of the bus voltage
/// at the duty d.
inline double tenth_of_no_load(const SensorlessBench& bench) {
  const double R_tt = 2 * (bench.motor.machine.R_ohm + bench.devices.R_on_ohm);
  const double drop_V = bench.load_part * bench.nominal_A() * R_tt + bench.devices.V_f_V;
  const double d = 0.1 + drop_V / bench.spec.bus_V;
  return bench.drive.chopping == control::Chopping::hard ? (1 + d) / 2 : d;
}

inline const char* word(control::Chopping chopping) {
  constexpr const char* words[] = {"soft", "hard", "complementary"};
  return words[static_cast<std::size_t>(chopping)];
}

/// The result of a start from rest to a speed, and of the next 0.1 s.
struct Started {
  bool holds = false;
  bool at_once = false;  ///< without a second start
  double after_s = 0.0;
};

template <class Rig>
Started started(Rig rig, const SensorlessBench& bench, double w) {
  const double t = run_until_true(rig, 2.0 + 4 * aligned_s(bench), 5e-3, [&] {
    return phase(rig) == control::SensorlessPhase::running &&
           std::fabs(rig.plant().state().w - w) < 0.05 * std::fabs(w);
  });
  if (t < 0) return {};
  const bool at_once = rig.firmware().rotor().lock.last == control::LockLoss::none;
  return {wrong_looks(rig, t + 0.1, 1e-3) == 0, at_once, t};
}

inline int starts_each(int usual) {
  const char* asked = std::getenv("SIXSTEP_SENSORLESS_STARTS");
  return asked != nullptr ? std::atoi(asked) : usual;
}

/// Starts each motor to 0.3 of its no-load speed from random angles, with loads up to half of its nominal
/// load. 99 of 100 starts must keep the speed. bench_of(motor, n) returns the bench of the start n, and
/// sign_of(n) its direction.
template <class BenchOf, class SignOf>
void expect_starts_from_any_angle(unsigned seed, BenchOf&& bench_of, SignOf&& sign_of) {
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> angle(0.0, 2 * base::pi);
  const int count = starts_each(2);
  int drawn = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.1, 0.3, 0.5}) {
      int held = 0, at_once = 0;
      double longest_s = 0;
      for (int n = 0; n < count; ++n, ++drawn) {
        SensorlessBench bench = bench_of(motor, drawn);
        bench.load_part = load;
        bench.at.angle_rad = angle(draw) / bench.motor.machine.pole_pairs;
        bench.board.sensors.seed = static_cast<std::uint64_t>(n);
        const double w = 0.3 * sign_of(drawn) * bench.no_load_rad_s();
        bench.setpoint(0, w);
        const Started s = started(bench.rig<BuiltDrive<double>>(), bench, w);
        held += s.holds;
        at_once += s.at_once;
        longest_s = std::fmax(longest_s, s.after_s);
      }
      std::printf("%-15s load %2.0f %%: %d of %d hold, %d at the first try, up to speed within %.2f s\n",
                  motor.name, 100 * load, held, count, at_once, longest_s);
      EXPECT_GE(held, static_cast<int>(std::ceil(0.99 * count))) << motor.name << " " << load;
    }
}

/// Expects that the speed is `part` of the no-load speed 0.8 s after the alignment, and that the drive has
/// not lost the rotor.
inline void expect_speed_held(SensorlessBench& bench, double part, const std::string& of) {
  const double w = part * bench.no_load_rad_s();
  bench.setpoint(0, w);
  auto rig = bench.rig<BuiltDrive<double>>();
  const std::string where = of + " " + word(bench.drive.chopping) + " " + std::to_string(part) + " load " +
                            std::to_string(bench.load_part);
  run_until(rig, aligned_s(bench) + 0.8);
  EXPECT_EQ(wrong_looks(rig, aligned_s(bench) + 1.1, 1e-3), 0) << where;
  EXPECT_NEAR(rig.plant().state().w, w, 0.1 * std::fabs(w)) << where;
  EXPECT_EQ(rig.firmware().rotor().lock.last, control::LockLoss::none) << where;
}

}  // namespace sixstep::testing

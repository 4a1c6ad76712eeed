// SPDX-License-Identifier: Apache-2.0
// Hall probes with the sensorless drive, and rotors that already spin, on a realistic board. The cases are
// the hand-over to back-EMF and back, a line that fails during the run, and a line that is dead from the
// start. They run in both directions, at constant and at changing speed. The drive also catches spinning
// rotors under load.
#include "tests/support/sensorless_board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::LockLoss;
using control::RotorSource;
using control::SensorlessPhase;

SensorlessBench with_probes(const SensorlessMotor& motor) {
  SensorlessBench bench = on_built_board(motor);
  bench.chip.source = {.has_hall = true, .wanted = RotorSource::hall};
  bench.load_part = 0.1;
  return bench;
}

std::string at(const SensorlessMotor& motor, int sign, bool changes) {
  return std::string(motor.name) + (sign > 0 ? " forward" : " backward") +
         (changes ? ", speeding up" : ", steady");
}

/// Changes the rotor source of the chip at the time t_s.
void choose(SensorlessBench& bench, BuiltRig::Tunings& tunings, double t_s, RotorSource source) {
  tunings.push_back({{.drive = bench.chip}, 1.0});
  tunings.back().config.drive.source.wanted = source;
  bench.act(t_s, rig::ActionKind::retune, static_cast<double>(tunings.size() - 1));
}

/// Runs until `source` determines the commutation, for at most `most_s` seconds. Expects that this happens,
/// and that the drive's sector is then at most one sector off.
void expect_source(BuiltRig& rig, RotorSource source, double most_s, const std::string& where) {
  const double t = run_until_true(rig, rig.now().seconds() + most_s, 1e-4,
                                  [&] { return rig.firmware().source().source == source; });
  EXPECT_GT(t, 0) << where;
  EXPECT_LE(std::abs(ahead(rig)), 1) << where;
}

TEST(SensorlessSource, HandsOverAndBackBothWays) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const bool changes : {false, true}) {
      const int sign = n++ / 2 % 2 == 0 ? -1 : 1;
      SensorlessBench bench = with_probes(motor);
      const double w = sign * 0.3 * bench.no_load_rad_s(), there_s = 0.7, back_s = 0.9;
      bench.setpoint(0, w);
      BuiltRig::Tunings tunings;
      if (changes) bench.setpoint(there_s - 0.01, 2 * w);
      choose(bench, tunings, there_s, RotorSource::back_emf);
      if (changes) bench.setpoint(back_s - 0.001, 2.6 * w);
      choose(bench, tunings, back_s, RotorSource::hall);
      BuiltRig rig(bench.plant(), {.drive = bench.chip}, bench.board, bench.timeline, tunings);
      const std::string where = at(motor, sign, changes);
      run_until(rig, there_s - 0.001);
      EXPECT_EQ(phase(rig), SensorlessPhase::following) << where;
      const double before = std::fabs(rig.plant().state().w);
      expect_source(rig, RotorSource::back_emf, 0.05, where);
      EXPECT_EQ(wrong_looks(rig, back_s, 1e-4), 0) << where;
      EXPECT_GT(std::fabs(rig.plant().state().w), (changes ? 1.3 : 0.97) * before) << where;
      expect_source(rig, RotorSource::hall, 0.05, where);
      run_until(rig, back_s + 0.2);
      EXPECT_EQ(phase(rig), SensorlessPhase::following) << where;
      EXPECT_GT(rig.plant().state().w / w, changes ? 2.3 : 0.97) << where;
      EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
    }
}

/// Expects that the drive runs by back-EMF at the speed w.
void expect_taken_over(const BuiltRig& rig, double w, const std::string& where) {
  EXPECT_EQ(rig.firmware().source().source, RotorSource::back_emf) << where;
  EXPECT_EQ(phase(rig), SensorlessPhase::running) << where;
  EXPECT_LE(std::abs(ahead(rig)), 1) << where;
  EXPECT_NEAR(rig.plant().state().w, w, 0.1 * std::fabs(w)) << where;
}

/// If a dead line hid an edge, the hand-over is a sector late. The drive may then lose the rotor once, and
/// must catch it again.
TEST(SensorlessSource, GoesOnWithoutALineThatDiesBothWays) {
  int n = 0, caught_again = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double line : {1.0, -2.0, 3.0}) {
      const int sign = n % 2 == 0 ? -1 : 1;
      const bool changes = n++ / 2 % 2 == 0;
      SensorlessBench bench = with_probes(motor);
      const double w = sign * 0.3 * bench.no_load_rad_s(), dies_s = 0.7;
      bench.setpoint(0, w);
      if (changes) bench.setpoint(dies_s - 0.01, 2 * w);
      bench.act(dies_s, rig::ActionKind::hall_stuck, line);
      auto rig = bench.rig<BuiltDrive<double>>();
      run_until(rig, dies_s + 0.3);
      expect_taken_over(rig, changes ? 2 * w : w, at(motor, sign, changes) + " line " + std::to_string(line));
      EXPECT_LE(rig.firmware().diagnosis().losses, 1) << at(motor, sign, changes) << " line " << line;
      caught_again += rig.firmware().diagnosis().losses;
    }
  std::printf("a Hall line dies: %d of %d go on, %d of them caught again\n", n, n, caught_again);
}

/// With a dead line, the code at power-up may still be valid. The fault then appears in the first sectors.
TEST(SensorlessSource, StartsWithALineThatWasDeadBefore) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double line : {1.0, 2.0, 3.0, -1.0, -2.0, -3.0}) {
      const int sign = n % 2 == 0 ? 1 : -1;
      SensorlessBench bench = with_probes(motor);
      const double w = sign * 0.3 * bench.no_load_rad_s();
      bench.at.angle_rad = (0.2 + 1.05 * n++) / bench.motor.machine.pole_pairs;
      bench.setpoint(0, w);
      bench.act(0, rig::ActionKind::hall_stuck, line);
      auto rig = bench.rig<BuiltDrive<double>>();
      run_until_true(rig, 3.0, 5e-3, [&] {
        return phase(rig) == SensorlessPhase::running && std::fabs(rig.plant().state().w / w - 1) < 0.05;
      });
      run_until(rig, rig.now().seconds() + 0.2);
      expect_taken_over(rig, w, at(motor, sign, false) + " line " + std::to_string(line));
    }
}

/// Soft chopping cannot limit a braking current near the no-load speed. At 0.8 of the no-load speed, the
/// setpoint is therefore the speed of the rotor. At the other speeds, the setpoint is lower, so that the
/// drive brakes.
TEST(SensorlessSource, CatchesASpinningRotorUnderLoad) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.3, 0.5})
      for (const double part : {0.3, 0.5, 0.8}) {
        SensorlessBench bench = on_built_board(motor);
        bench.load_part = load;
        const double w = (n++ % 2 == 0 ? 1 : -1) * part * bench.no_load_rad_s();
        bench.at.speed_rad_s = w;
        bench.at.angle_rad = 1.0;
        bench.setpoint(0, part > 0.6 ? w : 0.6 * w);
        auto rig = bench.rig<BuiltDrive<double>>();
        const double listen_s = bench.start.rotor.spin.listen_ticks / bench.spec.capture_Hz;
        const double t = run_until_true(rig, 4 * listen_s, 0.1e-3, [&] {
          return phase(rig) != SensorlessPhase::catching && phase(rig) != SensorlessPhase::off;
        });
        const std::string where =
            std::string(motor.name) + " " + std::to_string(w) + " load " + std::to_string(load);
        EXPECT_GT(t, 0) << where;
        EXPECT_EQ(phase(rig), SensorlessPhase::running) << where;
        EXPECT_EQ(wrong_looks(rig, t + 0.15, 0.3e-3), 0) << where;
        EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
      }
}

/// A load of half the nominal torque stops a slow rotor before the drive can catch it. The drive must then
/// start the rotor from rest.
TEST(SensorlessSource, StartsARotorThatStoppedWhileItWasCaught) {
  SensorlessBench bench = on_built_board(three_motors[2]);
  bench.load_part = 0.5;
  bench.at.speed_rad_s = 0.2 * bench.no_load_rad_s();
  const double w = 0.3 * bench.no_load_rad_s();
  bench.setpoint(0, w);
  auto rig = bench.rig<BuiltDrive<double>>();
  EXPECT_GT(run_until_true(rig, 3.0, 5e-3,
                           [&] {
                             return phase(rig) == SensorlessPhase::running &&
                                    std::fabs(rig.plant().state().w / w - 1) < 0.05;
                           }),
            0);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Tests the sensorless drive on a realistic board (support/sensorless_board.hpp) with starts, speeds and
// throttle steps of three motors of the motor library. All tests run in both directions, with soft and
// complementary chopping, by crossings and by observers. The drive must not lose the rotor.
#include "tests/support/sensorless_board.hpp"

#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using control::Follow;
using control::LockLoss;
using control::Mode;
using control::SensorlessPhase;

TEST(SensorlessBoard, StartsFromAnyAngleAgainstAnyLoadBothWays) {
  const auto bench_of = [](const SensorlessMotor& motor, int n) {
    return on_built_board(motor, Mode::speed, n / 2 % 2 == 0 ? Chopping::soft : Chopping::complementary);
  };
  expect_starts_from_any_angle(20'240'611, bench_of, [](int n) { return n % 2 == 0 ? 1 : -1; });
}

TEST(SensorlessBoard, HoldsEverySpeedBothWays) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.5})
      for (const double part : {0.05, 0.3, 0.8}) {
        const Chopping chopping = n % 2 == 0 ? Chopping::soft : Chopping::complementary;
        const int sign = n++ / 2 % 2 == 0 ? 1 : -1;
        SensorlessBench bench = on_built_board(motor, Mode::speed, chopping);
        bench.load_part = load;
        EXPECT_LE(bench.start.lowest_rad_s, 0.0501 * bench.no_load_rad_s()) << motor.name;
        expect_speed_held(bench, sign * part, motor.name);
      }
}

/// Runs twice at full throttle and twice at a tenth of the no-load speed. The setpoint steps, and the chip
/// limits the slew rate.
void expect_throttle(SensorlessBench& bench, int sign, const std::string& where) {
  const double low = tenth_of_no_load(bench), from_s = aligned_s(bench) + 0.6;
  bench.setpoint(0, sign * low);
  for (int n = 0; n < 4; ++n) bench.setpoint(from_s + 0.4 * n, sign * (n % 2 == 0 ? 1.0 : low));
  auto rig = bench.rig<BuiltDrive<double>>();
  run_until(rig, from_s - 0.1);
  EXPECT_EQ(wrong_looks(rig, from_s + 0.39, 0.3e-3), 0) << where;
  const double fast = std::fabs(rig.plant().state().w);
  EXPECT_EQ(wrong_looks(rig, from_s + 1.6, 0.3e-3), 0) << where;
  EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
  // At full duty, the speed is the no-load speed minus the drop that the load causes. With a load, the rotor
  // slows down again after the step to the low setpoint.
  const double R_tt = 2 * (bench.motor.machine.R_ohm + bench.devices.R_on_ohm);
  const double full =
      bench.no_load_rad_s() * (1 - bench.load_part * bench.nominal_A() * R_tt / bench.spec.bus_V);
  EXPECT_GT(fast, 0.85 * full) << where;
  if (bench.load_part > 0) {
    EXPECT_LT(std::fabs(rig.plant().state().w), 0.25 * full) << where;
  }
}

TEST(SensorlessBoard, ThrottleStepsKeepLock) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.5})
      for (const Chopping chopping : {Chopping::soft, Chopping::complementary}) {
        SensorlessBench bench = on_built_board(motor, Mode::duty, chopping);
        bench.load_part = load;
        expect_throttle(bench, n++ / 2 % 2 == 0 ? 1 : -1,
                        std::string(motor.name) + " " + word(chopping) + " load " + std::to_string(load));
      }
}

TEST(SensorlessBoard, ObserversThrottleTheHub) {
  int n = 0;
  for (const double load : {0.0, 0.5})
    for (const Follow observer : three_observers) {
      SensorlessBench bench =
          on_built_board(three_motors[2], Mode::duty, n % 2 == 0 ? Chopping::soft : Chopping::complementary);
      follow(bench, observer);
      bench.load_part = load;
      expect_throttle(bench, n++ % 3 == 0 ? -1 : 1, std::string(word(observer)) + " " + std::to_string(load));
    }
}

/// The chip limits the slew rate of the duty (sensorless_start.hpp). The closed form gives the time from a
/// tenth of the duty to full duty.
TEST(SensorlessBoard, TellsHowLongTheThrottleTakes) {
  for (const SensorlessMotor& motor : three_motors) {
    SensorlessBench bench(motor, Mode::duty);
    const double K_t = bench.motor.K_t_Nm_A, J = bench.motor.shaft.J_kg_m2, U = bench.spec.bus_V;
    const double slew = bench.nominal_A() * K_t * K_t / (J * U);
    const double tau_s = 2 * bench.motor.machine.R_ohm * J / (K_t * K_t);
    const double from_s = aligned_s(bench) + 0.6;
    bench.setpoint(0, 0.1);
    bench.setpoint(from_s, 1.0);
    auto rig = bench.rig();
    run_until(rig, from_s);
    const double t = run_until_true(rig, from_s + 1, bench.spec.period_s,
                                    [&] { return rig.modulator().command().duty >= 1.0; });
    std::printf(
        "%-15s time constant %2.0f ms, duty from 10 to 100 %% in %3.0f ms, complementary in %3.0f ms\n",
        motor.name, 1e3 * tau_s, 1e3 * 0.9 / slew, 1e3 * 1.8 / slew);
    EXPECT_NEAR(t - from_s, 0.9 / slew, 2.5 * bench.spec.period_s) << motor.name;
  }
}

/// A noise of one count of the amplifier, multiplied by L/T (inductance L, period T), is several thresholds
/// of a slow rotor's back-EMF. If a phase does not conduct, the observer therefore sets its current to
/// exactly zero.
TEST(SensorlessBoard, ObserversHoldFivePercent) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const Follow observer : three_observers) {
      SensorlessBench bench = on_built_board(motor);
      follow(bench, observer);
      bench.load_part = 0.3;
      const double w = (n++ % 2 == 0 ? 0.05 : -0.05) * bench.no_load_rad_s();
      bench.setpoint(0, w);
      auto rig = bench.rig<BuiltDrive<double>>();
      run_until(rig, aligned_s(bench) + 0.8);
      const std::string where = std::string(motor.name) + " " + word(observer) + " " + std::to_string(w);
      EXPECT_EQ(wrong_looks(rig, aligned_s(bench) + 1.1, 1e-3), 0) << where;
      EXPECT_NEAR(rig.plant().state().w, w, 0.1 * std::fabs(w)) << where;
      EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
    }
}

/// Counts how often the drive loses the rotor in a step of the speed between two fractions of the no-load
/// speed. After each loss, the drive must catch the rotor again.
int losses_of_step(SensorlessBench& bench, double from, double to, const std::string& where) {
  const double no_load = bench.no_load_rad_s(), step_s = aligned_s(bench) + 0.7;
  bench.setpoint(0, from * no_load);
  bench.setpoint(step_s, to * no_load);
  auto rig = bench.rig<BuiltDrive<double>>();
  run_until(rig, step_s);
  EXPECT_EQ(rig.firmware().diagnosis().losses, 0) << where;
  run_until(rig, step_s + 0.6);
  EXPECT_EQ(phase(rig), SensorlessPhase::running) << where;
  EXPECT_NEAR(rig.plant().state().w, to * no_load, 0.05 * to * no_load) << where;
  return rig.firmware().diagnosis().losses;
}

/// docs/reference/sensorless-drive.md excludes this case: at the current limit, the current of the old pair
/// may flow beyond a crossing. After such a loss, the drive must catch the rotor again.
TEST(SensorlessBoard, ASpeedStepMayLoseTheRotorOnce) {
  for (const SensorlessMotor& motor : three_motors) {
    int up = 0, down = 0;
    for (const Follow follower : every_follow) {
      SensorlessBench strayed(motor);
      follow(strayed, follower);
      strayed.motor.machine.R_ohm *= 1.3;
      strayed.motor.machine.L_H *= 1.3;
      strayed.motor.machine.K_e_V_s *= 0.9;
      strayed.load_part = 0.3;
      const int losses = losses_of_step(strayed, 0.08, 0.7, std::string(motor.name) + word(follower));
      EXPECT_LE(losses, 1) << motor.name << " " << word(follower);
      up += losses;
    }
    for (const Chopping chopping : {Chopping::soft, Chopping::complementary}) {
      SensorlessBench bench = on_built_board(motor, Mode::speed, chopping);
      bench.load_part = 0.3;
      const int losses = losses_of_step(bench, 0.7, 0.3, std::string(motor.name) + word(chopping));
      EXPECT_LE(losses, 1) << motor.name << " " << word(chopping);
      down += losses;
    }
    std::printf("%-15s lost once in %d of 4 steps up on a strayed motor, in %d of 2 steps down\n", motor.name,
                up, down);
  }
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Sensorless six-step on the virtual board, with three motors of the motor library and the design of
// design/loops/. The drive starts, runs at several speeds and follows throttle steps. Its sector is compared
// with the rotor's sector.
#include "tests/support/sensorless.hpp"

#include <cstdlib>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::LockLoss;
using control::Mode;
using control::SensorlessPhase;

struct Started {
  bool holds = false;
  bool at_once = false;  ///< without a second start
  double after_s = 0.0;
};

/// Starts the drive from rest. The result states whether the drive reaches the speed w and keeps it for 0.1
/// s.
Started started(const SensorlessBench& bench, double w) {
  auto rig = bench.rig();
  const double most_s = 2.0 + 8.0 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
  const double t = run_until_true(rig, most_s, 5e-3, [&] {
    return phase(rig) == SensorlessPhase::running &&
           std::fabs(rig.plant().state().w - w) < 0.05 * std::fabs(w);
  });
  if (t < 0) return {};
  const bool at_once = rig.firmware().rotor().lock.last == LockLoss::none;
  return {wrong_looks(rig, t + 0.1, 1e-3) == 0, at_once, t};
}

int starts_each() {
  const char* asked = std::getenv("SIXSTEP_SENSORLESS_STARTS");
  return asked != nullptr ? std::atoi(asked) : 2;
}

TEST(Sensorless, StartsFromAnyAngleAgainstAnyLoadBothWays) {
  const unsigned seed = 20'240'611;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> angle(0.0, 2 * base::pi);
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.1, 0.3, 0.5}) {
      int held = 0, at_once = 0;
      double longest_s = 0;
      const int count = starts_each();
      for (int n = 0; n < count; ++n) {
        SensorlessBench bench(motor);
        bench.load_part = load;
        bench.at.angle_rad = angle(draw) / bench.motor.machine.pole_pairs;
        const double w = (n % 2 == 0 ? 0.3 : -0.3) * bench.no_load_rad_s();
        bench.setpoint(0, w);
        const Started s = started(bench, w);
        held += s.holds;
        at_once += s.at_once;
        longest_s = std::fmax(longest_s, s.after_s);
      }
      std::printf(
          "%s, load %.0f %%: %d of %d hold, %d at the first try, up to speed within %.2f s (seed %u)\n",
          motor.name, 100 * load, held, count, at_once, longest_s, seed);
      EXPECT_GE(held, static_cast<int>(std::ceil(0.99 * count))) << motor.name << " " << load;
    }
}

TEST(Sensorless, HoldsFromFivePercentToNoLoadSpeed) {
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.3})
      for (const double part : {0.05, 0.2, 0.5, 0.8}) {
        SensorlessBench bench(motor);
        bench.load_part = load;
        const double w = part * bench.no_load_rad_s();
        bench.setpoint(0, w);
        auto rig = bench.rig();
        const double align_s = 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
        run_until(rig, align_s + 0.8);
        EXPECT_EQ(wrong_looks(rig, align_s + 1.1, 1e-3), 0) << motor.name << " " << part << " load " << load;
        EXPECT_NEAR(rig.plant().state().w, w, 0.1 * w) << motor.name << " load " << load;
        EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none)
            << motor.name << " " << part << " load " << load;
      }
}

TEST(Sensorless, ReachesNoLoadSpeedAtFullDuty) {
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1}) {
      SensorlessBench bench(motor, Mode::duty);
      bench.setpoint(0, sign * 1.0);
      auto rig = bench.rig();
      const double align_s = 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
      run_until(rig, align_s + 1.5);
      EXPECT_EQ(wrong_looks(rig, align_s + 1.6, 0.2e-3), 0) << motor.name;
      EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << motor.name;
      EXPECT_GT(sign * rig.plant().state().w, 0.97 * bench.no_load_rad_s()) << motor.name;
    }
}

TEST(Sensorless, ThrottleStepsKeepLock) {
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1})
      for (const control::Chopping chopping : {control::Chopping::soft, control::Chopping::hard}) {
        // With hard chopping, the mean voltage is 2 d - 1 of the bus voltage at the duty d. Both values of
        // the duty therefore give 10 %.
        const double low = chopping == control::Chopping::hard ? 0.55 : 0.1;
        SensorlessBench bench(motor, Mode::duty, chopping);
        bench.load_part = 0.1;
        const double align_s = 2 * bench.start.rotor.start.align_ticks / bench.spec.capture_Hz;
        bench.setpoint(0, sign * low);
        for (int n = 0; n < 4; ++n) bench.setpoint(align_s + 0.6 + 0.5 * n, sign * (n % 2 == 0 ? 1.0 : low));
        auto rig = bench.rig();
        run_until(rig, align_s + 0.5);
        EXPECT_EQ(wrong_looks(rig, align_s + 2.6, 0.3e-3), 0) << motor.name << " chopping " << int(chopping);
        EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none)
            << motor.name << " chopping " << int(chopping);
      }
}

}  // namespace SIXSTEP_TEST_FILE

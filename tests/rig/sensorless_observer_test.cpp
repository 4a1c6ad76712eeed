// SPDX-License-Identifier: Apache-2.0
// On the virtual board, back-EMF observers replace the detection of crossings, with motors of the motor
// library. The angles of their commutations are compared with the ends of the rotor's sectors. The motors
// include motors whose R, L and K_e differ from the design's values.
#include "tests/support/in_part.hpp"
#include "tests/support/observers.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Follow;
using control::LockLoss;
using control::Mode;
using control::SensorlessPhase;

/// Electrical degrees by which the rotor turns in one control period. A part of it is the allowed error,
/// because a chip measures once per period.
double period_deg(const SensorlessBench& bench, double speed_rad_s) {
  return speed_rad_s * bench.motor.machine.pole_pairs * bench.spec.period_s * 180.0 / base::pi;
}

TEST(SensorlessObserver, HoldsFromFivePercentOnAndCommutatesAtTheSectorsEdge) {
  InPart some;
  for (const SensorlessMotor& motor : three_motors)
    for (const double load : {0.0, 0.3})
      for (const double part : {0.05, 0.2, 0.8})
        for (const Follow which : three_observers) {
          if (some.leaves_out()) continue;
          SensorlessBench bench(motor);
          follow(bench, which);
          bench.load_part = load;
          const double w = part * bench.no_load_rad_s();
          bench.setpoint(0, w);
          auto rig = bench.rig();
          // Without a load, the speed of the hub motor overshoots its reference and returns to it. At 0.8 s,
          // its torque changes sign, and one commutation of the sliding-mode observer is 5 degrees off. The
          // test therefore starts after this time.
          run_until(rig, aligned_s(bench) + 1.0);
          EXPECT_EQ(phase(rig), SensorlessPhase::running);
          const double turn_s = 2 * base::pi / (bench.motor.machine.pole_pairs * w);
          const CommutationError e =
              watch_commutations(rig, rig.now().seconds() + 2 * turn_s, bench.spec.period_s);
          std::printf("%s, load %2.0f %%, %2.0f %% of no load, %s: rms %.2f, worst %.2f degrees\n",
                      motor.name, 100 * load, 100 * part, word(which), e.rms(), e.worst);
          const auto where = std::string(motor.name) + " " + word(which) + " " + std::to_string(part);
          EXPECT_GE(e.count, 7) << where << ": of 12, less those due right behind a tick, between two looks";
          EXPECT_LT(e.rms(), 0.5 + 0.25 * period_deg(bench, w)) << where;
          EXPECT_LT(e.worst, 1.0 + 0.5 * period_deg(bench, w)) << where;
          EXPECT_NEAR(rig.plant().state().w, w, 0.02 * w) << where;
        }
}

/// Factors by which R, L and K_e differ from the motor's data sheet.
struct Strayed {
  double R, L, K_e;
};
constexpr Strayed strayed[] = {{1.3, 1, 1},     {0.7, 1, 1},     {1, 1.3, 1},     {1, 0.7, 1},
                               {1, 1, 1.1},     {1, 1, 0.9},     {1.3, 1.3, 1.1}, {1.3, 1.3, 0.9},
                               {1.3, 0.7, 1.1}, {1.3, 0.7, 0.9}, {0.7, 1.3, 1.1}, {0.7, 1.3, 0.9},
                               {0.7, 0.7, 1.1}, {0.7, 0.7, 0.9}};

/// The rotor accelerates from rest to 8 % of the no-load speed, and then in steps of some 5 % to 70 %. The
/// commutations at both speeds are checked, and the drive must not lose the rotor.
template <class Firmware, class Config>
void expect_lock(SensorlessBench& bench, const Config& chip, double load, const std::string& where) {
  bench.load_part = load;
  const double slow = 0.08 * bench.no_load_rad_s(), fast = 0.7 * bench.no_load_rad_s();
  const double from_s = aligned_s(bench);
  bench.timeline.clear();
  bench.setpoint(0, slow);
  // The speed rises in small steps. In larger steps, the drive would reach the current limit. With higher L
  // and lower K_e, the old current would then outlast the crossing in two successive sectors. The observers
  // would report a long demagnetisation and catch the rotor again.
  for (int n = 1; n <= 13; ++n) bench.setpoint(from_s + 0.7 + 0.03 * n, slow + (fast - slow) * n / 13);
  rig::Rig<double, Firmware> rig(bench.plant(), {.drive = chip}, bench.board, bench.timeline);
  run_until(rig, from_s + 0.6);
  // An error of 10 % in K_e shifts the commutation by flux linkage by 1.5 degrees (flux_linkage.hpp).
  const double model_deg = 1.6;
  const CommutationError at_slow = watch_commutations(rig, from_s + 0.65, bench.spec.period_s);
  EXPECT_LT(at_slow.worst, model_deg + 1.0 + 0.5 * period_deg(bench, slow)) << where;
  EXPECT_EQ(wrong_looks(rig, from_s + 1.2, 0.5e-3), 0) << where;
  const CommutationError at_fast = watch_commutations(rig, from_s + 1.22, bench.spec.period_s);
  EXPECT_GT(at_fast.count, 10) << where;
  EXPECT_LT(at_fast.worst, model_deg + 1.0 + 0.5 * period_deg(bench, fast)) << where;
  EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
}

TEST(SensorlessObserver, KeepsLockOnMotorsThatStrayFromTheirSheet) {
  InPart some;
  for (int which = 0; which < 2; ++which)
    for (const Strayed& s : strayed) {
      if (which > 0 && (s.R == 1 || s.L == 1))
        continue;  // second motor: only cases in which both R and L
                   // differ
      for (const Follow observer : three_observers) {
        if (some.leaves_out()) continue;
        SensorlessBench bench(three_motors[which]);
        follow(bench, observer);
        bench.motor.machine.R_ohm *= s.R;
        bench.motor.machine.L_H *= s.L;
        bench.motor.machine.K_e_V_s *= s.K_e;
        const std::string where = std::string(three_motors[which].name) + " " + word(observer) + " R " +
                                  std::to_string(s.R) + " L " + std::to_string(s.L) + " K_e " +
                                  std::to_string(s.K_e);
        expect_lock<rig::SensorlessDrive<double>>(bench, bench.chip, 0.3, where);
      }
    }
}

TEST(SensorlessObserver, KeepsLockInFixedPoint) {
  InPart some;
  for (int which = 0; which < 2; ++which)
    for (const Follow observer : three_observers)
      for (const Strayed& s : {Strayed{1, 1, 1}, Strayed{1.3, 0.7, 0.9}, Strayed{0.7, 1.3, 1.1}}) {
        if (some.leaves_out()) continue;
        SensorlessBench bench(three_motors[which]);
        follow(bench, observer);
        bench.motor.machine.R_ohm *= s.R;
        bench.motor.machine.L_H *= s.L;
        bench.motor.machine.K_e_V_s *= s.K_e;
        const auto chip = in_fixed_point<control::Q15>(bench);
        expect_lock<rig::SensorlessDrive<control::Q15>>(
            bench, chip, 0.3, std::string("q15 ") + three_motors[which].name + " " + word(observer));
      }
}

TEST(SensorlessObserver, ReachesNoLoadSpeedBothWays) {
  InPart some;
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1})
      for (const Follow observer : three_observers) {
        if (some.leaves_out()) continue;
        SensorlessBench bench(motor, Mode::duty);
        follow(bench, observer);
        bench.setpoint(0, sign * 1.0);
        auto rig = bench.rig();
        run_until(rig, aligned_s(bench) + 1.5);
        EXPECT_EQ(wrong_looks(rig, aligned_s(bench) + 1.55, 0.2e-3), 0)
            << motor.name << " " << word(observer);
        EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << motor.name << " " << word(observer);
        EXPECT_GT(sign * rig.plant().state().w, 0.97 * bench.no_load_rad_s()) << motor.name << word(observer);
        const CommutationError e =
            watch_commutations(rig, aligned_s(bench) + 1.56, bench.spec.period_s, sign > 0);
        std::printf("%s, no load %s, %s: rms %.2f, worst %.2f degrees\n", motor.name,
                    sign > 0 ? "forward" : "backward", word(observer), e.rms(), e.worst);
      }
}

TEST(SensorlessObserver, ThrottleStepsKeepLock) {
  for (int which = 0; which < 2; ++which)
    for (const Follow observer : three_observers) {
      SensorlessBench bench(three_motors[which], Mode::duty);
      follow(bench, observer);
      bench.load_part = 0.1;
      const double from_s = aligned_s(bench);
      bench.setpoint(0, 0.1);
      for (int n = 0; n < 2; ++n) bench.setpoint(from_s + 0.6 + 0.5 * n, n % 2 == 0 ? 1.0 : 0.1);
      auto rig = bench.rig();
      run_until(rig, from_s + 0.5);
      EXPECT_EQ(wrong_looks(rig, from_s + 1.6, 0.3e-3), 0)
          << three_motors[which].name << " " << word(observer);
      EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none)
          << three_motors[which].name << " " << word(observer);
    }
}

/// The lower speed limit of the design is below the usual 5 % of the no-load speed. For each observer, the
/// test prints the lowest speed at which it follows a rotor with 30 % of the nominal torque as load.
TEST(SensorlessObserver, TellsTheLowestSpeedThatItHolds) {
  for (int which = 0; which < 2; ++which)
    for (const Follow follower : every_follow) {
      double lowest = 1.0;
      for (const double part : {0.05, 0.03, 0.02, 0.01}) {
        SensorlessBench bench(three_motors[which]);
        bench.spec.lowest_part = part;
        bench.start =
            *design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A);
        bench.chip = design::sensorless_drive(bench.drive, bench.start);
        follow(bench, follower);
        bench.load_part = 0.3;
        bench.setpoint(0, part * bench.no_load_rad_s());
        auto rig = bench.rig();
        run_until(rig, aligned_s(bench) + 1.2);
        if (wrong_looks(rig, aligned_s(bench) + 1.5, 1e-3) != 0) break;
        if (rig.firmware().rotor().lock.last != LockLoss::none) break;
        lowest = part;
      }
      std::printf("%s, %s: holds down to %.0f %% of the no-load speed\n", three_motors[which].name,
                  word(follower), 100 * lowest);
      EXPECT_LE(lowest, 0.05) << three_motors[which].name << " " << word(follower);
    }
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The sensorless drive captures the edges of comparators at its filtered terminals. The crossings are at the
// angles of the closed form. As with samples, the drive starts, runs at its speeds and names the causes of
// its losses.
#include "tests/support/sensorless_comparators.hpp"
#include "tests/support/in_part.hpp"
#include "tests/support/seen_crossings.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using control::LockLoss;
using control::SensorlessPhase;
using rig::CrossingReference;

constexpr CrossingReference references[] = {CrossingReference::virtual_star, CrossingReference::half_bus};

/// Slope of the compared voltage, in V per electrical rad. In a sector, u_f (the voltage of the floating
/// terminal) minus the mean of all three terminals falls by 4 K_e w/3. u_f minus half the bus voltage falls
/// by 2 K_e w.
double slope_V_rad(const SensorlessBench& bench, CrossingReference against, double w) {
  return (against == CrossingReference::half_bus ? 2.0 : 4.0 / 3.0) * bench.motor.machine.K_e_V_s * w /
         base::sector_rad;
}

/// At full duty, the bridge does not chop. An edge is delayed by the lag, the offset of the floating leg and
/// half the hysteresis, but not by samples. The bound is two counts of the timer, plus 1e-3 of the delay for
/// the effect of the torque ripple on the speed.
TEST(SensorlessComparators, AnEdgeComesLateByLagOffsetAndHysteresis) {
  SensorlessBench bench(three_motors[0], control::Mode::duty);
  bench.spec.capture_Hz = bench.board.sensors.capture_Hz = 64e6;
  rig::CrossingComparators comparators{.offset_V = {0.08, -0.05, 0.03}, .hysteresis_V = 0.06};
  bench.load_part = 0.3;
  for (const CrossingReference against : references) {
    comparators.against = against;
    // At full duty, there is no edge of a pulse after which the low-pass filter must settle. With half the
    // bus voltage as reference, it may therefore be slow.
    capture_crossings(bench, comparators, against == CrossingReference::half_bus ? 0.8 : 0.3);
    bench.timeline.clear();
    bench.setpoint(0, 1);
    const SeenCrossings seen = seen_crossings(bench, aligned_s(bench) + 0.5);
    const double w = seen.speed_rad_s, w_e = bench.motor.machine.pole_pairs * w;
    const double slope = slope_V_rad(bench, against, w);
    for (std::uint8_t k = 0; k < 6; ++k) {
      ASSERT_GT(seen.count[k], 50);
      const double offset_V = comparators.offset_V[control::floating_leg(k)];
      const double late = bench.board.front_end.comparators.lag_s * w_e +
                          (comparators.hysteresis_V / 2 + (k % 2 == 0 ? -offset_V : offset_V)) / slope;
      EXPECT_NEAR(seen.late_rad[k], late, 1e-3 * std::fabs(late) + 2 * w_e / 64e6) << word(against) << int(k);
    }
  }
}

/// With hard chopping, the star point's voltage is constant, and an edge is delayed by tau. With soft and
/// complementary chopping, a diode delays a negative back-EMF until the next pulse, by up to one off-time.
TEST(SensorlessComparators, ChoppingDelaysAnEdgeByAPauseAtMost) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double part : {0.1, 0.3, 0.6}) {
      SensorlessBench bench(three_motors[0], control::Mode::speed, chopping);
      bench.spec.capture_Hz = bench.board.sensors.capture_Hz = 64e6;
      bench.load_part = 0.3;
      capture_crossings(bench, {});
      bench.setpoint(0, part * bench.no_load_rad_s());
      const SeenCrossings seen = seen_crossings(bench, aligned_s(bench) + 0.8);
      const double w_e = bench.motor.machine.pole_pairs * seen.speed_rad_s;
      const double tau = bench.board.front_end.comparators.lag_s, ticks_s = 2 / 64e6 + 1e-3 * tau;
      const double pause_s = chopping == Chopping::hard ? 0.0 : (1 - part) * bench.spec.period_s;
      for (std::size_t k = 0; k < 6; ++k) {
        const double late_s = seen.late_rad[k] / w_e;
        EXPECT_GE(late_s, tau - ticks_s) << word(chopping) << part << k;
        EXPECT_LE(late_s, tau + pause_s + ticks_s) << word(chopping) << part << k;
      }
    }
}

/// Samples of 8 bits have errors of up to half a step. Captured edges on the same board have no such error.
TEST(SensorlessComparators, CommutatesEvenlyWhereSamplesAreRounded) {
  const auto spread_deg = [](bool by_edges) {
    SensorlessBench bench(three_motors[0], control::Mode::speed, Chopping::hard);
    bench.spec.lowest_part = 0.1;
    bench.spec.adc_bits = bench.board.sensors.bus.bits = 8;
    if (by_edges) capture_crossings(bench, {});
    bench.chip = design::sensorless_drive(
        bench.drive,
        *design::sensorless_start(bench.motor, bench.spec, bench.drive.current_at_full_torque_A));
    bench.setpoint(0, 0.3 * bench.no_load_rad_s());
    auto rig = bench.rig();
    run_until(rig, 2.0);
    EXPECT_EQ(phase(rig), SensorlessPhase::running);
    const CommutationError e = watch_commutations(rig, 2.1, bench.spec.period_s);
    EXPECT_GT(e.count, 100);
    return std::sqrt(e.rms() * e.rms() - e.mean() * e.mean());
  };
  const double by_samples = spread_deg(false), by_edges = spread_deg(true);
  EXPECT_LT(by_edges, by_samples / 2) << by_edges << " of " << by_samples << " deg";
}

TEST(SensorlessComparators, StartsFromAnyAngleAgainstAnyLoadBothWays) {
  const auto bench_of = [](const SensorlessMotor& motor, int n) {
    SensorlessBench bench = on_built_board(motor, control::Mode::speed,
                                           n / 2 % 2 == 0 ? Chopping::soft : Chopping::complementary);
    capture_crossings(bench, usual_comparators(references[n % 2], motor.bus_V));
    return bench;
  };
  expect_starts_from_any_angle(20'241'124, bench_of, [](int n) { return (n + 1) / 4 % 2 == 0 ? 1 : -1; });
}

TEST(SensorlessComparators, HoldsEverySpeedBothWays) {
  int n = 0;
  for (const SensorlessMotor& motor : three_motors)
    for (const CrossingReference against : references)
      // The hardest cases are the slowest speed without a load, where the back-EMF is smallest, and a high
      // speed with a load.
      for (const double load : {0.0, 0.5}) {
        const double slowest = against == CrossingReference::half_bus ? 0.3 : 0.06,
                     part = load > 0 ? 0.8 : slowest;
        const Chopping chopping = n % 2 == 0 ? Chopping::soft : Chopping::complementary;
        const int sign = n++ / 2 % 2 == 0 ? 1 : -1;
        if (!all_cases() && n / 3 % 2 == 0) continue;
        SensorlessBench bench = on_built_board(motor, control::Mode::speed, chopping);
        capture_crossings(bench, usual_comparators(against, motor.bus_V));
        bench.load_part = load;
        expect_speed_held(bench, sign * part, std::string(motor.name) + " " + word(against));
      }
}

/// The control period is so long that a sector near the no-load speed has only three control periods.
TEST(SensorlessComparators, ThreePeriodsASectorAreEnough) {
  for (const SensorlessMotor& motor : three_motors)
    for (const int sign : {1, -1}) {
      SensorlessMotor slow = motor;
      const SensorlessBench first(motor);
      const double w = 0.95 * first.no_load_rad_s();
      slow.period_s = base::sector_rad / (first.motor.machine.pole_pairs * w) / 3.05;
      SensorlessBench bench(slow, control::Mode::duty);
      capture_crossings(bench, {});
      EXPECT_GT(bench.start.highest_rad_s, w);
      bench.setpoint(0, sign * 0.95);
      auto rig = bench.rig();
      const std::string where = std::string(motor.name) + (sign > 0 ? " forward" : " backward");
      run_until(rig, aligned_s(bench) + 1.5);
      EXPECT_EQ(wrong_looks(rig, aligned_s(bench) + 1.7, 1e-3), 0) << where;
      EXPECT_NEAR(rig.plant().state().w, sign * w, 0.1 * w) << where;
      EXPECT_EQ(rig.firmware().rotor().lock.last, LockLoss::none) << where;
    }
}

/// Returns the name of the loss. It is the name that a drive with samples gives (sensorless_names_test.cpp).
LockLoss named(SensorlessBench& bench, double cause_s) {
  auto rig = bench.rig();
  run_until(rig, cause_s);
  EXPECT_EQ(phase(rig), SensorlessPhase::running);
  const double t = run_until_true(rig, cause_s + 0.3, bench.spec.period_s,
                                  [&] { return phase(rig) != SensorlessPhase::running; });
  EXPECT_GT(t, 0);
  return rig.firmware().rotor().lock.last;
}

TEST(SensorlessComparators, NamesWhatWentWrong) {
  for (const SensorlessMotor& motor : three_motors)
    for (const CrossingReference against : references) {
      const auto bench_at = [&](double w_part) {
        SensorlessBench bench(motor);
        capture_crossings(bench, usual_comparators(against, motor.bus_V));
        bench.setpoint(0, w_part * bench.no_load_rad_s());
        return bench;
      };
      const std::string where = std::string(motor.name) + " " + word(against);
      SensorlessBench held = bench_at(0.5);
      const double cause_s = aligned_s(held) + 0.6;
      held.act(cause_s, rig::ActionKind::shaft_locked, 1);
      EXPECT_EQ(named(held, cause_s), LockLoss::masked_crossing) << where;
      // with half the bus voltage as reference, the hand-over is at twice this speed
      if (against == CrossingReference::half_bus) continue;
      SensorlessBench struck = bench_at(-0.1);
      const double blow_s = 4 * struck.spec.period_s;
      struck.act(cause_s, rig::ActionKind::load_torque,
                 0.6 * struck.no_load_rad_s() * struck.motor.shaft.J_kg_m2 / blow_s);
      struck.act(cause_s + blow_s, rig::ActionKind::load_torque, 0);
      EXPECT_EQ(named(struck, cause_s), LockLoss::wrong_sector) << where;
    }
}

}  // namespace SIXSTEP_TEST_FILE

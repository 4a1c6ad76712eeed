// SPDX-License-Identifier: Apache-2.0
// Tests the timing of the board (model.md 3, 4): delay, commutation at the sample, Hall edges, statistics and
// faults.
#include "sixstep/rig/lean_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using rig::EventKind;

constexpr double us = 1e-6;

TEST(Rig, DelayedCommandTakesEffectOnePeriodAfterItsSample) {
  Board b = Board::duty(0.5);
  b.board.delayed = true;
  b.setpoint(10 * 30'000'000, 0.25);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 20 * us), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), all_off()) << "nothing was sampled before t = 0";
  ASSERT_EQ(run_to(rig, 31 * us), sim::Stop::end);
  EXPECT_EQ(rig.modulator().command().duty, 0.5);
  ASSERT_EQ(run_to(rig, 301 * us), sim::Stop::end);
  EXPECT_EQ(rig.telemetry().duty, 0.25) << "sampled";
  EXPECT_EQ(rig.modulator().command().duty, 0.5) << "not yet in effect";
  ASSERT_EQ(run_to(rig, 331 * us), sim::Stop::end);
  EXPECT_EQ(rig.modulator().command().duty, 0.25);
}

TEST(Rig, ADelayedHysteresisWaitsForItsSampleToo) {
  // With a delay, the sample at 60 us detects the step at 45 us, and the step takes effect at 90 us. Without
  // a delay, the step takes effect at once.
  for (const bool delayed : {true, false}) {
    Board b = Board::hysteresis(5.0, 0.2, Chopping::soft);
    b.board.delayed = delayed;
    b.setpoint(45'000'000, 8.0);
    auto rig = b.rig();
    for (const double t_us : {46.0, 61.0, 89.0, 91.0}) {
      ASSERT_EQ(run_to(rig, t_us * us), sim::Stop::end);
      const double reference = delayed && t_us < 90.0 ? 5.0 : 8.0;
      EXPECT_DOUBLE_EQ(rig.modulator().command().off_above_A, reference + 0.2) << t_us;
    }
  }
}

TEST(Rig, ThePositionCountsDegreesOfTheShaftOverTurns) {
  Board b;
  b.drive.mode = control::Mode::position;
  b.drive.position_gain = 1.0;
  b.drive.speed_limit_rad_s = 1e6;
  b.shaft.locked = true;
  for (const double deg : {5.0, 40.0, 400.0, -40.0}) {
    b.start.angle_rad = at_electrical_deg(8 * deg);
    auto rig = b.rig();
    ASSERT_EQ(run_to(rig, 1 * us), sim::Stop::end);
    EXPECT_NEAR(rig.telemetry().speed_reference_rad_s, -deg, 8 * eps * std::fabs(deg)) << deg;
  }
}

/// A drive at constant speed. Its first sector edge is at 40 us, between two ticks.
Board edge_between_ticks() {
  Board b = Board::duty(0.9);
  b.shaft.J_kg_m2 = 1e9;
  b.start.speed_rad_s = 300.0;
  b.start.angle_rad = at_electrical_deg(60.0) - 300.0 * 40 * us;
  return b;
}

TEST(Rig, CommutatesAtTheHallEdgeItself) {
  const Board b = edge_between_ticks();
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 41 * us), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
  EXPECT_EQ(rig.event_count(EventKind::tick), 2);
}

TEST(Rig, OrAtTheNextSample) {
  Board b = edge_between_ticks();
  b.board.commutate_at_sample = true;
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 41 * us), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
  EXPECT_EQ(rig.plant().gates(), a_to_b());
  ASSERT_EQ(run_to(rig, 61 * us), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
}

TEST(Rig, AHallEdgeKeepsTheSignInEffectWhileAReversalWaits) {
  // The reversal that is sampled at 30 us takes effect at 60 us. The edge at 40 us therefore still uses the
  // old sign.
  Board b = edge_between_ticks();
  b.board.delayed = true;
  b.setpoint(15'000'000, -0.9);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 41 * us), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
  ASSERT_EQ(run_to(rig, 61 * us), sim::Stop::end);
  EXPECT_EQ(rig.plant().gates(), gates({false, false, true}, {true, false, false}));
}

TEST(Rig, DutyIsFeltAsTheMeanVoltage) {
  // The rotor is locked, the chopping is soft, and the current is continuous. The steady state has the mean
  // current d U/R_tt (duty d, bus voltage U, line-to-line resistance R_tt) and a ripple.
  Board b = Board::duty(0.5);
  b.shaft.locked = true;
  b.start.angle_rad = 0.02;
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 20e-3 - 15e-6), sim::Stop::end);  // an off edge: the ripple's maximum
  const double tau = b.tau(), full = 24.0 / b.R_tt();
  const double top = full * std::expm1(-15e-6 / tau) / std::expm1(-30e-6 / tau);
  const auto periods = static_cast<int>(20e-3 / 30e-6);
  ASSERT_EQ(run_to(rig, periods * 30e-6 + 15e-6), sim::Stop::end);
  EXPECT_NEAR(rig.plant().state().i[0], top, full * std::exp(-20e-3 / tau) + 64 * eps * full);
}

TEST(Rig, TicksAndEdgesAreCounted) {
  const Board b = Board::duty(0.5);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 3e-3), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::tick), 101);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 100);
  EXPECT_EQ(rig.modulator().turn_ons(), 101);
}

/// The statistic "diode starts to conduct" counts each start, whether the start was located as an event or
/// coincided with a PWM edge. The reference trajectory R3 has 1600 starts.
TEST(Rig, CountsEveryStartOfADiode) {
  const Board b = Board::duty(0.5);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 0.1), sim::Stop::end);
  EXPECT_EQ(rig.plant().diodes_started(), 1600);
}

/// The count includes the switching that a setpoint step or a sector edge causes at once.
TEST(Rig, CountsEverySwitchingOfAComparator) {
  Board b = Board::hysteresis(5.0, 0.2, Chopping::soft);
  for (int n = 1; n < 4; ++n) b.setpoint(n * 5'000'000'000LL, n % 2 == 0 ? 5.0 : -5.0);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 20e-3 - 1e-12), sim::Stop::end);
  // In the reference trajectory R7s, the comparator switches off 332 times. After each of these instants,
  // except perhaps the last, it switches on again.
  const std::int64_t off = 332;
  EXPECT_NEAR(static_cast<double>(rig.event_count(EventKind::comparator)), 2.0 * off, 1.0);
}

/// The times at which the comparator switched off.
struct Offs {
  bool on = false;
  std::vector<double> at_s;
  void segment(const rig::LeanRig<double>& r, double) {
    if (on && !r.modulator().source_on()) at_s.push_back(r.now().seconds());
    on = r.modulator().source_on();
  }
};

TEST(Rig, HysteresisSwitchesAsOftenAsTheReference) {
  Board b = Board::hysteresis(5.0, 0.2, Chopping::soft);
  for (int n = 1; n < 4; ++n) b.setpoint(n * 5'000'000'000LL, n % 2 == 0 ? 5.0 : -5.0);
  auto rig = b.rig();
  Offs offs;
  ASSERT_EQ(run_to(rig, 20e-3, offs), sim::Stop::end);
  EXPECT_EQ(offs.at_s.size(), 332u);
  // R7s has the mean switching frequencies 19.65, 14.74, 19.70 and 14.70 kHz in its four quarters.
  const double reference[] = {19.65e3, 14.74e3, 19.70e3, 14.70e3};
  for (int quarter = 0; quarter < 4; ++quarter) {
    double first = 0, last = 0;
    int count = 0;
    for (const double t : offs.at_s)
      if (t >= quarter * 5e-3 && t < (quarter + 1) * 5e-3) {
        if (count++ == 0) first = t;
        last = t;
      }
    EXPECT_NEAR((count - 1) / (last - first), reference[quarter], 5.0) << quarter;
  }
}

}  // namespace SIXSTEP_TEST_FILE

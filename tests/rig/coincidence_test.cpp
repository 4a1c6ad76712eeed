// SPDX-License-Identifier: Apache-2.0
// Each test has two events at one instant. There is one test for each pair of scenario step, control tick,
// PWM edge, comparator, sector edge and current zero. Each of the two events must take effect once, in the
// order of model.md 4b (pitfall 1: no energy balance detects a lost tick). This file contains the pairs with
// a scenario step or a control tick. The counts of events show whether an edge was executed before the tick
// that should have replaced it.
#include <gtest/gtest.h>

#include "tests/support/coinciding.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using rig::EventKind;

constexpr std::int64_t period = period_ticks;

template <class Rig>
int source_leg(const Rig& rig) {
  return static_cast<int>(rig.modulator().command().pair.source);
}
template <class Rig>
int sink_leg(const Rig& rig) {
  return static_cast<int>(rig.modulator().command().pair.sink);
}

TEST(Pitfall01_CoincidentInstants, StepAndTickTheTickSeesTheStep) {
  Board b = Board::duty(0.5);
  b.setpoint(500 * period, -0.25);  // 15 ms
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 15e-3), sim::Stop::end);
  EXPECT_EQ(rig.setpoint(), -0.25);
  EXPECT_EQ(rig.telemetry().duty, -0.25) << "a reference that steps at 15 ms is new at that sample";
  EXPECT_EQ(rig.event_count(EventKind::tick), 501);
}

TEST(Pitfall01_CoincidentInstants, StepAndPwmEdge) {
  Board b = locked(Board::duty(0.5));
  b.setpoint(10 * period + period / 2, 0.75);
  b.load(10 * period + period / 2, 0.1);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 10.5 * 30 * us), sim::Stop::end);
  EXPECT_EQ(rig.setpoint(), 0.75);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.1);
  EXPECT_FALSE(rig.modulator().source_on()) << "the running period keeps its duty";
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 11);
  ASSERT_EQ(run_to(rig, 11.5 * 30 * us), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on());
}

TEST(Pitfall01_CoincidentInstants, StepAndComparator) {
  Board b = locked(Board::hysteresis(10.0, 0.25, Chopping::soft));
  // The new level is below the present current, so the comparator trips at the instant of the step.
  b.setpoint(123'456'789, 1.0);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 123.456788 * us), sim::Stop::end);
  ASSERT_TRUE(rig.modulator().source_on());
  ASSERT_GT(rig.plant().state().i[0], 1.25);
  ASSERT_EQ(run_to(rig, 123.456789 * us), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_FALSE(rig.plant().gates().high[0]);
  ASSERT_EQ(run_to(rig, 130 * us), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on()) << "and only once";
  EXPECT_EQ(rig.modulator().turn_ons(), 1);
  EXPECT_EQ(rig.event_count(EventKind::comparator), 1);
}

TEST(Pitfall01_CoincidentInstants, StepAndSectorEdge) {
  Board b = turning(Board::duty(1.0), 20 * us);
  b.setpoint(20'000'000, 0.5);
  b.load(20'000'000, 0.125);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 20 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
  EXPECT_EQ(sink_leg(rig), 2);
  EXPECT_EQ(rig.setpoint(), 0.5);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.125);
  laws.expect_all();
}

TEST(Pitfall01_CoincidentInstants, StepAndCurrentZero) {
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 27 * us) / (30 * us));
  b.setpoint(27'000'000, 0.75);
  b.load(27'000'000, 0.125);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 27 * us + ns), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::diode_off), 1);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.125);
  ASSERT_EQ(run_to(rig, 30 * us), sim::Stop::end);
  EXPECT_EQ(rig.telemetry().duty, 0.75);
  EXPECT_EQ(rig.event_count(EventKind::diode_off), 1);
}

TEST(Pitfall01_CoincidentInstants, TickAndPwmEdgeBothHappen) {
  // The PWM is centre-aligned at half duty with a dead time of a quarter period, so the lower switch turns on
  // exactly at the tick. The edges are at 7.5 us (the first dead time ends, and the upper switch turns on),
  // 15 us, 22.5 us (a turn-off command) and 30 us (its dead time ends).
  for (const double next : {0.5, 1.0}) {
    Board b = locked(Board::duty(0.5, Chopping::complementary));
    b.board.modulator.centre_aligned = true;
    b.board.modulator.dead_ticks = 7.5e6;
    b.setpoint(period, next);
    auto rig = b.rig();
    ASSERT_EQ(run_to(rig, 30 * us - 1e-12), sim::Stop::end);
    ASSERT_EQ(rig.event_count(EventKind::pwm_edge), 3);
    ASSERT_FALSE(rig.plant().gates().low[0]);
    ASSERT_EQ(run_to(rig, 30 * us), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::tick), 2);
    EXPECT_EQ(rig.telemetry().duty, next);
    // At full duty, the tick is executed first and commands the upper switch on. A new dead time replaces the
    // dead time that would have ended at 30 us.
    EXPECT_EQ(rig.event_count(EventKind::pwm_edge), next < 1.0 ? 4 : 3);
    EXPECT_EQ(rig.plant().gates().low[0], next < 1.0);
    EXPECT_FALSE(rig.plant().gates().high[0]);
  }
}

TEST(Pitfall01_CoincidentInstants, TickAndPwmEdgeTheTickComesFirst) {
  // The dead time is half a period, so at each tick one dead time would end and the next begins. The tick
  // must replace the edge at the end of the first dead time. If this edge were executed before the tick, it
  // would be counted.
  Board b = locked(Board::duty(0.5, Chopping::complementary));
  b.board.modulator.dead_ticks = 15e6;
  auto rig = b.rig();
  for (int n = 1; n < 20; ++n) {
    ASSERT_EQ(run_to(rig, n * 15 * us), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::tick), n / 2 + 1);
    EXPECT_EQ(rig.event_count(EventKind::pwm_edge), (n + 1) / 2);
    EXPECT_FALSE(rig.plant().gates().high[0]);
    EXPECT_FALSE(rig.plant().gates().low[0]);
  }
  EXPECT_EQ(rig.plant().state().i[0], 0.0);
}

TEST(Pitfall01_CoincidentInstants, TickAndAPwmEdgeThatTheTimerRoundsOntoItLeaveNoGap) {
  Board b = locked(Board::duty(0.999));
  b.board.modulator.timer_ticks = 1e6;  // 29.97 us -> 30 us
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 1e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 0);
  EXPECT_EQ(rig.event_count(EventKind::tick), 34);
  EXPECT_EQ(rig.modulator().turn_ons(), 1);
  const double exact = -24.0 / b.R_tt() * std::expm1(-1e-3 / b.tau());
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-13 * exact);
}

TEST(Pitfall01_CoincidentInstants, TickAndComparator) {
  Board b = locked(Board::hysteresis(0.0, 0.25, Chopping::soft));
  const double i_5 = -24.0 / b.R_tt() * std::expm1(-150e-6 / b.tau());  // at the fifth tick
  b.timeline.clear();
  b.setpoint(0, i_5 - 0.25);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 150 * us - ns), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on());
  ASSERT_EQ(run_to(rig, 150 * us + ns), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_EQ(rig.event_count(EventKind::tick), 6);
  EXPECT_EQ(rig.event_count(EventKind::comparator), 1);
  EXPECT_EQ(rig.modulator().turn_ons(), 1);
}

TEST(Pitfall01_CoincidentInstants, TickAndSectorEdge) {
  for (const bool at_sample : {false, true}) {
    Board b = turning(Board::duty(0.5), 30 * us);
    b.board.commutate_at_sample = at_sample;
    b.setpoint(period, 0.25);
    auto rig = b.rig();
    ASSERT_EQ(run_to(rig, 30 * us + ns), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
    EXPECT_EQ(rig.event_count(EventKind::tick), 2);
    EXPECT_EQ(rig.telemetry().duty, 0.25);
    EXPECT_EQ(rig.plant().sector(), 1);
    // With commutation at the sample, rounding may shift the edge to just after this sample. The next sample
    // then commutates.
    ASSERT_EQ(run_to(rig, at_sample ? 60 * us : 31 * us), sim::Stop::end);
    EXPECT_EQ(source_leg(rig), 0);
    EXPECT_EQ(sink_leg(rig), 2);
  }
}

TEST(Pitfall01_CoincidentInstants, TickAndSectorEdgeAtTheStartBackwards) {
  // The rotor starts on the edge and turns backwards, so the tick of t = 0 is exactly on the edge. The edge
  // is executed before the tick: the run begins in the sector that the rotor enters.
  Board b = turning(Board::duty(0.5), 30 * us);
  b.start.angle_rad = 0.0;
  b.start.speed_rad_s = -100.0;
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, ns), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 0);
  EXPECT_EQ(rig.event_count(EventKind::tick), 1);
  EXPECT_EQ(rig.plant().sector(), 5);
  EXPECT_EQ(source_leg(rig), 2);
  EXPECT_EQ(sink_leg(rig), 1);
}

TEST(Pitfall01_CoincidentInstants, TickAndCurrentZero) {
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 30 * us) / (30 * us));
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 30 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::tick), 2);
  EXPECT_TRUE(rig.plant().gates().high[0]);
  // At the tick, the current was zero within rounding. The second period is therefore equal to the first
  // period.
  const double exact = 24.0 * ns / b.L_tt();
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-5 * exact);
  ASSERT_EQ(run_to(rig, 60 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::tick), 3);
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-5 * exact);
  laws.expect_all();
}

}  // namespace SIXSTEP_TEST_FILE

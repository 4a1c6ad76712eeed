// SPDX-License-Identifier: Apache-2.0
// In open loop with steady gates, the rig skips control ticks without changing the result.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The current loop is always saturated, so it applies the full voltage. Every tick of this board is
/// simulated.
Board saturated() {
  Board b = Board::duty(0.0);
  b.timeline.clear();
  b.drive.mode = control::Mode::current;
  b.drive.current = {1.0, 0.0, 24.0};
  b.setpoint(0, 1e6);
  return b;
}

TEST(IdleTicks, SkippingThemChangesRoundingOnly) {
  const Board full = Board::duty(1.0), busy = saturated();
  auto a = full.rig(), b = busy.rig();
  ASSERT_EQ(run_to(a, 30e-3), sim::Stop::end);
  ASSERT_EQ(run_to(b, 30e-3), sim::Stop::end);
  EXPECT_EQ(a.event_count(rig::EventKind::tick), 1);
  EXPECT_EQ(b.event_count(rig::EventKind::tick), 1001);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.plant().state().i[k], b.plant().state().i[k], 1e-11 * 23.3);
  EXPECT_NEAR(a.plant().state().w, b.plant().state().w, 1e-12 * 700.0);
  EXPECT_EQ(a.event_count(rig::EventKind::sector_edge), b.event_count(rig::EventKind::sector_edge));
}

/// The duty steps on a tick or between two ticks. In one run it starts from full duty. In the other run it
/// starts from slightly less, so that no tick is skipped.
void expect_steps_seen(std::int64_t at_ticks) {
  Board skipping = Board::duty(1.0), busy = Board::duty(1.0 - 1e-15);
  for (Board* b : {&skipping, &busy}) {
    b->setpoint(at_ticks, 0.25);
    b->load(at_ticks + 7'000'000, 0.01);
  }
  auto a = skipping.rig(), b = busy.rig();
  ASSERT_EQ(run_to(a, 12e-3), sim::Stop::end);
  ASSERT_EQ(run_to(b, 12e-3), sim::Stop::end);
  EXPECT_EQ(a.modulator().command().duty, 0.25);
  // The only difference is an off-time of 3e-8 ps in each period.
  EXPECT_NEAR(a.plant().state().w, b.plant().state().w, 1e-12 * 700.0);
  EXPECT_NEAR(a.plant().state().i[0], b.plant().state().i[0], 1e-10 * 23.3);
}

TEST(IdleTicks, AStepOnATickIsSeenThere) { expect_steps_seen(333 * 30'000'000LL); }
TEST(IdleTicks, AStepBetweenTicksIsSeenAtTheNext) { expect_steps_seen(333 * 30'000'000LL + 12'345'678); }

TEST(IdleTicks, SeveralStepsBetweenTwoTicksLeaveTheLast) {
  Board b = Board::duty(1.0);
  b.setpoint(9'005'000'000, 0.7);
  b.setpoint(9'006'000'000, 0.3);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 9.01e-3), sim::Stop::end);
  EXPECT_EQ(rig.modulator().command().duty, 1.0);
  ASSERT_EQ(run_to(rig, 9.03e-3), sim::Stop::end);
  EXPECT_EQ(rig.modulator().command().duty, 0.3);
}

TEST(IdleTicks, FromRestWithTheBridgeAtZero) {
  Board b = Board::duty(0.0);
  b.setpoint(1'000'000'007, 0.5);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 2e-3), sim::Stop::end);
  EXPECT_GT(rig.plant().state().w, 0.0);
}

}  // namespace SIXSTEP_TEST_FILE

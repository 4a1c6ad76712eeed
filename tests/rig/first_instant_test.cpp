// SPDX-License-Identifier: Apache-2.0
// Tests the first instant of a run: the dead time, the sector of a rotor on an edge, and a setpoint with a
// limited slew rate.
#include <gtest/gtest.h>

#include "sixstep/control/commutation.hpp"
#include "tests/support/coinciding.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

/// The current PI controller of the reference cases.
Board current_pi(double i_ref) {
  Board b;
  b.drive.mode = control::Mode::current;
  b.drive.current = {4.5, -4.04, 24.0};
  b.setpoint(0, i_ref);
  return b;
}

TEST(FirstInstant, TheFirstTurnOnWaitsTheDeadTimeWithDutyPiAndHysteresis) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (Board b : {Board::duty(0.5), current_pi(5.0), Board::hysteresis(5.0, 0.2, Chopping::soft)}) {
      b.drive.chopping = chopping;
      b = locked(b);
      b.board.modulator.dead_ticks = 2e6;
      auto rig = b.rig();
      ASSERT_EQ(run_to(rig, 1.999 * us), sim::Stop::end);
      EXPECT_EQ(rig.plant().gates(), all_off());
      EXPECT_EQ(rig.plant().state().i[0], 0.0);
      ASSERT_EQ(run_to(rig, 2.5 * us), sim::Stop::end);
      EXPECT_EQ(rig.plant().gates(), a_to_b());
      // The current is 24 V 0.5 us/0.572 mH. The resistance reduces this current by less than 1e-3.
      EXPECT_NEAR(rig.plant().state().i[0], 24.0 * 0.5 * us / b.L_tt(), 1e-3 * 24.0 * 0.5 * us / b.L_tt());
    }
}

/// The first samples show the sector that the rotor enters. Backwards from 0 degrees, this is sector 5 with
/// the pair c to b.
TEST(FirstInstant, OnASectorEdgeTurningBackwardsTheFirstTickUsesTheSectorThatIsEntered) {
  for (int edge = 0; edge < 6; ++edge)
    for (const double speed : {300.0, -300.0}) {
      SCOPED_TRACE(::testing::Message() << edge << " " << speed);
      Board b = Board::duty(0.9);
      b.board.commutate_at_sample = true;
      b.start.angle_rad = at_electrical_deg(60.0 * edge);
      b.start.speed_rad_s = speed;
      auto rig = b.rig();
      ASSERT_EQ(run_to(rig, ns), sim::Stop::end);
      const int sector = speed > 0 ? edge : (edge + 5) % 6;
      EXPECT_EQ(rig.plant().sector(), sector);
      EXPECT_EQ(rig.modulator().command().pair, control::positive_pair(static_cast<std::uint8_t>(sector)));
      ASSERT_EQ(run_to(rig, 29 * us), sim::Stop::end);
      EXPECT_EQ(rig.plant().sector(), sector);
      EXPECT_EQ(rig.event_count(rig::EventKind::sector_edge), 0) << "an edge is passed once, and was";
    }
}

/// The setpoint slews at 2000 A/s, 0.06 A per tick. It starts at the measured current, even if the setpoint
/// jumps between two ticks.
TEST(FirstInstant, ASetpointOfAnEventHysteresisSlewsOncePerTick) {
  Board b = locked(Board::hysteresis(4.0, 0.02, Chopping::soft));
  b.drive.extras.on = b.drive.extras.slews_setpoint = true;
  b.drive.extras.slew.step = 0.06;
  b.setpoint(10 * period_ticks, 3.0);                     // at a tick
  b.setpoint(20 * period_ticks + period_ticks / 3, 5.0);  // between two ticks
  auto rig = b.rig();
  for (int n = 0; n < 60; ++n) {
    ASSERT_EQ(run_to(rig, n * 30 * us), sim::Stop::end);
    EXPECT_NEAR(rig.current_reference_A(), 0.06 * (n + 1), 1e-12) << n;
    ASSERT_EQ(run_to(rig, (n + 0.5) * 30 * us), sim::Stop::end);
    EXPECT_NEAR(rig.current_reference_A(), 0.06 * (n + 1), 1e-12) << n;
  }
}

}  // namespace SIXSTEP_TEST_FILE

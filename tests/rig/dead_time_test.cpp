// SPDX-License-Identifier: Apache-2.0
// The bridge keeps the dead time in whole runs with reversals, full duty, Hall edges, and every kind of
// bridge command.
#include <gtest/gtest.h>

#include "sixstep/rig/lean_rig.hpp"
#include "tests/support/coinciding.hpp"
#include "tests/support/dead_time_watch.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

constexpr double dead_s = 2e-6;

struct GatesWatch {
  DeadTimeWatch watch{dead_s};
  void segment(const rig::LeanRig<double>& rig, double) { watch.look(rig.plant().gates(), rig.now()); }
};

/// Steps of +-5 A during the acceleration, and one reversal at full voltage between them.
Board reversing(Board b) {
  for (int n = 1; n < 6; ++n) b.setpoint(n * 3'000'000'000LL, n == 3 ? -40.0 : n % 2 == 0 ? 5.0 : -5.0);
  b.start.speed_rad_s = 400.0;
  b.board.modulator.dead_ticks = dead_s * 1e12;
  return b;
}

Board current_pi() {
  Board b;
  b.drive.mode = control::Mode::current;
  b.drive.current = {4.5, -4.04, 24.0};
  b.setpoint(0, 5.0);
  return b;
}

TEST(DeadTime, HoldsInEveryLegOverWholeRuns) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const bool at_sample : {false, true})
      for (const bool at_commutation : {false, true})
        for (Board b : {reversing(current_pi()), reversing(Board::hysteresis(5.0, 0.2, Chopping::soft))}) {
          SCOPED_TRACE(::testing::Message() << int(chopping) << at_sample << at_commutation);
          b.drive.chopping = chopping;
          b.board.commutate_at_sample = at_sample;
          b.board.modulator.dead_time_at_commutation = at_commutation;
          auto rig = b.rig();
          GatesWatch gates;
          ASSERT_EQ(run_to(rig, 18e-3, gates), sim::Stop::end);
          EXPECT_GT(gates.watch.turn_ons(), 100);
          EXPECT_GT(rig.event_count(rig::EventKind::sector_edge), 5);
        }
}

/// At a commutation, switches turn on in two legs: in the leg through which the current enters the motor, and
/// in the leg through which it leaves.
TEST(DeadTime, AtCommutationDelaysSourceAndSinkAlsoAtTheSampleAndOnlyWhereItIsAskedFor) {
  for (const bool at_sample : {false, true})
    for (const bool asked : {false, true}) {
      SCOPED_TRACE(::testing::Message() << at_sample << asked);
      Board b = turning(Board::duty(1.0), 40 * us);  // sector 0 to 1: the sink moves from b to c
      b.board.commutate_at_sample = at_sample;
      b.board.modulator.dead_ticks = dead_s * 1e12;
      b.board.modulator.dead_time_at_commutation = asked;
      auto rig = b.rig();
      const double at_s = at_sample ? 60 * us : 40 * us;
      ASSERT_EQ(run_to(rig, at_s + 1.9 * us), sim::Stop::end);
      EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, !asked}));
      ASSERT_EQ(run_to(rig, at_s + 2.1 * us), sim::Stop::end);
      EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
    }
}

}  // namespace SIXSTEP_TEST_FILE

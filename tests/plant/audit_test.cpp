// SPDX-License-Identifier: Apache-2.0
// What the energy balance is measured against.
#include "sixstep/plant/audit.hpp"

#include <gtest/gtest.h>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

/// Found by the fuzzer: a load that turns the shaft up and brings it back to rest has given nothing in the
/// sum, and the rounding of what went to and fro was then divided by (almost) nothing.
TEST(Audit, ALoadThatTakesBackWhatItGaveIsAYardstickStill) {
  Board b = Board::duty(0.0);
  b.drive.mode = control::Mode::off;
  b.start.angle_rad = at_electrical_deg(30.0);
  b.shaft.B_Nm_s = 0.0;
  b.shaft.static_Nm = 0.01;  // at rest it stays there
  b.load(0, -0.05);
  b.load(1'000'000'000, 0.009);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 8e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.plant().state().w, 0.0);
  EXPECT_GT(laws.audit().energy().moved, 1e-6);
  laws.expect_all(1e-11);
}

/// Found by the fuzzer: pulses of 1e-22 s moved 1e-34 J, of which not one digit is known.
TEST(Audit, LessEnergyThanANoiseCurrentHoldsIsNotBalanced) {
  Drivetrain setup;
  setup.start.angle_rad = 0.02;
  Held<> bench(setup, a_to_b());
  LawChecker<> laws;
  ASSERT_EQ(sim::run(bench, sim::Instant{0, 1e-9}, laws).stop, sim::Stop::end);
  EXPECT_GT(laws.audit().energy().moved, 0.0);
  EXPECT_LT(laws.audit().energy().moved, 1e-30);
  laws.expect_all(1e-11);
}

}  // namespace

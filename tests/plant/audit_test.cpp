// SPDX-License-Identifier: Apache-2.0
// What the energy balance is measured against.
#include "sixstep/plant/audit.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// Beyond the instant at which a diode's current ends its series goes on with the wrong sign. A watch that
/// sees nothing there would see nothing anywhere.
TEST(Audit, SeesADiodeThatConductsBackwards) {
  for (const bool high : {true, false}) {
    Drivetrain setup;
    setup.shaft.locked = true;
    setup.start.angle_rad = 0.02;
    Held<> bench(setup, a_to_b());
    ASSERT_EQ(bench.run_to(10e-6), sim::Stop::end);
    // One diode beside a switch against the whole bus: into b's upper one, or out of a's lower one.
    bench.plant().set_gates(high ? gates({}, {true, false, false}) : gates({false, true, false}, {}));
    const double i_0 = bench.state().i[0], length = bench.plant().expand(30e-6);
    const double exact =
        i_0 * std::exp(-length / setup.tau()) + 24.0 / setup.R_tt() * std::expm1(-length / setup.tau());
    ASSERT_LT(exact, -0.1);
    plant::Audit<double> audit;
    audit.segment(bench.plant(), 0.2);
    EXPECT_EQ(audit.laws().reverse_diode_A, 0.0) << high;
    audit.segment(bench.plant(), 1.0);
    EXPECT_NEAR(audit.laws().reverse_diode_A, -exact, 32 * eps * i_0) << high;
  }
}

}  // namespace

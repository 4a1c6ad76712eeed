// SPDX-License-Identifier: Apache-2.0
// Dry friction (model.md 1, 4b): the rotor sticks, breaks away in the direction of the larger torque, and
// finally stops.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using sim::Stop;

Drivetrain dry(double coulomb, double breakaway = 0.0) {
  Drivetrain setup;
  setup.shaft.B_Nm_s = 0.0;
  setup.shaft.coulomb_Nm = coulomb;
  setup.shaft.static_Nm = breakaway;
  setup.start.angle_rad = 0.02;  // sector 0: both phases of the pair a, b are on their flat tops
  return setup;
}

TEST(Pitfall08_Sticking, HoldsWhileTheLoadIsWithinIt) {
  for (const double load : {0.0, 0.04, -0.04, 0.05, -0.05}) {
    Held<> bench(dry(0.05), all_off());
    bench.plant().set_load(load);
    ASSERT_EQ(bench.run_to(10e-3), Stop::end);
    EXPECT_EQ(bench.state().w, 0.0) << load;
    EXPECT_EQ(bench.angle(), Held<>(dry(0.05), all_off()).angle());
  }
}

TEST(Pitfall08_Sticking, BreaksAwayInTheDirectionOfTheExcess) {
  for (const double load : {0.06, -0.06}) {
    const Drivetrain setup = dry(0.05);
    Held<> bench(setup, all_off());
    bench.plant().set_load(load);
    LawChecker<> laws;
    ASSERT_EQ(bench.run_to(1e-3, laws), Stop::end);
    // At rest, T_load > 0 also acts in the negative direction.
    const double exact = (load > 0 ? -0.01 : 0.01) / setup.shaft.J_kg_m2 * 1e-3;
    EXPECT_NEAR(bench.state().w, exact, 16 * eps * 0.06 / 0.01 * std::fabs(exact));
    laws.expect_all();
  }
}

TEST(Pitfall08_Sticking, BreakawayInstantIsInClosedForm) {
  for (const double breakaway : {0.0, 0.2}) {
    const Drivetrain setup = dry(0.1, breakaway);
    Held<> bench(setup, a_to_b());
    LawChecker<> laws;
    ASSERT_EQ(bench.run_to(0.4e-3, laws), Stop::end);
    laws.expect_all();
    // The rotor breaks away when 2 K_e i(t) = T (friction torque T), at t = -tau ln(1 - T R_tt/(2 K_e U)).
    const double T = std::max(0.1, breakaway), K_t = 2 * setup.machine.K_e_V_s;
    const double exact = -setup.tau() * std::log1p(-T * setup.R_tt() / (K_t * 24.0));
    ASSERT_GE(bench.events.size(), 1u);
    EXPECT_EQ(bench.events[0].id, plant::guard::breakaway_forward);
    EXPECT_NEAR(bench.events[0].at.seconds(), exact, 32 * eps * setup.tau());
    EXPECT_GT(bench.state().w, 0.0);
  }
}

/// At rest with all legs on switches, only the motion is undecided. If the load exceeds the friction, the
/// rotor moves at once, without a breakaway event.
TEST(Pitfall08_Sticking, ALoadBeyondItIsNoEvent) {
  for (const double load : {0.05, -0.05}) {
    Held<> bench(dry(0.005), all_low());
    bench.plant().set_load(load);
    ASSERT_EQ(bench.run_to(1e-3), Stop::end);
    EXPECT_LT(bench.state().w * load, 0.0);
    EXPECT_TRUE(bench.events.empty()) << load;
  }
}

TEST(Friction, StaticTorqueHoldsWhatSlidingFrictionWouldNot) {
  Held<> held(dry(0.05, 0.08), all_off()), slides(dry(0.05), all_off());
  for (Held<>* bench : {&held, &slides}) {
    bench->plant().set_load(-0.07);
    ASSERT_EQ(bench->run_to(1e-3), Stop::end);
  }
  EXPECT_EQ(held.state().w, 0.0);
  EXPECT_GT(slides.state().w, 0.0);
  held.plant().set_load(-0.09);
  ASSERT_EQ(held.run_to(2e-3), Stop::end);
  EXPECT_NEAR(held.state().w, 0.04 / 1.35e-5 * 1e-3, 64 * eps * 3.0) << "sliding: only T_c0 brakes";
}

TEST(Friction, ASmallerStaticTorqueDoesNotCount) {
  Held<> bench(dry(0.05, 0.01), all_off());
  bench.plant().set_load(-0.04);
  ASSERT_EQ(bench.run_to(1e-3), Stop::end);
  EXPECT_EQ(bench.state().w, 0.0);
}

TEST(Friction, RotorStopsAtTheClosedFormInstantAndStays) {
  for (const double w : {50.0, -50.0}) {
    Drivetrain setup = dry(0.005);
    setup.start.speed_rad_s = w;
    Held<> bench(setup, all_off());
    LawChecker<> laws;
    ASSERT_EQ(bench.run_to(0.3, laws), Stop::end);
    laws.expect_all();
    EXPECT_EQ(bench.state().w, 0.0);
    double stopped = -1;
    int stops = 0;
    for (const auto& e : bench.events)
      if (e.id == plant::guard::standstill) stopped = e.at.seconds(), ++stops;
    EXPECT_EQ(stops, 1);
    const double exact = 50.0 * setup.shaft.J_kg_m2 / 0.005;
    // The error of the speed w is the guard's noise, 64 eps of the speed scale. The error of the time is the
    // error of w divided by T_c/J (friction torque T_c, inertia J).
    EXPECT_NEAR(stopped, exact, 64 * eps * 766.4 * setup.shaft.J_kg_m2 / 0.005);
    const double way = 50.0 * exact / 2;
    EXPECT_NEAR(bench.angle() - 0.02, w > 0 ? way : -way, 1e-12 * way);
  }
}

TEST(Friction, ALoadAboveItTurnsTheRotorBackWithoutAStop) {
  Drivetrain setup = dry(0.005);
  setup.start.speed_rad_s = 20.0;
  Held<> bench(setup, all_off());
  bench.plant().set_load(0.01);
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(50e-3, laws), Stop::end);
  laws.expect_all();
  const double stop_s = 20.0 * setup.shaft.J_kg_m2 / 0.015;
  const double exact = -0.005 / setup.shaft.J_kg_m2 * (50e-3 - stop_s);
  EXPECT_NEAR(bench.state().w, exact, 64 * eps * 766.4 * 4);
}

TEST(Friction, LockedRotorNeedsNone) {
  Drivetrain setup = dry(0.05);
  setup.shaft.locked = true;
  Held<> bench(setup, a_to_b());
  bench.plant().set_load(10.0);
  ASSERT_EQ(bench.run_to(5e-3), Stop::end);
  EXPECT_EQ(bench.state().w, 0.0);
  EXPECT_TRUE(bench.events.empty());
}

/// The fuzzer found this case: a load accelerates a rotor for a picosecond, and the rotor's back-EMF is a few
/// rounding errors. To find the conducting leg, the plant used a larger noise limit. This limit also set the
/// speed to zero, so the rotor neither turned nor was at rest.
TEST(Pitfall05_SnapFirst, ARotorThatHardlyTurnsStillTurns) {
  for (int decade = -130; decade <= -60; ++decade)
    for (const double sign : {1.0, -1.0})
      for (const double deg : {0.0, 19.0, 60.0, 79.0}) {
        Drivetrain setup = dry(0.02);
        setup.start.speed_rad_s = sign * std::pow(10.0, decade / 10.0);
        setup.start.angle_rad = at_electrical_deg(deg);
        Held<> bench(setup, gates({}, {false, false, true}));
        bench.plant().set_load(sign * 0.05);
        LawChecker<> laws;
        ASSERT_EQ(bench.run_to(1e-3, laws), Stop::end) << setup.start.speed_rad_s << " at " << deg;
        EXPECT_LT(sign * bench.state().w, 0.0);
      }
}

}  // namespace SIXSTEP_TEST_FILE

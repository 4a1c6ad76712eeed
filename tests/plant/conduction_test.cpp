// SPDX-License-Identifier: Apache-2.0
// Diodes start to conduct in three cases: at the rails, with a free star point, and at sector edges at which
// two events coincide.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using sim::Stop;

/// The time of the first event with an id in [from, to).
double first_s(const Held<>& bench, int from, int to) {
  for (const auto& e : bench.events)
    if (e.id >= from && e.id < to) return e.at.seconds();
  return -1.0;
}

/// The rotor turns freely from 270 degrees, with the lower switch of a on. The back-EMF e_a is the lowest
/// until 300 degrees. At this angle, the flat bottom of a ends and the flat bottom of b begins.
Drivetrain towards_300_deg() {
  Drivetrain setup;
  setup.shaft.B_Nm_s = 0.0;
  setup.start.speed_rad_s = 400.0;
  setup.start.angle_rad = at_electrical_deg(270.0);
  return setup;
}

TEST(Rail, IdealDiodeConductsFromTheSectorEdgeOn) {
  const Drivetrain setup = towards_300_deg();
  Held<> bench(setup, gates({}, {true, false, false}));
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(0.3e-3, laws), Stop::end);
  laws.expect_all();
  // Two events occur at one instant, and rounding decides which event is first.
  const double edge_s = at_electrical_deg(30.0) / 400.0, bound = 16 * eps * at_electrical_deg(300.0) / 400.0;
  EXPECT_NEAR(first_s(bench, plant::guard::edge_ahead, plant::guard::low_rail), edge_s, bound);
  EXPECT_NEAR(first_s(bench, plant::guard::low_rail, plant::guard::breakaway_forward), edge_s, bound);
  EXPECT_LT(bench.state().i[0], 0.0);
  EXPECT_GT(bench.state().i[1], 0.0) << "b's lower diode carries the loop with a";
}

TEST(Rail, RealDiodeConductsWhereTheEmfReachesItsDrop) {
  Drivetrain setup = towards_300_deg();
  setup.devices.V_f_V = 0.7;
  Held<> bench(setup, gates({}, {true, false, false}));
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(0.3e-3, laws), Stop::end);
  laws.expect_all();
  // On the ramp, e_a - e_b = K_e w (theta - 300 degrees)/30 degrees (back-EMF constant K_e, speed w). The
  // diode conducts when this difference is equal to the drop V_f.
  const double behind_edge = 30.0 * 0.7 / (setup.machine.K_e_V_s * 400.0);
  const double exact = at_electrical_deg(30.0 + behind_edge) / 400.0;
  // Angles near 270 degrees have a relative error of eps. The slope of the ramp adds the error of its terms.
  EXPECT_NEAR(first_s(bench, plant::guard::low_rail, plant::guard::breakaway_forward), exact,
              32 * eps * at_electrical_deg(330.0) / 400.0);
}

/// The lower switch of a connects a, whose back-EMF is the lowest. The back-EMF of b is at its top, so the
/// terminal voltage of b is 2 K_e w. The bus falls to this constant voltage: U_s = V_0 + (U_s(0) - V_0)
/// exp(-t/(R_b C)).
TEST(Rail, AFallingRailMeetsTheTerminalAtTheClosedFormInstant) {
  Drivetrain setup;
  setup.shaft = {.J_kg_m2 = 1e9};
  setup.devices.V_f_V = 0.7;
  setup.supply = {.V_0_V = 24.0, .R_b_ohm = 0.05, .C_F = 1e-3};
  setup.start = {.speed_rad_s = 30.0 / (2 * setup.machine.K_e_V_s),
                 .angle_rad = at_electrical_deg(181.0),
                 .bus_V = 48.0};
  Held<> bench(setup, gates({}, {true, false, false}));
  ASSERT_EQ(bench.run_to(0.1e-3), Stop::end);
  const double RC = 0.05 * 1e-3, left_V = 30.0 - 0.7 - 24.0, exact = RC * std::log(24.0 / left_V);
  const double noise_V = plant::noise_of(bench.plant().constants().volt_scale, 1.0);
  EXPECT_NEAR(first_s(bench, plant::guard::high_rail, plant::guard::floating_star), exact,
              2 * noise_V * RC / left_V + 16 * eps * exact);
}

/// The voltage of the third terminal exceeds the rail by half of the diode's drop. The leg floats from the
/// start, without an event.
TEST(Rail, ATerminalWithinTheDropFloatsAtOnce) {
  for (const bool high : {true, false}) {
    Drivetrain setup;
    setup.devices.V_f_V = 0.7;
    // The terminal of c exceeds the rail by 1.5 K_e w. The back-EMF of c is at its top, of a at its bottom,
    // and of b it is zero. In the second case, all three are mirrored.
    setup.start = {.speed_rad_s = 0.35 / (1.5 * setup.machine.K_e_V_s),
                   .angle_rad = at_electrical_deg(high ? 270.0 : 90.0),
                   .bus_V = 24.0};
    const std::array<bool, 3> both{true, true, false};
    Held<> bench(setup, high ? gates(both, {}) : gates({}, both));
    ASSERT_EQ(bench.run_to(10e-6), Stop::end);
    EXPECT_TRUE(bench.events.empty()) << high;
    EXPECT_EQ(bench.plant().diodes_started(), 0) << high;
    EXPECT_EQ(bench.state().i[2], 0.0) << high;
  }
}

TEST(FloatingStar, ConductsOnlyAboveTheBus) {
  // The voltage 2 K_e w is below or above U_s + 2 V_f by the relative difference 1e-9.
  for (const double V_f : {0.0, 0.7}) {
    for (const double side : {-1e-9, 1e-9}) {
      Drivetrain setup;
      setup.devices.V_f_V = V_f;
      setup.shaft.B_Nm_s = 0.0;
      setup.start.angle_rad = at_electrical_deg(25.0);
      setup.start.speed_rad_s = (24.0 + 2 * V_f) / (2 * setup.machine.K_e_V_s) * (1 + side);
      Held<> bench(setup, all_off());
      LawChecker<> laws;
      ASSERT_EQ(bench.run_to(5e-3, laws), Stop::end);
      laws.expect_all();
      if (side < 0)
        EXPECT_EQ(laws.highest_current_A(), 0.0);
      else
        EXPECT_GT(laws.highest_current_A(), 0.0);
    }
  }
}

TEST(Rectifier, BrakesTheRotorToTheSpeedOfTheBusAndFeedsIt) {
  Drivetrain setup;
  setup.start.speed_rad_s = 900.0;
  Held<> bench(setup, all_off());
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(0.3, laws), Stop::end);
  laws.expect_all();
  const double w_bus = 24.0 / (2 * setup.machine.K_e_V_s);
  EXPECT_LT(bench.state().w, w_bus) << "friction takes the rest";
  EXPECT_LT(laws.audit().energy().supplied, 0.0);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(bench.state().i[k], 0.0);
}

/// Counts the starts of conduction: a leg had no current in one segment, and its diode conducts in the next
/// segment.
struct Starts {
  plant::Legs before{};
  int low = 0, high = 0;
  void segment(const Held<>& bench, double s) {
    if (!(s > 0)) return;
    const plant::Legs& legs = bench.plant().mode().legs;
    for (int k = 0; k < 3; ++k) {
      low += plant::is_floating(before[k]) && legs[k] == plant::Connection::low_diode;
      high += plant::is_floating(before[k]) && legs[k] == plant::Connection::high_diode;
    }
    before = legs;
  }
};

TEST(Rectifier, CountsTheStartsOfUpperAndLowerDiodes) {
  Drivetrain setup;
  setup.start.speed_rad_s = 900.0;
  Held<> bench(setup, all_off());
  Starts starts;
  ASSERT_EQ(bench.run_to(20e-3, starts), Stop::end);
  EXPECT_GT(starts.low, 0);
  EXPECT_GT(starts.high, 0);
  EXPECT_EQ(bench.plant().diodes_started(), starts.low + starts.high);
}

TEST(Rectifier, BackwardsItDoesTheSame) {
  Drivetrain setup;
  setup.start.speed_rad_s = 900.0;
  setup.start.angle_rad = at_electrical_deg(17.0);
  Held<> ahead(setup, all_off());
  // The circuit is the same after a mirroring: theta becomes 300 degrees - theta, w becomes -w, and b and c
  // are exchanged.
  setup.start.speed_rad_s = -900.0;
  setup.start.angle_rad = at_electrical_deg(283.0);
  Held<> back(setup, all_off());
  ASSERT_EQ(ahead.run_to(20e-3), Stop::end);
  ASSERT_EQ(back.run_to(20e-3), Stop::end);
  // The initial angles of the two trajectories differ by eps. The later difference is within the accuracy of
  // the solver.
  EXPECT_NEAR(back.state().w, -ahead.state().w, 1e-12 * 900.0);
  EXPECT_NEAR(back.state().i[0], ahead.state().i[0], 1e-10 * 10.0);
  EXPECT_NEAR(back.state().i[1], ahead.state().i[2], 1e-10 * 10.0);
  EXPECT_NEAR(back.state().i[2], ahead.state().i[1], 1e-10 * 10.0);
  EXPECT_EQ(back.events.size(), ahead.events.size());
}

TEST(Standstill, FreeLegOnTheRailDoesNotConduct) {
  // The devices are ideal, and the rotor is at rest. The voltage of a free terminal is exactly the star
  // point's voltage. This is the rail of the single driven leg, or a voltage between the rails. If it is
  // equal to a rail's voltage, the leg floats.
  Drivetrain setup;
  for (const plant::Gates& g :
       {gates({}, {true, false, false}), gates({true, false, false}, {}), all_off()}) {
    Held<> bench(setup, g);
    ASSERT_EQ(bench.run_to(1e-3), Stop::end);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(bench.state().i[k], 0.0);
    EXPECT_EQ(bench.state().w, 0.0);
    EXPECT_TRUE(bench.events.empty());
  }
}

TEST(Pitfall03_RestartOnABoundary, RotorStartingOnASectorEdgeLeavesOnce) {
  for (int sector = 0; sector < 6; ++sector) {
    // The gates drive the positive pair of the sector that the rotor enters. The current rises in proportion
    // to t, and so does the torque. The rotor therefore leaves the edge slowly, with theta proportional to
    // t^3.
    static constexpr int pair[6][2] = {{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}};
    plant::Gates g;
    g.high[pair[sector][0]] = g.low[pair[sector][1]] = true;
    Drivetrain setup;
    setup.start.angle_rad = sector * base::sector_rad / 8;
    Held<> bench(setup, g);
    ASSERT_EQ(bench.plant().sector(), sector) << "at rest on an edge the sector is the one being entered";
    LawChecker<> laws;
    ASSERT_EQ(bench.run_to(1e-3, laws), Stop::end);
    laws.expect_all();
    EXPECT_GT(bench.state().w, 0.0) << sector;
    EXPECT_TRUE(bench.events.empty()) << sector;
  }
}

TEST(SectorEdge, FirstMotionBackwardsFromZeroMakesItSectorFive) {
  Held<> bench(Drivetrain{}, gates({false, true, false}, {true, false, false}));  // b to a: backwards
  ASSERT_EQ(bench.run_to(1e-3), Stop::end);
  EXPECT_LT(bench.state().w, 0.0);
  EXPECT_EQ(bench.plant().sector(), 5);
  ASSERT_EQ(bench.events.size(), 1u);
  EXPECT_EQ(bench.events[0].id, plant::guard::edge_behind);
  EXPECT_EQ(bench.events[0].at, sim::Instant{});
}

}  // namespace SIXSTEP_TEST_FILE

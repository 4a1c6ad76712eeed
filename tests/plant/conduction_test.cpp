// SPDX-License-Identifier: Apache-2.0
// Diodes start to conduct at the rails, with a free star, and at sector edges with two events at once.
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

/// The rotor turns freely from 270 degrees with a's lower switch on. e_a is the lowest back-EMF until 300
/// degrees, where b's flat bottom begins and a's ends.
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
  // Two events occur at one instant: rounding decides which is first.
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
  // On the ramp, e_a - e_b = K_e w (theta - 300)/30. The diode conducts when this is equal to V_f.
  const double behind_edge = 30.0 * 0.7 / (setup.machine.K_e_V_s * 400.0);
  const double exact = at_electrical_deg(30.0 + behind_edge) / 400.0;
  // The relative error of angles of 270 degrees is eps each. The ramp's slope adds the error of its terms.
  EXPECT_NEAR(first_s(bench, plant::guard::low_rail, plant::guard::breakaway_forward), exact,
              32 * eps * at_electrical_deg(330.0) / 400.0);
}

/// a's lower switch connects a, whose EMF is the lowest, while b's EMF is at its top: b's terminal voltage is
/// 2 K_e w. The bus falls to this constant voltage: U_s = V_0 + (U_s(0) - V_0) exp(-t/(R_b C)).
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

/// The third terminal is beyond the rail by half of the diode's voltage drop. The leg floats from the start,
/// without an event.
TEST(Rail, ATerminalWithinTheDropFloatsAtOnce) {
  for (const bool high : {true, false}) {
    Drivetrain setup;
    setup.devices.V_f_V = 0.7;
    // The terminal of c, whose EMF is at its top, is 1.5 K_e w beyond the rail; a's EMF is at its bottom, and
    // b's is zero. In the second case, all three are mirrored.
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
  // 2 K_e w is below and above U_s + 2 V_f by a relative 1e-9.
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

/// Counts the legs that had no current in one segment and have a conducting diode in the next segment.
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
  // theta -> 300 degrees - theta, w -> -w, and b and c exchanged give the same circuit.
  setup.start.speed_rad_s = -900.0;
  setup.start.angle_rad = at_electrical_deg(283.0);
  Held<> back(setup, all_off());
  ASSERT_EQ(ahead.run_to(20e-3), Stop::end);
  ASSERT_EQ(back.run_to(20e-3), Stop::end);
  // The two trajectories start with angles that differ by eps. The solver's accuracy bounds their difference
  // later.
  EXPECT_NEAR(back.state().w, -ahead.state().w, 1e-12 * 900.0);
  EXPECT_NEAR(back.state().i[0], ahead.state().i[0], 1e-10 * 10.0);
  EXPECT_NEAR(back.state().i[1], ahead.state().i[2], 1e-10 * 10.0);
  EXPECT_NEAR(back.state().i[2], ahead.state().i[1], 1e-10 * 10.0);
  EXPECT_EQ(back.events.size(), ahead.events.size());
}

TEST(Standstill, FreeLegOnTheRailDoesNotConduct) {
  // The devices are ideal and the rotor is at rest. A free terminal has exactly the star point's voltage: the
  // rail of the one driven leg, or a voltage between the rails. If the voltage is equal to a rail's, the leg
  // floats.
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
    // The gates are those of the positive pair of the sector that the rotor enters, so the rotor leaves the
    // edge as theta ~ t^3.
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

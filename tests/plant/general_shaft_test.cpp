// SPDX-License-Identifier: Apache-2.0
// Loads and gears of the general kernel are compared with closed forms (model.md 7). The kernels use none of
// these formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/plant/general/audit.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double digits = 1e-12;
constexpr double J = 1.35e-5;

GeneralSetup free_rotor(double speed_rad_s) {
  GeneralSetup s;
  s.shaft.B_Nm_s = 0;
  s.start.speed_rad_s = speed_rad_s;
  return s;
}

TEST(GeneralShaft, ALoadThatRisesInTimeSlowsTheRotorAlongAParabola) {
  HeldGeneral held(free_rotor(30));
  held.plant().set_load(1e-4, 0.02);
  for (const double t : {1e-3, 0.02, 0.1}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().w, 30 - (1e-4 * t + 0.01 * t * t) / J, digits * 30);
  }
}

TEST(GeneralShaft, ATorqueOverTheSpeedIsALineBetweenItsPoints) {
  GeneralSetup s = free_rotor(50);
  s.shaft.load.over_speed = {{-10, -1e-4}, {10, 1e-4}, {30, 5e-4}};
  HeldGeneral held(s);
  // Above 30 rad/s, the load is constant. Its slope is 2e-5 N m s from 30 to 10 rad/s, and 1e-5 N m s through
  // zero.
  const double level = 20 * J / 5e-4, sloped = J / 2e-5 * std::log(5e-4 / 1e-4);
  for (const double t : {level / 2, level, level + sloped / 3, level + sloped}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const double w = t <= level ? 50 - 5e-4 / J * t : 5 + 25 * std::exp(-(t - level) * 2e-5 / J);
    EXPECT_NEAR(held.plant().state().w, w, 1e-9) << t;
  }
  const double left = 1.0;
  ASSERT_EQ(run_to(held, level + sloped + left), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().w, 10 * std::exp(-left * 1e-5 / J), 1e-9);
}

TEST(GeneralShaft, AGearWithLossesTakesMoreFromTheSideThatDrives) {
  GeneralSetup s = free_rotor(12);
  const double n = 4, J2 = 6e-5, eta = 0.7, load = 2e-3;
  s.shaft.gear = n;
  s.shaft.efficiency = eta;
  s.shaft.load_J_kg_m2 = J2;
  s.shaft.load.torque_Nm = load;
  HeldGeneral held(s);
  // The inertia of the load drives the shaft until standstill. Then the torque of the load drives the shaft
  // backwards.
  const double slows = load / n / eta / (J + J2 / (n * n) / eta), stands = 12 / slows;
  ASSERT_EQ(run_to(held, stands / 2), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().w, 6, 1e-9);
  const double backs = load / n * eta / (J + J2 / (n * n) * eta);
  ASSERT_EQ(run_to(held, 2 * stands), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().w, -backs * stands, 1e-8);
}

TEST(GeneralShaft, AGearWithLossesHoldsALoadThatCannotDriveIt) {
  GeneralSetup s = free_rotor(0);
  s.shaft.gear = 5;
  s.shaft.efficiency = 0.5;
  s.shaft.load.torque_Nm = 2e-3;
  s.shaft.coulomb_Nm = 3e-4;  // more than the load's torque behind the gear with its loss, 2e-3/5 * 0.5
  HeldGeneral held(s);
  ASSERT_EQ(run_to(held, 0.1), sim::Stop::end);
  EXPECT_EQ(held.plant().state().w, 0);
  held.plant().set_load(4e-3);
  ASSERT_EQ(run_to(held, 0.2), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().w, -(4e-3 / 5 * 0.5 - 3e-4) / J * 0.1, 1e-9);
}

/// An almost zero load drives the shaft for picoseconds, then the motor drives it. In an earlier version, the
/// trial state of a rotor at rest and the turning rotor had different signs of the gear's loss. Both states
/// therefore alternated at one instant without end.
TEST(GeneralShaft, ALossyGearStartsAgainstNextToNoLoad) {
  for (const double load : {-1e-6, -1e-8, -1e-10, 1e-8}) {
    GeneralSetup s;
    s.shaft.gear = 20;
    s.shaft.efficiency = 0.6;
    s.shaft.load_J_kg_m2 = 1e-3;
    s.shaft.load = {.torque_Nm = load};
    auto rig = general_rig(s, Board::duty(0.4));
    ASSERT_EQ(run_to(rig, 5e-3), sim::Stop::end) << load;
    EXPECT_GT(rig.plant().state().w, 1) << load;
  }
}

TEST(GeneralShaft, ALossyGearOnAnElasticShaftKeepsTheBooks) {
  GeneralSetup s;
  s.shaft.gear = 3;
  s.shaft.efficiency = 0.8;
  s.shaft.load_J_kg_m2 = 2e-4;
  s.shaft.stiffness_Nm = 3;
  s.shaft.damping_Nm_s = 1e-3;
  s.shaft.coulomb_Nm = 1e-3;
  s.shaft.load = {.torque_Nm = 0.02, .gravity_Nm = 0.03};
  Board board = Board::duty(0.4);
  board.load(20'000'000'000, -0.05);
  auto rig = general_rig(s, board);
  general::Audit<double> audit;
  struct Watch {
    general::Audit<double>& audit;
    void segment(const GeneralRig& rig, double to) { audit.segment(rig.plant(), to); }
  } watch{audit};
  const sim::Run run = sim::run(rig, sim::to_instant(0.05), watch);
  ASSERT_EQ(run.stop, sim::Stop::end);
  EXPECT_LT(std::fabs(audit.energy().mechanical_residual), 1e-12);
  EXPECT_LT(std::fabs(audit.energy().electrical_residual), 1e-12);
  EXPECT_GT(audit.energy().friction, 0);
}

TEST(GeneralShaft, ADynamometerSaysTheSpeedAndTheTorqueIsWhatIsLeft) {
  GeneralSetup s;
  s.shaft.dynamometer = true;
  s.shaft.gear = 2;
  s.shaft.load_J_kg_m2 = 4e-5;
  s.shaft.coulomb_Nm = 2e-3;
  HeldGeneral held(s);
  held.plant().set_speed(-10, 400);  // passes zero at 25 ms
  ASSERT_EQ(run_to(held, 0.01), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().w, 2 * (-10 + 4), 1e-12);
  ASSERT_EQ(run_to(held, 0.075), sim::Stop::end);
  const auto& plant = held.plant();
  EXPECT_NEAR(plant.state().w, 2 * 20, 1e-11);
  const double angle = (static_cast<double>(plant.state().sector) * base::sector_rad + plant.state().x) / 8;
  EXPECT_NEAR(angle, 2 * (-10 * 0.075 + 200 * 0.075 * 0.075), 1e-12);
  // No current flows. Inertia, viscous friction and dry friction act on the dynamometer, on its side of the
  // gear.
  const double at_start = plant.expansion().w[0];
  EXPECT_NEAR(plant.series().load[0], -2 * ((J + 1e-5) * 800 + 7.3e-6 * at_start + 2e-3), 1e-12);
}

TEST(GeneralShaft, ADynamometerOnAnElasticShaftKeepsTheBooks) {
  GeneralSetup s;
  s.shaft.dynamometer = true;
  s.shaft.load_J_kg_m2 = 4e-5;
  s.shaft.stiffness_Nm = 1.5;
  Board board = Board::duty(0.5);
  auto rig = general_rig(s, board);
  const_cast<general::Plant<double>&>(rig.plant()).set_speed(0, 3000);
  general::Audit<double> audit;
  struct Watch {
    general::Audit<double>& audit;
    void segment(const GeneralRig& rig, double to) { audit.segment(rig.plant(), to); }
  } watch{audit};
  ASSERT_EQ(sim::run(rig, sim::to_instant(0.03), watch).stop, sim::Stop::end);
  EXPECT_NEAR(rig.plant().more().load_w.value, 90, 1e-10);
  EXPECT_LT(std::fabs(audit.energy().mechanical_residual), 1e-12);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The temperatures of winding and housing (model.md (11)) and of the switches' junctions are compared with a
// separate integration, and with closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/plant/general/heat.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

general::HeatGiven warm_motor() {
  return {.motor = true,
          .winding_housing_K_W = 4.5,
          .housing_ambient_K_W = 4.25,
          .winding_s = 17.7,
          .motor_s = 212,
          .ambient_degC = 20,
          .winding_degC = 40,
          .housing_degC = 30,
          .copper_per_K = 0.00393,
          .magnet_per_K = -0.0012,
          .own_coulomb_Nm = 2e-3,
          .own_B_Nm_s = 1e-5};
}

TEST(GeneralHeat, TwoBodiesUnderSteadyPowersAreSolvedExactlyInStepsOfAnyLength) {
  const auto given = warm_motor();
  const double copper_W = 8, w = 300, friction_W = 1e-5 * w * w + 2e-3 * w;
  // The reference integrates equation (11) by the classical fourth-order method in small steps.
  double T_w = 40, T_h = 30;
  const double C_w = 17.7 / 4.5, C_h = 212 / 4.25, dt = 0.01;
  const auto slope = [&](double tw, double th) {
    const double across = (tw - th) / 4.5;
    return std::pair{(copper_W - across) / C_w, (friction_W + across - (th - 20) / 4.25) / C_h};
  };
  for (int n = 0; n < 3000; ++n) {
    const auto [a1, b1] = slope(T_w, T_h);
    const auto [a2, b2] = slope(T_w + dt / 2 * a1, T_h + dt / 2 * b1);
    const auto [a3, b3] = slope(T_w + dt / 2 * a2, T_h + dt / 2 * b2);
    const auto [a4, b4] = slope(T_w + dt * a3, T_h + dt * b3);
    T_w += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    T_h += dt / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
  }
  for (const int steps : {1, 3, 1000}) {
    general::Heat heat(given);
    for (int n = 0; n < steps; ++n) {
      const double t = 30.0 / steps;
      heat.add({t, copper_W * t, w * w * t, -w * t});
      ASSERT_TRUE(heat.due());
      heat.take_step();
    }
    EXPECT_NEAR(heat.bodies_degC().winding, T_w, 1e-8) << steps;
    EXPECT_NEAR(heat.bodies_degC().housing, T_h, 1e-8) << steps;
  }
}

TEST(GeneralHeat, ResistanceAndBackEmfFollowTheirTemperatures) {
  GeneralSetup s;
  s.start.speed_rad_s = 50;
  general::Plant<double> plant(s.machine, s.shaft, s.devices, s.supply, s.start, warm_motor());
  EXPECT_NEAR(plant.constants().R[0], 0.515 * (1 + 0.00393 * 15), 1e-15);
  ASSERT_GT(plant.expand(1e-5), 0);
  EXPECT_NEAR(plant.at(0.0).emf[0], 0.01675 * 50 * (1 - 0.0012 * 5), 1e-14);
}

TEST(GeneralHeat, MagnetsDoNotTurnRoundWhereTheirLineCrossesNothing) {
  const auto on_K_e = [](double housing_degC) {
    return general::Heat({.motor = true, .housing_degC = housing_degC, .magnet_per_K = -0.01}).on_K_e();
  };
  EXPECT_NEAR(on_K_e(100), 0.25, 1e-15);
  EXPECT_EQ(on_K_e(125), sixstep::plant::least_on_K_e);
  EXPECT_EQ(on_K_e(200), sixstep::plant::least_on_K_e);
}

TEST(GeneralHeat, AJunctionIsAsWarmAsItsOwnSwitchLoses) {
  GeneralSetup s;
  s.shaft.locked = true;
  s.devices = {.R_on_ohm = 0.05};
  general::Plant<double> plant(s.machine, s.shaft, s.devices, s.supply, s.start,
                               {.devices = true, .sink_degC = 40, .junction_K_W = 3, .on_per_K = 0.006});
  EXPECT_NEAR(plant.constants().terms(0, sixstep::plant::Connection::high_switch).r_ohm,
              0.05 * (1 + 0.006 * 15), 1e-16);
  class Held : public HeldGeneral {
   public:
    Held(const GeneralSetup& setup, const general::HeatGiven& heat) : HeldGeneral(setup) {
      plant_ =
          general::Plant<double>(setup.machine, setup.shaft, setup.devices, setup.supply, setup.start, heat);
      plant_.set_gates(a_to_b());
    }
  } hot(s, {.devices = true, .sink_degC = 40, .junction_K_W = 3, .on_per_K = 0.006});
  // In steps of a millisecond, R_on = 0.05 (1 + 0.006 (T - 25)), T = 40 + 3 R_on I^2 and I = U/(1.03 + 2
  // R_on) (on-resistance R_on, junction temperature T).
  for (int ms = 1; ms <= 60; ++ms) {
    ASSERT_EQ(run_to(hot, ms * 1e-3), sim::Stop::end);
    hot.plant().take_thermal_step();
  }
  double R_on = 0.05;
  for (int n = 0; n < 200; ++n) {
    const double I = 24 / (1.03 + 2 * R_on);
    R_on = 0.05 * (1 + 0.006 * (15 + 3 * R_on * I * I));
  }
  const auto& c = hot.plant().constants();
  EXPECT_NEAR(c.terms(0, sixstep::plant::Connection::high_switch).r_ohm, R_on, 1e-9);
  EXPECT_NEAR(c.terms(1, sixstep::plant::Connection::low_switch).r_ohm, R_on, 1e-9);
  EXPECT_NEAR(c.terms(2, sixstep::plant::Connection::low_switch).r_ohm, 0.05 * 1.09, 1e-12)
      << "carries nothing";
}

}  // namespace SIXSTEP_TEST_FILE

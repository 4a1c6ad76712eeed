// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// Each test runs in both kernels. A gear with losses selects the general kernel.
class Clamp : public ::testing::TestWithParam<bool> {
 protected:
  static study::Scenario coasting() {
    study::Scenario s = maxon_scenario(control::Mode::off, 0.0);
    if (GetParam()) {
      s.load.gear = 2.0;
      s.load.gear_efficiency = 0.8;
    }
    return s;
  }
};
INSTANTIATE_TEST_SUITE_P(Kernels, Clamp, ::testing::Bool());

/// A random scenario found this case: the clamp grips and releases at one instant. No segment is clamped, but
/// the kinetic energy is dissipated.
TEST_P(Clamp, ThatLetsGoAtTheInstantItGripsHasTheKineticEnergyInTheBook) {
  study::Scenario s = coasting();
  s.initial.speed_rad_s = 60.0;
  for (const bool locked : {true, false}) {
    study::At at;
    at.time_s = 5e-3;
    at.load.locked = locked;
    s.at.push_back(at);
  }
  const auto outcome = study::run(s);
  ASSERT_TRUE(outcome);
  const double J = outcome->motor.shaft.J_kg_m2;
  EXPECT_NEAR(outcome->energy->friction, J * 60.0 * 60.0 / 2, 1e-3 * J * 60.0 * 60.0);
  EXPECT_LT(std::fabs(outcome->energy->mechanical_residual), 1e-13);
}

/// Random scenarios found this case: only the cogging torque of the magnets does work on the rotor, and the
/// clamp dissipates this energy.
TEST(ClampOnCogging, TakesWhatTheMagnetsGaveARotorFromRest) {
  study::Scenario s = maxon_scenario(control::Mode::off, 0.0);
  s.sheet.cogging_orders = {48};
  s.sheet.cogging_mNm = {5};
  s.initial.angle_rad = 0.03;
  study::At at;
  at.time_s = 0.5e-3;
  at.load.locked = true;
  s.at.push_back(at);
  s.duration_s = 1e-3;
  const auto outcome = study::run(s);
  ASSERT_TRUE(outcome);
  EXPECT_GT(outcome->energy->friction, 1e-8);
  EXPECT_NEAR(outcome->energy->kinetic, -outcome->energy->friction, 1e-3 * outcome->energy->friction);
  EXPECT_GT(outcome->energy->moved, 0.5 * outcome->energy->friction);
  EXPECT_LT(std::fabs(outcome->energy->mechanical_residual), 1e-13);
}

}  // namespace SIXSTEP_TEST_FILE

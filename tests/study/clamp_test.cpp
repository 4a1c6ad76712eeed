// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenarios.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

/// Found by a drawn scenario: no segment is clamped, and yet the kinetic energy is gone.
TEST(Clamp, ThatLetsGoAtTheInstantItGripsHasTheKineticEnergyInTheBook) {
  study::Scenario s = maxon_scenario(control::Mode::off, 0.0);
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

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// How long a series is: until its terms are nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/maxon.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

/// Locked rotor: i ~ 1 - exp(-t/tau), asked for over more than one series can hold.
TEST(Series, OneThatIsTooLongIsHalvedUntilItsLastTwoTermsAreNothing) {
  Drivetrain setup;
  setup.shaft.locked = true;
  setup.start.angle_rad = 0.02;
  const plant::Plant<double> rotor = setup.plant();
  const plant::Constants<double>& c = rotor.constants();
  const plant::Mode mode{
      .legs = {plant::Connection::high_switch, plant::Connection::low_switch, plant::Connection::floating},
      .motion = plant::Motion::locked};
  int halved = 0;
  for (double taus = 0.5; taus < 8.0; taus += 1.0 / 512) {
    plant::Expansion<double> y{};
    plant::expand(c, rotor.state(), mode, taus * setup.tau(), y);
    // Nothing: both legs' terms together below one part in 2^53 of the natural scale.
    const auto size = [&](int n) { return 2 * std::fabs(y.i[0][n]) * c.amp_limit; };
    EXPECT_LE(size(y.degree), 1.0) << taus;
    if (y.h == taus * setup.tau()) continue;
    ++halved;
    EXPECT_LE(size(y.degree - 1), 1.0) << taus;
    const double exact = -24.0 / setup.R_tt() * std::expm1(-y.h / setup.tau());
    EXPECT_NEAR(series::evaluate(y.i[0], y.degree, 1.0), exact, 8 * eps * exact) << taus;
  }
  EXPECT_GT(halved, 0);
}

}  // namespace

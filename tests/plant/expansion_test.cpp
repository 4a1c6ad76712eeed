// SPDX-License-Identifier: Apache-2.0
// How long a series is: until its terms are nothing, not until one of them happens to be.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

/// Hardly any resistance, and a torque that begins with zero at the edge where b's bottom begins and a's
/// ends: a load pulls, x ~ t^2, i ~ t, and torque and EMF bring i and w the orders 1, 4, 7, 10 alone. A
/// series that stops at the first zero after the seventh leaves out what the energy balance misses.
TEST(Series, ASymmetrysZeroIsNotTheirEnd) {
  Drivetrain setup;
  setup.machine = {.R_ohm = 1e-9, .L_H = 1e-3, .K_e_V_s = 0.01, .pole_pairs = 1};
  setup.shaft = {.J_kg_m2 = 1e-7};
  setup.start.angle_rad = 5 * base::sector_rad;
  Held<> bench(setup, a_to_b());
  bench.plant().set_load(-0.02);
  LawChecker<> laws;
  ASSERT_EQ(bench.run_to(1e-3, laws), sim::Stop::end);
  EXPECT_GT(bench.state().w, 0.0);
  laws.expect_all();
}

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
    // Nothing: what follows is, both legs together, below one part in 2^53 of the natural scale; of this
    // exponential each term is h/(n tau) of the one before.
    const auto size = [&](int n) { return 2 * std::fabs(y.i[0][n]) * c.amp_limit; };
    EXPECT_LE(size(y.degree) * y.h / setup.tau() / (y.degree + 1), 1.0) << taus;
    if (y.h == taus * setup.tau()) continue;
    ++halved;
    EXPECT_LE(size(y.degree - 1), 1.0) << taus;
    const double exact = -24.0 / setup.R_tt() * std::expm1(-y.h / setup.tau());
    EXPECT_NEAR(series::evaluate(y.i[0], y.degree, 1.0), exact, 8 * eps * exact) << taus;
  }
  EXPECT_GT(halved, 0);
}

}  // namespace

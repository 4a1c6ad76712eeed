// SPDX-License-Identifier: Apache-2.0
// The rail guards of a sine machine are equally exact with and without current. Only currents, speed and bus
// determine the length of the power series. Without a current, the series would end at order 3 and truncate
// cos x.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The rotor turns freely from 290 degrees, with the lower switch of a on. The diode conducts when e_a - e_b
/// = K_e w sqrt 3 sin(theta - 300 deg) reaches the drop V_f. This instant has a closed form, because no
/// current flows before it and w is constant without friction.
TEST(SineGuards, DiodeConductsWhereTheEmfReachesItsDropWithoutCurrentToo) {
  for (const double V_f : {0.35, 0.7, 1.4, 2.8}) {
    Drivetrain d;
    d.machine.back_emf = plant::BackEmf::sine;
    d.shaft.B_Nm_s = 0.0;
    d.devices.V_f_V = V_f;
    d.start.speed_rad_s = 400.0;
    d.start.angle_rad = at_electrical_deg(290.0);
    Held<> bench(d, gates({}, {true, false, false}));
    ASSERT_EQ(bench.run_to(0.3e-3), sim::Stop::end);
    const double behind = std::asin(V_f / (d.machine.K_e_V_s * 400.0 * std::sqrt(3.0)));
    const double exact = (10.0 * base::pi / 180.0 + behind) / (8 * 400.0);
    double found = -1;
    for (const auto& e : bench.events)
      if (e.id == plant::guard::low_rail + 1 && found < 0) found = e.at.seconds();
    EXPECT_NEAR(found, exact, 64 * eps * at_electrical_deg(330.0) / 400.0) << V_f;
  }
}

}  // namespace SIXSTEP_TEST_FILE

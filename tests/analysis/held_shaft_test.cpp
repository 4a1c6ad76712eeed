// SPDX-License-Identifier: Apache-2.0
// The check of docs/howto/flash-an-image.md measures the torque of the held shaft at twelve angles of an
// electrical turn. These torques distinguish straight wires from all other wirings, for any first angle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/wiring/driven.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;

constexpr double pi = 3.14159265358979323846;

double trapezoid(double deg) {
  return std::clamp((90 - std::fabs(std::remainder(deg - 60, 360.0))) / 30, -1.0, 1.0);
}
double sine(double deg) { return std::cos((deg - 60) * pi / 180); }

/// Least and largest torque per ampere, relative to K_e of a phase, at `places` equally spaced angles of an
/// electrical turn. The first angle is `first_deg`.
std::pair<double, double> pulls(const rig::Wiring& wiring, double (*emf)(double), double first_deg,
                                int places) {
  double least = 1e9, most = -1e9;
  for (int n = 0; n < places; ++n) {
    const double deg = first_deg + 360.0 / places * n;
    const analysis::Driven pair =
        analysis::driven(wiring, static_cast<std::uint8_t>(static_cast<int>(deg / 60) % 6));
    const double pull = emf(deg - 120.0 * static_cast<double>(pair.source)) -
                        emf(deg - 120.0 * static_cast<double>(pair.sink));
    least = std::min(least, pull);
    most = std::max(most, pull);
  }
  return {least, most};
}

TEST(HeldShaft, TwelvePlacesSeparateStraightWires) {
  for (double (*emf)(double) : {trapezoid, sine})
    for (const rig::Wiring& wiring : analysis::all_wirings()) {
      const bool straight = analysis::sectors_ahead(wiring) == 0;
      for (double first_deg = 0.25; first_deg < 60; first_deg += 0.5) {
        const auto [least, most] = pulls(wiring, emf, first_deg, 12);
        if (straight)
          EXPECT_GT(least, 0.86 * most) << first_deg;
        else
          EXPECT_LT(least, 0.59 * most) << first_deg;
      }
    }
}

/// At six angles, each in the middle of a sector, a pair that is one sector early has the same torque at each
/// angle: half of the torque with straight wires. Six angles therefore do not reveal the fault.
TEST(HeldShaft, SixPlacesDoNotShowAnEarlyPair) {
  const rig::Wiring early{.phases = rig::WireOrder::bac, .probes = rig::WireOrder::bac};
  ASSERT_TRUE(analysis::sectors_ahead(early));
  ASSERT_NE(analysis::sectors_ahead(early), 0);
  const auto [least, most] = pulls(early, trapezoid, 30, 6);
  EXPECT_NEAR(least, most, 1e-12);
  EXPECT_NEAR(most, 1.0, 1e-12);  // with straight wires: 2
}

}  // namespace SIXSTEP_TEST_FILE

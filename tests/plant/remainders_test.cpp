// SPDX-License-Identifier: Apache-2.0
// Tests values below the last bit of a double: the remainders of compensated sums, and states so small that
// the plant could treat them as noise.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

Drivetrain rectifying() {
  Drivetrain setup;
  setup.start.speed_rad_s = 900.0;  // 2 K_e w = 30.15 V: two and three diodes conduct alternately
  return setup;
}

/// The sum of the remainders (i_low) of the three currents. `beyond_rounding` is the part that exceeds the
/// rounding error.
struct Sums {
  double beyond_rounding = 0, largest = 0;
  int with_three = 0;
  template <class System>
  void segment(const System& system, double) {
    const auto& low = system.state().i_low;
    const double size = std::fabs(low[0]) + std::fabs(low[1]) + std::fabs(low[2]);
    beyond_rounding = std::fmax(beyond_rounding, std::fabs(low[0] + low[1] + low[2]) - eps * size);
    largest = std::fmax(largest, size);
    with_three += plant::connected_count(system.plant().mode().legs) == 3;
  }
};

TEST(Remainders, OfTheCurrentsSumToZeroAsTheCurrentsDo) {
  Held<> bench(rectifying(), all_off());
  Sums sums;
  ASSERT_EQ(bench.run_to(20e-3, sums), sim::Stop::end);
  EXPECT_GT(sums.largest, 0.0);
  EXPECT_GT(sums.with_three, 0);
  EXPECT_LE(sums.beyond_rounding, 0.0);
}

/// Checks that the angle is zero after the rotor has passed an edge.
struct Edges {
  int passed = 0;
  std::size_t seen = 0;
  template <class System>
  void segment(const System& system, double) {
    if (system.events.size() == seen) return;
    seen = system.events.size();
    if (system.events.back().id != plant::guard::edge_ahead) return;
    ++passed;
    EXPECT_EQ(system.state().x, 0.0);
    EXPECT_EQ(system.state().x_low, 0.0);
  }
};

TEST(Remainders, AnEdgeSetsTheAngleAndLeavesNone) {
  Held<> bench(rectifying(), all_off());
  Edges edges;
  ASSERT_EQ(bench.run_to(5e-3, edges), sim::Stop::end);
  EXPECT_GT(edges.passed, 10);
}

/// A current through switches may be arbitrarily small. The plant sets a current below the noise to zero only
/// if a diode could carry it.
TEST(Remainders, ACurrentThroughSwitchesIsNeverTakenForNone) {
  Drivetrain setup;
  setup.start.angle_rad = 0.02;
  Held<> bench(setup, a_to_b());
  sim::NoObserver none;
  for (int n = 1; n <= 3; ++n) {
    ASSERT_EQ(sim::run(bench, sim::Instant{0, n * 0x1p-20}, none).stop, sim::Stop::end);
    const double t = n * 0x1p-20 / sim::ticks_per_second;
    const double exact = -24.0 / setup.R_tt() * std::expm1(-t / setup.tau());
    ASSERT_LT(exact, plant::noise_of(bench.plant().constants().amp_scale, 1.0));
    EXPECT_NEAR(bench.state().i[0], exact, 8 * eps * exact);
    bench.plant().set_load(0.0);  // the plant determines the mode again
  }
}

}  // namespace SIXSTEP_TEST_FILE

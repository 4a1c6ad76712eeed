// SPDX-License-Identifier: Apache-2.0
// The gates switch at random, which no modulator does. The plant must still find a consistent mode, and every
// law must be obeyed.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/laws.hpp"
#include "tests/support/maxon.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr std::uint32_t seed = 77;

plant::Gates drawn_gates(std::mt19937_64& random) {
  plant::Gates g;
  for (int k = 0; k < 3; ++k) {
    const auto state = random() % 3;
    g.high[k] = state == 1;
    g.low[k] = state == 2;
  }
  return g;
}

Drivetrain drawn_drivetrain(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Drivetrain d;
  if (random() % 2 == 0) d.devices = {0.02 * unit(random), 0.9 * unit(random), 0.02 * unit(random)};
  if (random() % 3 == 0) d.machine.flat_deg = 20 + 150 * unit(random);
  if (random() % 3 == 0) {
    d.supply = {.V_0_V = 24.0, .R_b_ohm = 0.05 + 0.3 * unit(random), .C_F = 1e-4 + 1e-3 * unit(random)};
    d.supply.sinks = random() % 2 == 0;
  }
  if (random() % 2 == 0) d.shaft.coulomb_Nm = 0.03 * unit(random);
  if (random() % 3 != 0) d.start.speed_rad_s = 1600 * unit(random) - 800;
  d.start.angle_rad =
      random() % 3 == 0 ? base::sector_rad / 8 * static_cast<double>(random() % 6) : unit(random);
  return d;
}

TEST(RandomGates, TheLawsHold) {
  for (int n = 0; n < 400; ++n) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " motor " << n);
    std::mt19937_64 random{seed + static_cast<std::uint32_t>(1000 * n)};
    Held<> bench(drawn_drivetrain(random), all_off());
    LawChecker<> laws;
    double t = 0;
    for (int k = 0; k < 60; ++k) {
      ASSERT_TRUE(bench.plant().set_gates(drawn_gates(random)));
      if (random() % 10 == 0) bench.plant().set_load(0.1 * (static_cast<double>(random() % 3) - 1));
      t += 1e-9 * static_cast<double>(random() % 4 == 0 ? random() % 100 : random() % 60000);
      ASSERT_EQ(bench.run_to(t, laws), sim::Stop::end) << "after " << bench.now().seconds() << " gates " << k;
    }
    laws.expect_all();
  }
}

}  // namespace SIXSTEP_TEST_FILE

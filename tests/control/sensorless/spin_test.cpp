// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/spin.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/control/sensorless/terminals.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using namespace sixstep::testing;

constexpr SpinConfig config{.threshold = 12, .crossings = 4, .listen_ticks = 1000000};

TEST(Spin, FindsSectorDirectionAndTimeOfEveryCrossingBothWays) {
  const unsigned seed = 99;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int n = 0; n < 400; ++n) {
    const double sense = n % 2 == 0 ? 1.0 : -1.0, emf = sense * (60 + 700 * part(draw));
    const double T = 4000 + 40000 * part(draw), period = T / (6 + 30 * part(draw)),
                 from_deg = 360 * part(draw);
    const std::uint32_t origin = static_cast<std::uint32_t>(draw());
    SpinState state;
    CommutationClockState clock;
    spin_begin(state, origin);
    int crossings = 0;
    for (double t = 0; t < 9 * T; t += period) {
      const double deg = from_deg + sense * 60 * t / T;
      const SpinReading r =
          spin_step(config, state, clock, coasting_sample(deg, emf, origin + static_cast<std::uint32_t>(t)));
      if (!r.crossed) continue;
      ++crossings;
      EXPECT_EQ(r.direction, sense) << "seed " << seed << " draw " << n;
      const double crossed_deg = from_deg + sense * 60 * static_cast<double>(r.at - origin) / T;
      // The threshold is 4 counts of the back-EMF e, which changes by `emf` in 30 degrees. At the first
      // sample, the rotor may be beyond the crossing by the angle of this threshold.
      EXPECT_NEAR(std::remainder(crossed_deg - (60.0 * r.sector + 30.0), 360.0), 0.0,
                  0.5 + 120.0 / std::fabs(emf))
          << "seed " << seed << " draw " << n;
    }
    EXPECT_GE(crossings, 7);
    EXPECT_TRUE(spin_found(config, state));
    EXPECT_NEAR(sector_ticks({2}, clock), T, 0.03 * T);
  }
}

TEST(Spin, NoiseOfARotorThatStandsIsNone) {
  const unsigned seed = 5;
  std::mt19937 draw(seed);
  SpinState state;
  CommutationClockState clock;
  spin_begin(state, 0);
  for (std::uint32_t n = 0; n < 5000; ++n) {
    TerminalSample s = coasting_sample(0, 0, n);
    for (auto& u : s.u) u = static_cast<std::uint16_t>(u + draw() % 5 - 2);
    EXPECT_FALSE(spin_step(config, state, clock, s).crossed);
  }
  EXPECT_FALSE(spin_found(config, state));
}

}  // namespace SIXSTEP_TEST_FILE

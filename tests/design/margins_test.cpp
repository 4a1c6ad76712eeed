// SPDX-License-Identifier: Apache-2.0
// Margins are compared with three definitions: |L| = 1 at the crossover, a closed-loop pole on the unit
// circle when the margin is used up, and a numerical Nyquist scan.
#include "sixstep/design/loops/margins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;
using Complex = std::complex<double>;

constexpr double period_s = 30e-6;
const ZohPlant current = current_plant(1.03, 0.572e-3, period_s);
const ZohPlant speed = speed_plant(0.78, 1.35e-5, 7.3e-6, period_s);

Complex open_loop(const ZohPlant& p, const PiGains& g, bool delayed, double turn) {
  const Complex z = std::polar(1.0, turn);
  return p.b0 * (g.d1 * z + g.d0) / ((z + p.a0) * (z - 1.0)) * std::polar(1.0, delayed ? -turn : 0.0);
}

struct Case {
  ZohPlant plant;
  PiGains gains;
};

std::vector<Case> cases() {
  std::vector<Case> all{{current, {4.5, -4.04}}, {speed, {0.017225, -0.01707}}, {current, {1.0, 0.5}}};
  for (const double settle_s : {0.3e-3, 1e-3, 10e-3})
    for (const double damping : {0.4, 0.9})
      for (const ZohPlant& plant : {current, speed})
        all.push_back({plant, place_poles(plant, settle_s, damping, period_s)->gains});
  return all;
}

TEST(Margins, LoopGainIsOneAtTheCrossoverAndThePhaseIsWhatIsSaid) {
  for (const auto& [plant, gains] : cases()) {
    for (const bool delayed : {false, true}) {
      const auto m = margins(plant, gains, period_s, delayed);
      ASSERT_TRUE(m);
      const Complex L = open_loop(plant, gains, delayed, m->crossover_rad_s * period_s);
      EXPECT_NEAR(std::abs(L), 1.0, 1e-9);
      EXPECT_NEAR(std::abs(L + std::polar(1.0, m->phase_rad)), 0.0, 1e-9);  // L = -exp(j phase)
      EXPECT_NEAR(m->delay_s * m->crossover_rad_s, m->phase_rad, 1e-12);
    }
  }
}

TEST(Margins, GainMarginIsWhereTheScannedCurveMeetsTheNegativeRealAxis) {
  for (const auto& [plant, gains] : cases()) {
    for (const bool delayed : {false, true}) {
      const auto m = margins(plant, gains, period_s, delayed);
      ASSERT_TRUE(m);
      double largest = 0.0;  // crossing of the negative real axis within the unit circle
      Complex last = open_loop(plant, gains, delayed, 1e-4);
      constexpr int points = 200000;
      for (int n = 1; n <= points; ++n) {
        const Complex L = open_loop(plant, gains, delayed, 1e-4 + (std::numbers::pi - 1e-4) * n / points);
        const bool crosses = (L.imag() < 0.0) != (last.imag() < 0.0) || n == points;
        if (crosses && L.real() < 0.0 && std::abs(L) < 1.0) largest = std::max(largest, -L.real());
        last = L;
      }
      ASSERT_EQ(m->gain.has_value(), largest > 0.0);
      if (m->gain) {
        EXPECT_NEAR(*m->gain * largest, 1.0, 1e-3);
      }
    }
  }
}

TEST(Margins, ADelayCostsPhaseAndNothingElse) {
  const PiGains gains{4.5, -4.04};
  const auto at_once = margins(current, gains, period_s, false),
             later = margins(current, gains, period_s, true);
  ASSERT_TRUE(at_once && later);
  EXPECT_EQ(at_once->crossover_rad_s, later->crossover_rad_s);
  EXPECT_NEAR(at_once->phase_rad - later->phase_rad, at_once->crossover_rad_s * period_s, 1e-12);
  EXPECT_GT(*at_once->gain, *later->gain);
}

TEST(Margins, WithoutGainThereAreNone) { EXPECT_FALSE(margins(current, {0.0, 0.0}, period_s, false)); }

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The figures are found by a scan. They are compared with the closed form of margins.hpp, with a numerical
// search by the definitions, and with the meaning of a margin. When the margin is used up, the closed loop is
// at the limit of stability.
#include "sixstep/design/loops/loop_figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "sixstep/control/pi.hpp"
#include "sixstep/design/loops/margins.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;

constexpr double period_s = 30e-6;
const ZohPlant current = current_plant(1.03, 0.572e-3, period_s);
const ZohPlant speed = speed_plant(0.78, 1.35e-5, 7.3e-6, period_s);

Transfer open_loop(const ZohPlant& p, const PiGains& g, int periods) {
  const Transfer pi{{g.d1 + g.d0, g.d1}, {0.0, 1.0}}, plant{{p.b0}, {1.0 + p.a0, 1.0}};
  return series(series(pi, plant), delay(periods));
}

struct Case {
  ZohPlant plant;
  PiGains gains;
};
std::vector<Case> cases() {
  std::vector<Case> all{{current, {4.5, -4.04}}, {speed, {0.017225, -0.01707}}};
  for (const double settle_s : {0.5e-3, 1e-3, 10e-3})
    for (const double damping : {0.4, 0.9})
      for (const ZohPlant& plant : {current, speed})
        all.push_back({plant, place_poles(plant, settle_s, damping, period_s)->gains});
  return all;
}

TEST(LoopFigures, AreThoseOfTheClosedForm) {
  for (const auto& [plant, gains] : cases()) {
    for (const int periods : {0, 1}) {
      const auto exact = margins(plant, gains, period_s, periods == 1);
      const LoopFigures f = loop_figures(open_loop(plant, gains, periods), period_s);
      ASSERT_TRUE(exact && f.crossover_rad_s && f.phase_rad);
      // If the loop is slow compared with the sampling, |L| changes little with w T. The tolerance is the
      // rounding of |L| divided by the slope of |L|.
      EXPECT_NEAR(*f.crossover_rad_s / exact->crossover_rad_s, 1.0, 1e-9);
      EXPECT_NEAR(*f.phase_rad, exact->phase_rad, 1e-9);
      EXPECT_NEAR(*f.delay_s, std::max(0.0, exact->delay_s), 1e-9 * std::fabs(exact->delay_s));
      ASSERT_EQ(f.gain.has_value(), exact->gain.has_value());
      if (f.gain) {
        EXPECT_NEAR(*f.gain / *exact->gain, 1.0, 1e-9);
      }
    }
  }
}

TEST(LoopFigures, BandwidthAndSensitivityByBruteForce) {
  for (const auto& [plant, gains] : cases()) {
    const LoopFigures f = loop_figures(open_loop(plant, gains, 1), period_s);
    double peak = 0.0, bandwidth = 0.0;
    constexpr int points = 400000;
    for (int n = 1; n <= points; ++n) {
      const double turn = std::numbers::pi * n / points;
      const std::complex<double> z = std::polar(1.0, turn);
      const std::complex<double> L = plant.b0 * (gains.d1 * z + gains.d0) / ((z + plant.a0) * (z - 1.0) * z);
      peak = std::max(peak, std::abs(1.0 / (1.0 + L)));
      if (bandwidth == 0.0 && std::abs(L / (1.0 + L)) < std::numbers::sqrt2 / 2) bandwidth = turn / period_s;
    }
    // Near its peak, the curve is flat. Half a grid step, 0.15 % of the peak's frequency, therefore causes
    // only an error of second order.
    EXPECT_NEAR(f.sensitivity_peak / peak, 1.0, 1e-4);
    ASSERT_TRUE(f.bandwidth_rad_s);
    EXPECT_NEAR(*f.bandwidth_rad_s, bandwidth, std::numbers::pi / points / period_s);
  }
}

TEST(LoopFigures, AMarginUsedUpIsTheEdgeOfStability) {
  for (const auto& [plant, gains] : cases()) {
    const LoopFigures f = loop_figures(open_loop(plant, gains, 1), period_s);
    if (!f.stable) continue;
    ASSERT_TRUE(f.gain);
    for (const double factor : {1.0 - 1e-6, 1.0 + 1e-6}) {
      const PiGains scaled{gains.d1 * *f.gain * factor, gains.d0 * *f.gain * factor};
      EXPECT_EQ(is_stable(closed(open_loop(plant, scaled, 1)).den), factor < 1.0);
    }
    // The delay margin is between two whole numbers of periods.
    const int fits = static_cast<int>(*f.delay_s / period_s);
    if (fits > 8) continue;  // a polynomial of such a high degree has its own rounding errors
    EXPECT_TRUE(is_stable(closed(open_loop(plant, gains, 1 + fits)).den));
    EXPECT_FALSE(is_stable(closed(open_loop(plant, gains, 2 + fits)).den));
  }
}

TEST(LoopFigures, AnUnstableLoopSaysSo) {
  const LoopFigures f = loop_figures(open_loop(current, {25.0, -24.0}, 1), period_s);
  EXPECT_FALSE(f.stable);
  EXPECT_LT(*f.phase_rad, 0.0);
  EXPECT_EQ(*f.delay_s, 0.0);
}

TEST(StepResponses, AreTheControllersOwnRecursion) {
  const PiGains gains = place_poles(current, 1e-3, 0.9, period_s)->gains;
  const StepResponse r = step_response(closed(open_loop(current, gains, 0)), period_s, 3e-3);
  const sixstep::control::PiConfig<double> pi{gains.d1, gains.d0, 1e9};
  sixstep::control::PiState<double> state;
  double i = 0.0;
  for (std::size_t k = 0; k < r.samples.size(); ++k) {
    ASSERT_NEAR(r.samples[k], i, 1e-12) << k;
    i = -current.a0 * i + current.b0 * sixstep::control::pi_step(pi, state, 1.0 - i);
  }
  // According to model.md 13, the design by exact poles settles in about 0.99 ms.
  EXPECT_NEAR(r.settling_s, 0.99e-3, period_s);
  EXPECT_GT(r.overshoot, 0.0);
}

TEST(StepResponses, ThatDoNotSettleAreInfinite) {
  EXPECT_TRUE(std::isinf(step_response({{0.001}, {0.001, 1.0}}, period_s, 10 * period_s).settling_s));
}

TEST(BodeData, FollowTheLoopAndUnwrapItsPhase) {
  const Transfer L = open_loop(current, {4.5, -4.04}, 1);
  const std::vector<BodePoint> points = bode(L, period_s, 10.0, 200);
  ASSERT_EQ(points.size(), 200u);
  EXPECT_NEAR(points.front().w_rad_s, 10.0, 1e-9);
  EXPECT_NEAR(points.back().w_rad_s, std::numbers::pi / period_s, 1e-6);
  for (std::size_t n = 1; n < points.size(); ++n) {
    EXPECT_LT(std::fabs(points[n].phase_rad - points[n - 1].phase_rad), 0.5);
    EXPECT_NEAR(points[n].gain, L.at(points[n].w_rad_s * period_s).size(), 1e-12 * points[n].gain);
  }
  EXPECT_NEAR(points.front().phase_rad, -std::numbers::pi / 2, 0.02);  // an integrator
}

}  // namespace SIXSTEP_TEST_FILE

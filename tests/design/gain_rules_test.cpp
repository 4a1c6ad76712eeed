// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/gain_rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/design/loops/loop_figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;

constexpr double eps = 0x1p-52;
constexpr double R = 1.03, L_H = 0.572e-3, period_s = 30e-6;

TEST(Cancellation, LeavesOnePoleWhereItIsWanted) {
  for (const double w : {100.0, 4600.0, 30000.0}) {
    const auto rule = cancel_pole(R, L_H, w, period_s);
    ASSERT_TRUE(rule);
    const auto [a0, b0] = current_plant(R, L_H, period_s);
    const auto [d1, d0] = rule->gains;
    // The closed loop's polynomial is (z - 1)(z + a0) + b0 (d1 z + d0) = (z + a0)(z - exp(-w T)), with the
    // bandwidth w and the period T.
    const double pole = std::exp(-w * period_s);
    EXPECT_NEAR(b0 * d1 + a0 - 1.0, a0 - pole, 8 * eps);
    EXPECT_NEAR(b0 * d0 - a0, -a0 * pole, 8 * eps);
  }
}

TEST(Cancellation, IsTheFirmwaresRuleForShortPeriods) {
  const double w = 2000.0;
  for (const double T : {1e-6, 1e-7}) {
    const auto rule = cancel_pole(R, L_H, w, T);
    ASSERT_TRUE(rule);
    const double K_i = rule->gains.d1 + rule->gains.d0;
    // The next terms of the series are w T/2 and R T/(2 L). In this test, they are at most 1e-3 and 9e-4.
    EXPECT_NEAR(rule->gains.d1 / (L_H * w), 1.0, (w + R / L_H) * T);
    EXPECT_NEAR(K_i / (R * w * T), 1.0, (w + R / L_H) * T);
  }
}

TEST(SymmetricalOptimum, HasItsKnownPhaseMargin) {
  EXPECT_NEAR(symmetrical_optimum_phase_rad(2.0) * 180.0 / 3.14159265358979, 36.8698976458440, 1e-12);
  EXPECT_NEAR(symmetrical_optimum_phase_rad(1.0 + std::sqrt(2.0)), 3.14159265358979 / 4, 1e-14);
  // The plant that the rule assumes is an integrator with one lag. The sampling is so fast that the effect of
  // the hold is negligible.
  const double J = 1.35e-5, T_max = 0.78, lag = 1e-4, T = lag / 1000;
  for (const double a : {1.5, 2.0, 2.8, 5.0}) {
    const auto rule = symmetrical_optimum(J, T_max, lag, a, T);
    ASSERT_TRUE(rule);
    Linear plant{.states = 2, .A = {}, .B = {}};
    plant.A[0] = {-1.0 / lag, 0.0, 0.0, 0.0};
    plant.A[1] = {T_max / J, 0.0, 0.0, 0.0};
    plant.B[0] = 1.0 / lag;
    const Transfer loop =
        series({{rule->gains.d1 + rule->gains.d0, rule->gains.d1}, {0.0, 1.0}}, sampled(plant, 1, T));
    const LoopFigures f = loop_figures(loop, T);
    ASSERT_TRUE(f.stable && f.phase_rad);
    // The hold and the Euler integration each change the phase by at most w_c T/2. With the crossover w_c,
    // w_c T is 1e-3/a.
    EXPECT_NEAR(*f.phase_rad, symmetrical_optimum_phase_rad(a), 1e-3 / a);
    EXPECT_NEAR(*f.crossover_rad_s * a * lag, 1.0, 1e-3);
  }
}

TEST(SymmetricalOptimum, TheLagOfALoopIsItsRampError) {
  const ZohPlant plant = current_plant(R, L_H, period_s);
  const PiGains gains = place_poles(plant, 1e-3, 0.9, period_s)->gains;
  const Transfer whole =
      closed(series({{gains.d1 + gains.d0, gains.d1}, {0.0, 1.0}}, {{plant.b0}, {1.0 + plant.a0, 1.0}}));
  // The lag behind a ramp, in periods, is the sum of (1 - step response).
  const StepResponse r = step_response(whole, period_s, 0.02);
  double lag = 0.0;
  for (const double y : r.samples) lag += (1.0 - y) * period_s;
  EXPECT_NEAR(lag_of_loop_s(plant, gains, period_s), lag + period_s / 2, 1e-13);
}

TEST(GainRules, NameWhatTheyCannotUse) {
  EXPECT_EQ(cancel_pole(R, L_H, -1.0, 0.0).problems().size(), 2u);
  EXPECT_EQ(to_string(symmetrical_optimum(1e-5, 0.78, 1e-4, 1.0, 1e-5).problems()[0]),
            "a = 1 must be above 1; use a larger damping or a smaller bandwidth: a = 2 is the usual value");
}

}  // namespace SIXSTEP_TEST_FILE

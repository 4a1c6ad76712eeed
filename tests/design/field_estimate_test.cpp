// SPDX-License-Identifier: Apache-2.0
// The design values of the estimator of the magnet's angle are compared with the bounds in its header.
#include "sixstep/design/loops/field_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using ::testing::HasSubstr;

constexpr double T = 50e-6;
constexpr FieldMachine salient{
    .R_ohm = 0.515, .L_d_H = 0.24e-3, .L_q_H = 0.34e-3, .magnet_V_s = 0.01675, .pole_pairs = 8};

FieldEstimateSpec spec(bool injects, bool observes) {
  FieldEstimateSpec s;
  s.injects = injects;
  s.observes = observes;
  s.period_s = T;
  s.delay_periods = 1;
  s.loop_rad_s = 6283;
  s.bus_V = 24;
  s.current_A = 4;
  s.J_kg_m2 = 135e-7;
  return s;
}

double number(const control::FixedGain<std::int32_t>& g) {
  return std::ldexp(static_cast<double>(g.mantissa), -g.right);
}

/// A loop of type 2 lags behind an acceleration a by a/K_a (acceleration constant K_a).
TEST(FieldEstimate, FullTorqueLeavesTheAngleFiveDegreesBehind) {
  for (const double I : {2.0, 4.0, 6.0}) {
    FieldEstimateSpec s = spec(true, false);
    s.current_A = I;
    const auto out = field_estimate(salient, 40, s);
    ASSERT_TRUE(out);
    const double a = 8 * 1.5 * 0.01675 * I / 135e-7;
    EXPECT_NEAR(a * T * T / number(out->config.tracking.K_i) * 180 / std::numbers::pi, 5.0, 0.3) << I;
  }
}

TEST(FieldEstimate, TheTrackingLoopStaysBetweenAHundredthAndATwentiethOfTheControlFrequency) {
  for (const double J : {1e-9, 1.0}) {
    FieldEstimateSpec s = spec(true, false);
    s.J_kg_m2 = J;
    const auto out = field_estimate(salient, 40, s);
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->steps[0].value, 2 * std::numbers::pi / T / (J < 1e-6 ? 20 : 100), 1e-6) << J;
  }
}

/// The pulse uses at most a quarter of the voltage circle and a fifth of the current. The current of the
/// polarity test is so small that saturation does not change the sign of the saliency.
TEST(FieldEstimate, ThePulseIsNoLargerThanWhatIsThere) {
  for (const double I : {0.5, 4.0, 30.0})
    for (const bool along : {false, true}) {
      FieldMachine m = salient;
      if (along) std::swap(m.L_d_H, m.L_q_H);
      FieldEstimateSpec s = spec(true, false);
      s.current_A = I;
      const auto out = field_estimate(m, 40, s);
      ASSERT_TRUE(out);
      const auto& c = out->config;
      EXPECT_LE(c.injection.voltage_V, 0.25 * 24 / std::sqrt(3.0) * (1 + 1e-12));
      EXPECT_LE(c.injection.voltage_V * T / m.L_d_H, 0.2 * I * (1 + 1e-12));
      EXPECT_EQ(c.injection.rad_per_A > 0, !along);
      EXPECT_LE(c.north.current_A, I);
      const double part = c.north.current_A / 40;
      EXPECT_LE(part, 0.2);
      EXPECT_EQ(m.L_d_H * (1 + part) < m.L_q_H, !along);
      EXPECT_EQ(m.L_d_H * (1 - part) < m.L_q_H, !along);
      EXPECT_NEAR(c.north.certain, part / 3, 1e-12);
    }
}

TEST(FieldEstimate, TheFluxIsFollowedWhereTheBackEmfIsATenthOfTheCircle) {
  const auto out = field_estimate(salient, 0, spec(false, true));
  ASSERT_TRUE(out);
  const auto& c = out->config;
  EXPECT_NEAR(c.high_rad_s * salient.magnet_V_s, 0.1 * 24 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(c.low_rad_s, c.high_rad_s / 2, 1e-12);
  EXPECT_NEAR(c.flux.pull, 1 - std::exp(-4 * c.high_rad_s * T), 1e-12);
  EXPECT_NEAR(c.flux.magnet_Vs, 0.01675 / 8, 1e-15);
  // The start accelerates the field with an eighth of the acceleration at full current, and ends at the upper
  // speed.
  const double unit = 8 * T / (2 * std::numbers::pi) * std::ldexp(1.0, 48);
  EXPECT_NEAR(static_cast<double>(c.start.step), 0.125 * 1.5 * 0.01675 * 4 / 135e-7 * T * unit, 1.0);
  EXPECT_NEAR(static_cast<double>(c.start.enough), c.high_rad_s * unit, 1.0);
}

/// A rotor follows the rotating axis of a field like a pendulum without damping. The axis accelerates with
/// the fraction x of the largest torque, against a friction of the fraction y. Returns whether the rotor
/// still follows after 20 turns of the axis. Time is in units of the pendulum's time.
bool is_taken_along(double x, double y, double before) {
  double behind = -before, axis = 0.0, rotor = 0.0;  // speeds
  constexpr double dt = 1e-3;
  for (double way = 0.0; way < 40 * std::numbers::pi; way += axis * dt) {
    axis += x * dt;
    const double pulls = std::sin(behind);
    if (rotor > 0 || std::fabs(pulls) > y) rotor = std::max(0.0, rotor + (pulls - y) * dt);
    behind += (axis - rotor) * dt;
    if (behind > std::numbers::pi) return false;
  }
  return true;
}

/// The stated load is below the limit of the equal-area criterion. Above this limit, a rotor loses
/// synchronism.
TEST(FieldEstimate, TheGreatestLoadThatItStartsAgainstIsToldWithRoomToSpare) {
  const auto out = field_estimate(salient, 0, spec(false, true));
  ASSERT_TRUE(out);
  const auto& told = out->steps.back();
  EXPECT_EQ(told.symbol, "T_start");
  const double promised = told.value / (1.5 * 0.01675 * 4), areas = 0.6593269;
  EXPECT_NEAR(promised, 0.6, 1e-12);
  for (const double before : {1.0, 0.0, -1.0})
    EXPECT_TRUE(is_taken_along(0.125, promised, before * std::asin(promised))) << before;
  EXPECT_TRUE(is_taken_along(0.125, areas - 0.005, std::asin(areas)));
  EXPECT_FALSE(is_taken_along(0.125, areas + 0.005, std::asin(areas)));
}

TEST(FieldEstimate, WhatCannotBeSeenIsTold) {
  FieldMachine round = salient;
  round.L_d_H = round.L_q_H;
  EXPECT_THAT(field_estimate(round, 40, spec(true, true)).problems()[0].limit,
              HasSubstr("inductances are equal"));
  EXPECT_THAT(field_estimate(salient, 0, spec(true, true)).problems()[0].limit,
              HasSubstr("the sheet has no saturation_current_A"));
  EXPECT_THAT(field_estimate(salient, 4000, spec(true, true)).problems()[0].limit,
              HasSubstr("less than 1 %"));
  FieldEstimateSpec fast = spec(false, true);
  fast.bandwidth_rad_s = 1e6;
  EXPECT_EQ(field_estimate(salient, 0, fast).problems()[0].where, "control.field.angle_bandwidth_Hz");
}

}  // namespace SIXSTEP_TEST_FILE

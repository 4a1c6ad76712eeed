// SPDX-License-Identifier: Apache-2.0
// Currents that follow the shape of the back-EMF, in a scenario. With a trapezoid machine, the shape causes
// no torque ripple. The copper loss is compared with its law.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/harmonic_current.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr double I = 4.0, K_e = 0.01675, R = 0.515, L = 0.286e-3, T = 50e-6;
/// The fundamental of the trapezoid with a flat top of 120 degrees: 4/pi sin(h)/h with h = pi/6.
const double fundamental = 4 / base::pi * 0.5 / (base::pi / 6);
const double torque_Nm = 1.5 * K_e * fundamental * I;

/// The 251601 with an inertia so large that its speed is nearly constant.
Scenario trapezoid(double speed_rad_s, bool harmonic) {
  Scenario s = maxon_scenario(Mode::current, I);
  s.control.drive = FirmwareKind::field;
  s.control.field.harmonic_current = harmonic;
  s.pwm.alignment = Alignment::centre;
  s.pwm.period_s = T;
  s.pwm.delay_periods = 1;
  s.initial.speed_rad_s = speed_rad_s;
  s.load.inertia_kg_m2 = 10;
  const double turn_s = speed_rad_s != 0 ? 2 * base::pi / (8 * std::fabs(speed_rad_s)) : 0.0;
  s.duration_s = 10e-3 + turn_s;
  for (const MetricKind metric :
       {MetricKind::mean, MetricKind::maximum, MetricKind::minimum, MetricKind::ripple_rms})
    ask(s, over(metric, Signal::torque, 10e-3));
  ask(s, over(MetricKind::mean, Signal::copper_loss, 10e-3));
  return s;
}

struct Torque {
  double mean, most, least, ripple, copper;
};
Torque torque_of(const Scenario& s) {
  const std::vector<double> f = figures_of(s);
  return {f[0], f[1], f[2], f[3], f[4]};
}

/// Bound on the torque ripple from switching. The vector v that keeps the current acts in the middle of each
/// period. Before it acts, at most v T/4 is missing. The largest |g| of the shape is 4/3 divided by the
/// fundamental.
double switching_Nm(double speed_rad_s) {
  const double v = std::hypot(R * I + K_e * std::fabs(speed_rad_s) * 4 / 3, speed_rad_s * 8 * L * I);
  return 1.5 * K_e * 4 / 3 * v * T / (4 * L);
}

TEST(HarmonicCurrent, TheTrapezoidsTorqueLosesTheShapesRipple) {
  for (const double w : {20.0, -50.0, 100.0, 400.0}) {
    const Torque without = torque_of(trapezoid(w, false)), with = torque_of(trapezoid(w, true));
    const double switching = switching_Nm(w);
    EXPECT_NEAR(without.mean, torque_Nm, 3e-3 * torque_Nm) << w;
    EXPECT_NEAR(with.mean, torque_Nm, 2e-3 * torque_Nm) << w;
    EXPECT_LT(with.most, torque_Nm + switching) << w;
    EXPECT_GT(with.least, torque_Nm - switching) << w;
    EXPECT_LT(with.ripple, 0.6 * without.ripple) << w;
    if (std::fabs(w) > 50) continue;  // at higher speeds the loop also reduces the ripple from the shape
    EXPECT_NEAR(without.most, torque_Nm * 4 / 3 / fundamental, switching) << w;
    EXPECT_NEAR(without.least, torque_Nm * 2 / std::numbers::sqrt3 / fundamental, switching) << w;
  }
}

/// The mean of 1/|g|^2 along the hexagon is f_1^2 sqrt 3 pi/8 (shape vector g, fundamental f_1). The copper
/// loss is therefore 0.55 % higher than with a constant i_q of the same torque. The switching ripple causes
/// equal losses in both cases.
TEST(HarmonicCurrent, CostsNoMoreCopperLossThanTheClosedForm) {
  const double constant_W = 1.5 * R * I * I,
               part = fundamental * fundamental * std::numbers::sqrt3 * base::pi / 8;
  for (const double w : {20.0, 50.0}) {
    const double ripple_W = torque_of(trapezoid(w, false)).copper - constant_W;
    EXPECT_GT(ripple_W, 0.0);
    const double with = torque_of(trapezoid(w, true)).copper;
    EXPECT_LE(with, constant_W * part + 1.2 * ripple_W);
    EXPECT_GT(with, constant_W * part * 0.999);
  }
}

/// Without decoupling, there is no feed-forward. The loop follows with its bandwidth, and a lead compensates
/// its lag tau. At a corner of the shape, the slope of the reference changes by 4/pi 9/16 f_1 w_e I, in A/s.
/// The current error is 1/e of tau times this change. The torque error has the additional factor 4/3, divided
/// by f_1.
TEST(HarmonicCurrent, TheLoopAloneFollowsWithinItsLag) {
  const double z = std::exp(-base::pi / 10), lag_s = T / (z * (1 - z));
  for (const double w : {20.0, 50.0}) {
    Scenario s = trapezoid(w, true);
    s.control.field.decoupling = false;
    const double corner = torque_Nm * 3 / base::pi * 8 * w * lag_s / std::exp(1.0);
    const Torque with = torque_of(s);
    EXPECT_LT(with.most, torque_Nm + switching_Nm(w) + corner);
    EXPECT_GT(with.least, torque_Nm - switching_Nm(w) - corner);
    EXPECT_LT(with.ripple, 0.6 * torque_of(trapezoid(w, false)).ripple);
  }
}

/// The back-EMF has a fifth harmonic of 5 %. With a constant i_q, the torque has a ripple of 5 %, as cos 6
/// theta. With currents that follow the shape, it has no ripple. This machine runs in the general kernel.
TEST(HarmonicCurrent, FollowsHarmonicsOfASineToo) {
  const auto fifth = [](bool harmonic) {
    Scenario s = trapezoid(20, harmonic);
    s.sheet.back_emf = design::BackEmfShape::sine;
    s.sheet.torque_constant_mNm_A = std::nullopt;
    s.sheet.back_emf_mV_s = base::Quantity{1e3 * K_e, "phase", ""};
    s.sheet.harmonic_orders = {5};
    s.sheet.harmonic_sizes = {0.05};
    return s;
  };
  const Torque without = torque_of(fifth(false)), with = torque_of(fifth(true));
  EXPECT_LT(with.ripple, 0.6 * without.ripple);
  EXPECT_NEAR(with.mean, without.mean, 2e-3 * without.mean);
  EXPECT_NEAR(without.most - without.least, 0.1 * without.mean, 2 * switching_Nm(20));
}

TEST(HarmonicCurrent, ASineIsDrivenAsWithoutIt) {
  Scenario s = trapezoid(20, true);
  s.sheet.back_emf = design::BackEmfShape::sine;
  const auto compiled = compile(s);
  ASSERT_TRUE(compiled);
  EXPECT_FALSE(compiled->field->harmonic.on);
}

TEST(HarmonicCurrent, DoubleAndFloatMakeTheSameTorque) {
  Scenario s = trapezoid(50, true);
  const Torque wide = torque_of(s);
  s.control.arithmetic = Arithmetic::float32;
  const Torque narrow = torque_of(s);
  EXPECT_NEAR(narrow.mean, wide.mean, 1e-4 * torque_Nm);
  EXPECT_NEAR(narrow.ripple, wide.ripple, 1e-3 * torque_Nm);
}

/// In a cascade, the current stays within its limit for any shape, and the loop keeps the speed.
TEST(HarmonicCurrent, TheSpeedLoopKeepsTheLimitOfTheCurrent) {
  Scenario s = trapezoid(0.0, true);
  s.initial.speed_rad_s = 0;
  s.load = {};
  s.load.torque_Nm = 0.05;
  s.control.mode = Mode::speed;
  s.control.speed.settle_s = 20e-3;
  s.control.speed.torque_limit_Nm = 0.3;
  s.control.current.limit_A = 6.0;
  s.reference.value = 300;
  s.duration_s = 0.3;
  s.compare.clear();
  ask(s, over(MetricKind::maximum, Signal::quadrature_current_reference, 0.0));
  ask(s, over(MetricKind::mean, Signal::speed, 0.25));
  ask(s, over(MetricKind::maximum, Signal::current_magnitude, 0.0, 0.05));
  const std::vector<double> f = figures_of(s);
  EXPECT_LE(f[0], 6.0 * (1 + 1e-12));
  EXPECT_NEAR(f[1], 300.0, 0.05);
  EXPECT_GT(f[0], 5.5) << "and is used";
}

TEST(HarmonicCurrent, WhatItDoesNotDoIsRefusedWithACure) {
  Scenario s = trapezoid(20, true);
  EXPECT_TRUE(check(s).empty());
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  const base::Problems problems = check(s);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where, "control.field.harmonic_current");
  EXPECT_FALSE(problems[0].cure.empty());
  s.control.field.harmonic_current = false;
  EXPECT_TRUE(check(s).empty());
  s = trapezoid(20, true);
  s.control.drive = FirmwareKind::lean;
  ASSERT_FALSE(check(s).empty());
  EXPECT_EQ(check(s)[0].where, "control.field");
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// A scenario switches on a product's extra functions inside the loops (control/drive_extras.hpp). The tests
// simulate the reference motor with full switching. Each test compares a run with the extra and a run without
// it.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::MetricKind;
using study::Scenario;
using study::Signal;

constexpr double T = 30e-6, R = 1.03, L = 0.572e-3, K_t = 0.0335, J = 1.35e-5, B = 7.3e-6;

study::Measure window(MetricKind metric, Signal signal, double from_s, double to_s) {
  study::Measure m = measure(metric, signal);
  m.from_s = from_s;
  m.to_s = to_s;
  return m;
}

double first_figure(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  EXPECT_FALSE(out && out->fault);
  return out ? out->comparisons[0].measured : -1e9;
}

/// Integral gain of the designed current loop for one sample.
double K_i(const Scenario& s) {
  const auto compiled = study::compile(s);
  return compiled->drive.current.d1 + compiled->drive.current.d0;
}

TEST(Extras, MeasuredBusTakesTheFallOfTheBusFromTheLoop) {
  // The current is 5 A, the rotor is locked, and u = R i = 5.15 V. The bus U falls from 36 V to 24 V minus
  // the drop across 1 ohm, with tau = 20 ms. If the loop uses the nominal bus, it must command u 24 V/U,
  // which rises at the rate u 24 V |U'|/U^2. The integral lags behind this ramp by an error of the ramp's
  // slope times T/K_i. At 5 ms, with 0.86 A from the supply, U = 23.14 V + 12.86 V exp(-1/4).
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 1.0, .capacitance_F = 20e-3};
  s.initial.bus_V = 36.0;
  study::Measure least = window(MetricKind::minimum, Signal::current, 5e-3, 15e-3);
  least.sampled = true;
  ask(s, least);
  const double U = 23.14 + 12.86 * std::exp(-0.25), slope = 12.86 / 20e-3 * std::exp(-0.25);
  const double lasting = slope * 24.0 / (U * U) * (R * 5.0) * T / K_i(s);
  const double without = 5.0 - first_figure(s);
  s.control.current.measured_bus_from_V = 10.0;
  const double with = 5.0 - first_figure(s);
  std::printf("short of 5 A by %.3g A, expected %.3g, compensated %.3g\n", without, lasting, with);
  EXPECT_NEAR(without, lasting, 0.05 * lasting)
      << "the mean, which R sees, is half a ripple above the sample";
  EXPECT_LT(std::fabs(with), 0.05 * lasting);
}

TEST(Extras, BackEmfFeedForwardTakesTheRampOfTheSpeedFromTheLoop) {
  // The current is 5 A, and the rotor is free. The back-EMF rises at the rate K_t^2 i/J, and the integral
  // lags by K_t^2 i/J T/K_i. Commutations saturate the loop and reduce the current further, but equally in
  // both runs. The difference between the means of the samples is therefore the lag.
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.duration_s = 30e-3;
  study::Measure mean = window(MetricKind::mean, Signal::current, 2e-3, 30e-3);
  mean.sampled = true;
  ask(s, mean);
  const double lasting = K_t * K_t * 5.0 / J * T / K_i(s);
  const double without = first_figure(s);
  s.control.current.back_emf_feed_forward = true;
  const double with = first_figure(s);
  std::printf("mean %.5g A, with feed-forward %.5g, ramp's share %.3g\n", without, with, lasting);
  EXPECT_NEAR(with - without, lasting, 0.2 * lasting);
}

TEST(Extras, ASlewedSetpointAsksForItsSlopeOfTorque) {
  // A slope of 1000 rad/s^2 needs the torque J w' + B w, which is measured over the middle of the ramp. The
  // speed has a ripple of some 0.5 rad/s. This is 1 % of the ramp's 60 ms at either end.
  Scenario s = maxon_scenario(Mode::speed, 100.0);
  s.duration_s = 0.15;
  ask(s, window(MetricKind::mean, Signal::torque, 20e-3, 80e-3));
  EXPECT_LT(first_figure(s), 0.1 * J * 1000.0) << "it stepped, and is there long ago";
  s.control.slew = 1000.0;
  EXPECT_NEAR(first_figure(s), J * 1000.0 + B * 50.0, 0.02 * J * 1000.0);
}

TEST(Extras, LimitsOfCurrentAndTorqueAreTheReference) {
  Scenario asked = maxon_scenario(Mode::current, 2.0), limited = maxon_scenario(Mode::current, 5.0);
  const std::uint64_t digest = study::run(asked)->digest;
  EXPECT_NE(study::run(limited)->digest, digest);
  limited.control.limits.current_A = 2.0;
  EXPECT_EQ(study::run(limited)->digest, digest);
  limited.control.limits = {.current_A = 3.0, .torque_Nm = 2.0 * K_t};
  ask(limited, window(MetricKind::mean, Signal::current, 2e-3, 20e-3));
  ask(asked, window(MetricKind::mean, Signal::current, 2e-3, 20e-3));
  EXPECT_NEAR(first_figure(limited), first_figure(asked), 1e-9) << "2 K_t/K_t, rounded";
}

TEST(Extras, OwnTorqueDoesNotPassTheLimitOfSpeed) {
  // The current is 2 A, without a load. The gain of the speed limit is K = J/(K_t 1 ms) (inertia J). With the
  // friction B, the speed is w = w_limit K K_t/(K K_t + B).
  Scenario s = maxon_scenario(Mode::current, 2.0);
  s.duration_s = 0.1;
  ask(s, window(MetricKind::mean, Signal::speed, 0.08, 0.1));
  ask(s, measure(MetricKind::maximum, Signal::speed));
  EXPECT_GT(first_figure(s), 200.0);
  s.control.limits.speed_rad_s = 100.0;
  const auto out = study::run(s);
  ASSERT_TRUE(out);
  std::printf("speed %.6g, at most %.6g rad/s\n", out->comparisons[0].measured, out->comparisons[1].measured);
  const double K_K_t = J / 1e-3;
  // The loop controls the sampled current. The sample is below the mean current by up to half a ripple, U
  // T/(8 L). The speed error is half the ripple divided by K.
  const double half_ripple_A = 24.0 * T / (8 * L);
  EXPECT_NEAR(out->comparisons[0].measured, 100.0 * K_K_t / (K_K_t + B), half_ripple_A * K_t / K_K_t);
  // The reference falls as the speed rises, and the current lags by its settling time. The overshoot is less
  // than the increase of the speed at full torque in this time.
  EXPECT_LT(out->comparisons[1].measured, 100.0 + K_t * 2.0 / J * 1e-3);
}

/// The mean current at a duty just above or below zero. The inertia keeps the rotor at 20 rad/s.
double current_at(double duty, bool smooth) {
  Scenario s = maxon_scenario(Mode::duty, duty);
  s.duration_s = 80e-3;
  s.initial.speed_rad_s = 20.0;
  s.load.inertia_kg_m2 = 1.0;
  s.control.smooth_chopping.on = smooth;
  // The window contains ten sectors, each of (pi/24)/20 rad/s = 6.5 ms.
  ask(s, window(MetricKind::mean, Signal::current, 10e-3, 10e-3 + 10 * M_PI / 24 / 20.0));
  return first_figure(s);
}

TEST(Extras, SmoothChoppingHasNoStepAtDutyZero) {
  constexpr double d = 0.0005;
  const double soft = current_at(d, false) - current_at(-d, false);
  const double smooth = current_at(d, true) - current_at(-d, true);
  std::printf("from -%g to %g: soft %.4g A, smooth %.4g A\n", d, d, soft, smooth);
  // After each commutation, the current rises with tau = L/R, which is 0.085 of a sector. Meanwhile, the
  // measured current is half of the sum of two phases. At duty 0, soft chopping changes between no current
  // and the current of short-circuited windings (model.md 4b).
  const double commutation = L / R / (M_PI / 24 / 20.0);
  EXPECT_NEAR(soft, K_t * 20.0 / R, commutation * K_t * 20.0 / R);
  // With smooth chopping the current changes by 2 d U/R.
  EXPECT_NEAR(smooth, 2 * d * 24.0 / R, commutation * 2 * d * 24.0 / R);
}

TEST(Extras, FixedPointHasThemAllToo) {
  Scenario s = maxon_scenario(Mode::speed, 100.0);
  s.duration_s = 0.2;
  s.control.speed.settle_s = 20e-3;
  s.control.speed.damping = 0.9;
  s.control.slew = 2000.0;
  s.control.limits = {.current_A = 8.0, .speed_rad_s = 150.0};
  s.control.current.back_emf_feed_forward = true;
  s.control.current.measured_bus_from_V = 10.0;
  s.control.smooth_chopping.on = true;
  ask(s, window(MetricKind::mean, Signal::speed, 0.15, 0.2));
  for (const auto a : {study::Arithmetic::float64, study::Arithmetic::float32, study::Arithmetic::q15,
                       study::Arithmetic::q31}) {
    s.control.arithmetic = a;
    EXPECT_NEAR(first_figure(s), 100.0, 0.1) << "0.1 %, as in 7.4";
  }
}

TEST(Extras, WhatContradictsTheLoopIsSaid) {
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.control.current.type = study::CurrentLoopType::hysteresis;
  s.control.current.back_emf_feed_forward = true;
  s.control.limits.gain_A_s_per_rad = 1.0;
  s.control.smooth_chopping = {.on = true, .soft_above_A = 1.0, .complementary_below_A = 2.0};
  EXPECT_EQ(study::check(s).size(), 3u);
}

}  // namespace SIXSTEP_TEST_FILE

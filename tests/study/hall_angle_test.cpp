// SPDX-License-Identifier: Apache-2.0
// Tests speed, position and commutation from the angle between Hall edges in whole runs, and the refused
// cases.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using rig::HallAngleFrom;
using ::testing::HasSubstr;

/// The speed is 100 rad/s. The angles of the probes have errors of up to 4 degrees, and the speed is measured
/// over one sector.
Scenario strayed(HallAngleFrom from) {
  Scenario s = cascade(0.25);
  s.control.speed = {.torque_limit_Nm = 0.78};
  s.control.speed.d1 = 1.582e-3;
  s.control.speed.d0 = -1.5806e-3;
  s.control.current.limit_A = 10;
  s.load.coulomb_Nm = 0.02;
  s.sensors.rotor = RotorSensing::hall;
  s.sensors.speed_edges = 1;
  s.sensors.hall_edges_deg = {0, 3, -2, 1, -4, 2};
  s.sensors.hall_angle = from;
  Measure m = measure(MetricKind::peak_to_peak, Signal::current_reference);
  m.from_s = 0.2;
  ask(s, m);
  return s;
}

// Readings of 60/55 and 60/66 of the true speed change the reference by the gain of the loop. The angle of a
// learned edge has an error of two counts of 1 us in a sector of at least 1.2 ms. The time of the sector adds
// an error of one count at either end.
TEST(HallAngle, PlacesThatWereLearnedNoLongerShakeTheLoop) {
  const double gain_A = 1.582e-3 * 0.78 / 33.5e-3, w = 100;
  EXPECT_GT(outcome_of(strayed(HallAngleFrom::sectors)).comparisons[0].measured,
            gain_A * w * (60.0 / 55 - 60.0 / 66));
  const double ripple = outcome_of(strayed(HallAngleFrom::learned_edges)).comparisons[0].measured;
  // The bound contains both directions, and the oscillation of the shaft.
  EXPECT_LT(ripple, gain_A * (w * 2 * 2 * 3 / 1200.0 + 0.2));
}

TEST(HallAngle, RunsACascadeInEveryArithmetic) {
  for (const HallAngleFrom from : {HallAngleFrom::angle, HallAngleFrom::learned_edges})
    for (const Arithmetic arithmetic : {Arithmetic::float64, Arithmetic::float32, Arithmetic::q31}) {
      Scenario s = cascade(0.25);
      s.control.speed.settle_s = 0.1;
      s.control.arithmetic = arithmetic;
      s.load.coulomb_Nm = 0.02;
      s.sensors.rotor = RotorSensing::hall;
      s.sensors.hall_angle = from;
      s.sensors.speed_edges = 1;
      s.pwm.commutation = CommutationAt::sample;
      if (arithmetic == Arithmetic::q31) s.control.full_scale = {100, 80, 1600, 7200};
      ask(s, measure(MetricKind::final_value, Signal::speed));
      // The bound is one count of 1 us in a sector of 1.3 ms, plus the ripple of the speed of 0.4 % within a
      // sector.
      EXPECT_NEAR(outcome_of(s).comparisons[0].measured, 100, 1.0) << static_cast<int>(arithmetic);
    }
}

/// The Hall lines are delayed, as by a filter. At the speed of this run, the delay is 14 degrees.
double mean_torque_behind_a_filter(HallAngleFrom from, double delay_s) {
  Scenario s = maxon_scenario(Mode::current, 2.0);
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.01};
  s.pwm.chopping = control::Chopping::hard;
  s.pwm.commutation = CommutationAt::sample;
  s.pwm.period_s = 10e-6;
  s.initial.speed_rad_s = 300;
  s.load.inertia_kg_m2 = 1;
  s.duration_s = 26.18e-3;
  s.sensors.rotor = RotorSensing::hall;
  s.sensors.hall_angle = from;
  s.sensors.speed_edges = 1;
  s.sensors.hall_delay_s = delay_s;
  Measure m = measure(MetricKind::mean, Signal::torque);
  m.from_s = 5.236e-3;  // the last eight of ten turns
  ask(s, m);
  return outcome_of(s).comparisons[0].measured;
}

// At 2 400 electrical rad/s, a delay of 100 us is 13.75 degrees and reduces the torque by the part
// 13.75^2/7200. If the drive corrects the delay, the torque is almost unchanged.
TEST(HallAngle, ADelayThatIsKnownCostsNoTorque) {
  const double prompt = mean_torque_behind_a_filter(HallAngleFrom::sectors, 0);
  const double late = mean_torque_behind_a_filter(HallAngleFrom::sectors, 100e-6);
  const double seen = mean_torque_behind_a_filter(HallAngleFrom::angle, 100e-6);
  const double lost = 13.75 * 13.75 / 7200;
  EXPECT_GT(prompt - late, 0.9 * lost * prompt);
  EXPECT_LT(std::fabs(prompt - seen), 0.1 * lost * prompt);
}

TEST(HallAngle, WhatCannotBeIsRefused) {
  Scenario s = cascade();
  s.sensors.hall_angle = HallAngleFrom::angle;
  ASSERT_FALSE(check(s).empty());
  EXPECT_THAT(to_string(check(s)[0]), HasSubstr("applies to Hall probes"));
  s.sensors.rotor = RotorSensing::hall;
  EXPECT_TRUE(check(s).empty());
  Scenario product = product_scenario(Mode::speed, 100);
  product.sensors.hall_angle = HallAngleFrom::learned_edges;
  ASSERT_FALSE(check(product).empty());
  EXPECT_THAT(to_string(check(product)[0]), HasSubstr("commutates by sectors"));
}

}  // namespace SIXSTEP_TEST_FILE

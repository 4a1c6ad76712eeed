// SPDX-License-Identifier: Apache-2.0
// Tests Hall probes with placement errors in whole runs: the loss of torque, equivalent placements, the
// drive's reaction to glitches, and refused placements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::HallArrangement;
using control::Mode;
using ::testing::HasSubstr;

/// An external drive turns the motor slowly over six electrical turns. The current follows d U - e, except
/// during L/R = 0.56 ms after each edge. With complementary chopping, this relation is linear, so a slow PWM
/// gives the same means.
Scenario on_a_bench(double w_rad_s) {
  Scenario s = maxon_scenario(Mode::duty, 0.1);
  s.load.dynamometer_times_s = {0.0};
  s.load.dynamometer_rad_s = {w_rad_s};
  s.duration_s = 6 * 2 * base::pi / 8 / std::fabs(w_rad_s);
  s.pwm.chopping = control::Chopping::complementary;
  s.pwm.period_s = 0.3e-3;
  ask(s, measure(MetricKind::mean, Signal::torque));
  return s;
}

double mean_torque(Scenario s) { return outcome_of(s).comparisons[0].measured; }

/// The relative mean torque over the sector in which a pair is driven. The back-EMF of the pair, divided by
/// K_e w, is f, and f is 2 on the flat tops. At x degrees beyond the end of the sector, or before its
/// beginning, one phase is x/30 down its ramp. The torque is proportional to f i, and the current i is
/// proportional to d U - f K_e w.
double torque_of(double offset_deg, double w_rad_s) {
  double sum = 0;
  constexpr int steps = 6000;
  for (int n = 0; n < steps; ++n) {
    const double at = 60 * (n + 0.5) / steps + offset_deg, beyond = std::fmax(std::fmax(at - 60, -at), 0.0);
    const double f = 2 - beyond / 30;
    sum += f * (0.1 * 24 - f * 0.01675 * w_rad_s) / steps;
  }
  return sum;
}

TEST(HallOffset, CostsWhatTheRampsTake) {
  const double w = 0.5, plain = mean_torque(on_a_bench(w));
  EXPECT_NEAR(torque_of(15, 0) / torque_of(0, 0), 1 - 15.0 * 15.0 / 7200, 1e-6);
  for (const double offset : {5.0, 15.0, 25.0, 45.0, -15.0}) {
    Scenario s = on_a_bench(w);
    s.sensors.hall_offset_deg = offset;
    EXPECT_TRUE(needs_general_plant(s));
    const double expected = torque_of(offset, w) / torque_of(0, w);
    // L/R is 2e-3 of a sector. A commutation changes the result by less than half of this part.
    EXPECT_NEAR(mean_torque(s) / plain, expected, 1e-3) << offset;
  }
}

// At an offset of 90 degrees, the torques over a sector sum to zero. At 180 degrees, the torque is reversed,
// and the back-EMF increases the current.
TEST(HallOffset, TurnsTheTorqueRound) {
  const double plain = mean_torque(on_a_bench(0.5));
  Scenario s = on_a_bench(0.5);
  s.sensors.hall_offset_deg = 90;
  EXPECT_NEAR(mean_torque(s) / plain, 0, 4e-3);
  s.sensors.hall_offset_deg = 180;
  const double d_U = 2.4, e = 2 * 0.01675 * 0.5;
  EXPECT_NEAR(mean_torque(s) / plain, -(d_U + e) / (d_U - e), 1e-3);
}

// At constant speed, a delay is equivalent to an angle, and so is half of a hysteresis.
TEST(HallDelay, IsAnOffsetAtConstantSpeed) {
  const double w = 200, delay_s = 50e-6, deg = 8 * w * delay_s * 180 / base::pi;
  Scenario late = on_a_bench(w);
  late.initial.angle_rad = 40 * base::pi / 180 / 8;  // within sector 0, and before the edge with either
                                                     // offset
  Scenario askew = late, sticky = late;
  late.sensors.hall_delay_s = delay_s;
  askew.sensors.hall_offset_deg = deg;
  sticky.sensors.hall_hysteresis_deg = 2 * deg;
  const double torque = mean_torque(askew);
  EXPECT_GT(std::fabs(torque / mean_torque(on_a_bench(w)) - 1), 1e-3);
  EXPECT_NEAR(mean_torque(late), torque, 1e-9);
  EXPECT_NEAR(mean_torque(sticky), torque, 1e-9);
}

/// The same scenario with all probes listed and placement errors of zero, so that the run uses the general
/// kernel.
Scenario in_place(Scenario s) {
  s.sensors.hall_edges_deg = std::vector<double>(6, 0.0);
  return s;
}

TEST(HallProbes, InTheirPlacesAreTheSectors) {
  for (Scenario s : {cascade(), hysteresis(), product_scenario(Mode::speed, 100.0)}) {
    ask(s, measure(MetricKind::final_value, Signal::speed));
    ask(s, measure(MetricKind::rms, Signal::current));
    const Outcome plain = outcome_of(s), mounted = outcome_of(in_place(s));
    for (std::size_t n = 0; n < 2; ++n)
      EXPECT_NEAR(mounted.comparisons[n].measured, plain.comparisons[n].measured, 1e-8) << n;
  }
}

TEST(HallProbes, SixtyDegreesApartDriveAsThoseOf120) {
  for (Scenario s : {cascade(), product_scenario(Mode::speed, 100.0)}) {
    s = in_place(s);
    ask(s, measure(MetricKind::final_value, Signal::speed));
    const Outcome plain = outcome_of(s);
    s.sensors.hall_spacing = HallArrangement::degrees_60;
    const Outcome sixty = outcome_of(s);
    EXPECT_EQ(sixty.comparisons[0].measured, plain.comparisons[0].measured);
    EXPECT_FALSE(sixty.trip) << "the product drive knows the arrangement";
  }
}

TEST(HallGlitches, AreDrawnBySeedAndSeenByTheDrive) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.1;
  s.sensors.hall_glitches_Hz = 300;
  s.sensors.hall_glitch_s = 2e-6;
  const Outcome first = outcome_of(s), again = outcome_of(s);
  EXPECT_EQ(first.digest, again.digest);
  s.sensors.seed = 1;
  EXPECT_NE(outcome_of(s).digest, first.digest);
  // If the interrupt reads a glitch, the code is impossible or jumps. If two equal samples are required, the
  // glitch has no effect.
  ASSERT_TRUE(first.trip);
  s.sensors.hall_stable_samples = 2;
  EXPECT_FALSE(outcome_of(s).trip);
}

TEST(HallPlacement, WhatCannotBeIsRefused) {
  const auto refused = [](auto&& change) -> std::string {
    Scenario s = maxon_scenario(Mode::duty, 0.5);
    change(s.sensors);
    const base::Problems problems = check(s);
    return problems.empty() ? "nothing" : to_string(problems[0]);
  };
  EXPECT_THAT(refused([](Sensors& s) {
                s.hall_edges_deg = {1, 2, 3};
              }),
              HasSubstr("must have 6 (edges of an electrical turn)"));
  EXPECT_EQ(refused([](Sensors& s) { s.hall_edges_deg = std::vector<double>(48, 1.0); }), "nothing");
  EXPECT_THAT(refused([](Sensors& s) { s.hall_edges_deg = {0, 30, -30, 0, 0, 0}; }),
              HasSubstr("at least 1 deg is needed"));
  EXPECT_THAT(refused([](Sensors& s) { s.hall_edges_deg = {-30, 0, 0, 0, 0, 30}; }), HasSubstr("[0]"));
  EXPECT_THAT(refused([](Sensors& s) { s.hall_glitches_Hz = 1e8; }), HasSubstr("100000 glitches"));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The measurement starts at the end of the scenario. The drive has settled by then, in the mode that the last
// event has set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/analysis/bode/bode_study.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::BodeStudy;

/// The largest |L/L' - 1| over the points at which the gain of `one` is 0.3 to 5. L and L' are the measured
/// loops of `one` and `other`.
double apart(const BodeStudy& one, const BodeStudy& other) {
  double worst = 0.0;
  EXPECT_EQ(one.points.size(), other.points.size());
  for (std::size_t k = 0; k < one.points.size() && k < other.points.size(); ++k) {
    const analysis::LoopPoint &p = one.points[k], &q = other.points[k];
    if (p.gain < 0.3 || p.gain > 5) continue;
    const double turn = p.phase_rad - q.phase_rad, ratio = p.gain / q.gain;
    worst = std::max(worst, std::hypot(ratio * std::cos(turn) - 1, ratio * std::sin(turn)));
  }
  return worst;
}

study::Scenario both_ways() {
  study::Scenario s = cascade(0.1);
  s.pwm.chopping = control::Chopping::complementary;
  return s;
}

study::At change(double time_s, double reference) {
  study::At at;
  at.time_s = time_s;
  at.reference.emplace();
  at.reference->value = reference;
  return at;
}

/// The drive first controls the current, then the speed. The measurement and the design both refer to the
/// speed loop.
TEST(BodeAtTheEnd, TheLoopIsThatOfTheLastMode) {
  const study::Scenario from_the_start = both_ways();
  study::Scenario later = from_the_start;
  later.control.mode = control::Mode::current;
  later.reference.value = 1.0;
  later.at.push_back(change(0.01, from_the_start.reference.value));
  later.at[0].control.mode = study::AtMode::speed;
  const auto one = analysis::study_bode(from_the_start), other = analysis::study_bode(later);
  ASSERT_TRUE(one) << to_string(one.problems()[0]);
  ASSERT_TRUE(other) << to_string(other.problems()[0]);
  EXPECT_EQ(other->mode, control::Mode::speed);
  ASSERT_TRUE(one->figures && other->figures);
  EXPECT_EQ(*one->figures->crossover_rad_s, *other->figures->crossover_rad_s);
  EXPECT_LT(apart(*one, *other), 0.02);
}

/// The designed loop uses the gains that an event sets.
TEST(BodeAtTheEnd, TheDesignedLoopHasTheLastGains) {
  study::Scenario later = both_ways();
  later.at.push_back(change(0.01, later.reference.value));
  later.at[0].control.speed.settle_s = 20e-3;
  study::Scenario from_the_start = both_ways();
  from_the_start.control.speed.settle_s = 20e-3;
  const auto one = analysis::study_bode(from_the_start), other = analysis::study_bode(later);
  ASSERT_TRUE(one) << to_string(one.problems()[0]);
  ASSERT_TRUE(other) << to_string(other.problems()[0]);
  ASSERT_TRUE(one->figures && other->figures);
  EXPECT_EQ(*one->figures->crossover_rad_s, *other->figures->crossover_rad_s);
  EXPECT_LT(apart(*one, *other), 0.02);
}

std::string problem_of(const study::Scenario& s) {
  const auto b = analysis::study_bode(s);
  return b ? "measured" : b.problems()[0].where + ": " + b.problems()[0].limit;
}

/// A slew rate or a ramp hides the loop, whether it is set from the start or by an event. Both are refused.
TEST(BodeAtTheEnd, AnEventsSlewAndRampAreRefused) {
  study::Scenario slewed = both_ways();
  slewed.at.push_back(change(0.01, slewed.reference.value));
  slewed.at[0].control.slew = 1000.0;
  EXPECT_EQ(
      problem_of(slewed),
      "control.slew: limits how fast the setpoint changes, so that the response of the loop cannot be measured");
  study::Scenario off = both_ways();
  off.at.push_back({});
  off.at[0].time_s = 0.05;
  off.at[0].control.mode = study::AtMode::off;
  EXPECT_EQ(problem_of(off), "control.mode: has no loop to measure");
  study::Scenario ramp = both_ways();
  ramp.at.push_back(change(0.01, 0.0));
  ramp.at[0].reference->shape = study::Shape::ramp;
  ramp.at[0].reference->end = 200;
  ramp.at[0].reference->begin_s = 0.01;
  ramp.at[0].reference->end_s = 0.1;
  EXPECT_EQ(problem_of(ramp),
            "reference: moves until 0.11 s, and the measurement begins where the run ends, at 0.1 s");
  ramp.at[0].reference->end_s = 0.05;
  EXPECT_EQ(problem_of(ramp), "measured");
}

/// The evaluation skips the first period of the multisine. This period is as long as thirty periods of the
/// crossover frequency, and the response to a step decays within it.
TEST(BodeAtTheEnd, AStepJustBeforeTheEndChangesNothing) {
  study::Scenario rested = both_ways();
  rested.at.push_back(change(0.02, 120.0));
  study::Scenario stepped = rested;
  stepped.at[0].time_s = 0.0999;
  const auto one = analysis::study_bode(rested), other = analysis::study_bode(stepped);
  ASSERT_TRUE(one) << to_string(one.problems()[0]);
  ASSERT_TRUE(other) << to_string(other.problems()[0]);
  EXPECT_LT(apart(*one, *other), 0.02);
}

/// At the end of a ramp, the speed lags less than after a step, so the measured loop is equal to the loop of
/// a settled drive. A ramp that is longer than the run is refused. The duration that the message proposes is
/// accepted.
TEST(BodeAtTheEnd, ARampThatEndsWithTheRunIsMeasured) {
  study::Scenario rested = both_ways();
  rested.reference.value = 200;
  study::Scenario ramp = both_ways();
  ramp.reference = {.shape = study::Shape::ramp, .end = 200, .end_s = ramp.duration_s};
  study::Scenario profile = both_ways();
  profile.reference = {.shape = study::Shape::trapezoid, .end = 200, .slope = 4000, .acceleration = 80e3};
  const auto one = analysis::study_bode(rested);
  ASSERT_TRUE(one) << to_string(one.problems()[0]);
  for (const study::Scenario& s : {ramp, profile}) {
    const auto other = analysis::study_bode(s);
    ASSERT_TRUE(other) << to_string(other.problems()[0]);
    EXPECT_EQ(other->stands_at, 200.0);
    EXPECT_LT(apart(*one, *other), 0.02);
  }
  for (study::Scenario s : {ramp, profile}) {
    s.duration_s = 0.07;
    const auto refused = analysis::study_bode(s);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.problems()[0].where, "reference");
    const std::string& cure = refused.problems()[0].cure;
    ASSERT_TRUE(cure.starts_with("set duration_s = ")) << cure;
    s.duration_s = std::stod(cure.substr(std::string("set duration_s = ").size()));
    EXPECT_EQ(problem_of(s), "measured");
  }
}

/// At 0.195 N m, 2.5 times the nominal torque, the inertia of 1e-2 kg m^2 needs 20 s to reach 400 rad/s. The
/// speed therefore still increases during the measurement. A straight ramp has the same spectrum in every
/// period: the coherence is 1, although the measurement contains only the ramp.
TEST(BodeAtTheEnd, ADriveOnItsWayIsRefused) {
  study::Scenario s = both_ways();
  s.load.inertia_kg_m2 = 1e-2;
  s.reference.value = 400;
  const std::string told = problem_of(s);
  EXPECT_TRUE(told.starts_with(
      "duration_s: ends while the drive still moves towards 400 rad/s: during the measurement the controlled value went from "))
      << told;
  EXPECT_NE(told.find(" in each period of a multisine of +-20 rad/s"), std::string::npos) << told;
  s.load.inertia_kg_m2 = 0.0;
  EXPECT_EQ(problem_of(s), "measured");
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Tests the two forms of the speed controller, its derivative, and its torque limit, in the full switching
// simulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::MetricKind;
using study::Scenario;
using study::Signal;
using study::SpeedForm;
using ::testing::HasSubstr;

constexpr double T = 30e-6, K_t = 0.0335, J = 1.35e-5, B = 7.3e-6;

/// The speed at every tick. Any difference between two controllers appears in it.
std::vector<double> course(Scenario s) {
  s.record.columns = {"speed_rad_s"};
  std::vector<double> all;
  const auto out = study::run(s, {.on_record = [&](study::Row row) { all.push_back(row[1]); }});
  EXPECT_TRUE(out && !out->fault);
  return all;
}

/// Largest difference divided by the largest value.
double difference(const Scenario& a, const Scenario& b) {
  const std::vector<double> x = course(a), y = course(b);
  EXPECT_EQ(x.size(), y.size());
  double largest = 0.0, apart = 0.0;
  for (std::size_t n = 0; n < std::min(x.size(), y.size()); ++n) {
    largest = std::max(largest, std::fabs(x[n]));
    apart = std::max(apart, std::fabs(x[n] - y[n]));
  }
  std::printf("apart by %.2g of the largest speed\n", apart / largest);
  return apart / largest;
}

double first_figure(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured : -1e9;
}

/// The reference is first 900 rad/s, which the drive cannot reach at 24 V, and then 300 rad/s. The torque
/// limit is 0.1 N m, which is 2.985 A.
Scenario out_of_reach() {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.2;
  s.pwm.chopping = control::Chopping::complementary;
  s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.1}, .values = {900.0, 300.0}};
  s.control.speed.settle_s = 20e-3;
  s.control.speed.damping = 0.9;
  s.control.speed.torque_limit_Nm = 0.1;
  return s;
}

// Bound on the difference of two controllers that compute the same values in another order. It is some ten
// roundings of 1.1e-16 per tick, in at most 6700 ticks, if all have the same sign.
constexpr double rounding = 10 * 6700 * 1.1e-16;

TEST(SpeedForm, ShortOfTheLimitBothFormsAreOneController) {
  Scenario s = maxon_scenario(Mode::speed, 20.0);
  Scenario positional = s;
  positional.control.speed.form = SpeedForm::positional;
  EXPECT_LT(difference(s, positional), rounding);
}

TEST(SpeedForm, AnIntegralThatFollowsAtOnceIsTheIncrementalForm) {
  // With K_b = 1, the integral is I[n+1] = K_i e + u - K e (output u, error e, gains K and K_i). Therefore
  // u[n+1] = u + K (e[n+1] - e) + K_i e, with and without a limit.
  Scenario s = out_of_reach();
  Scenario positional = s;
  positional.control.speed.form = SpeedForm::positional;
  positional.control.speed.anti_windup = 1.0;
  EXPECT_LT(difference(s, positional), rounding);
  positional.control.speed.anti_windup = 0.0;
  EXPECT_GT(difference(s, positional), 0.1) << "it goes on when told to slow down";
}

TEST(SpeedForm, AFreeIntegralMakesUpForEveryDegreeItLost) {
  // The integral ends at the torque for 300 rad/s, which is B 300/0.1 N m of the limit. For any course of the
  // speed, the sum of all errors is this value divided by K_i. Between two samples, 0.1 N m changes the speed
  // by at most 0.1 T/J. Over 0.8 s, the sum of the errors is therefore equal to the missing angle, within
  // half of this change.
  Scenario s = out_of_reach();
  s.duration_s = 0.8;  // the speed oscillates until 0.5 s
  s.control.speed.form = SpeedForm::positional;
  s.control.speed.anti_windup = 0.0;
  ask(s, measure(MetricKind::final_value, Signal::position));
  const auto compiled = study::compile(s);
  const double K_i = compiled->drive.extras.speed.K_i, asked = 900.0 * 0.1 + 300.0 * 0.7;
  const double owed = B * 300.0 / 0.1 * T / K_i;
  EXPECT_NEAR(first_figure(s) * base::pi / 180, asked - owed, 0.1 / J * T / 2 * s.duration_s);
  s.control.speed.anti_windup = std::nullopt;
  EXPECT_LT(first_figure(s) * base::pi / 180, asked - 10.0) << "what the limit cut off stays cut off";
}

TEST(SpeedForm, DerivativeTimeAddsToTheTimeConstantOfAP) {
  // The equation J w' = T_max K (w_ref - w - T_d w') - B w gives the time constant tau = J/(T_max K + B) +
  // T_d T_max K/(T_max K + B). The current follows within the settling time of its loop, 1 ms.
  const double T_max = 0.78, K = J / 20e-3 / T_max, share = T_max * K / (T_max * K + B);
  Scenario s = maxon_scenario(Mode::speed, 300.0);
  s.duration_s = 0.1;
  s.pwm.alignment = study::Alignment::centre;  // sampled in the middle: the reading is the mean current, at
                                               // any ripple
  s.pwm.sample = study::SampleAt::middle;
  s.control.speed.kp = K;
  s.control.speed.ki = 0.0;
  s.control.speed.form = SpeedForm::positional;
  study::Measure m = measure(MetricKind::reach_time, Signal::speed);
  m.level = 300.0 * share;
  m.start = 0.0;
  m.fraction = 1 - std::exp(-1.0);
  ask(s, m);
  const double without = first_figure(s);
  s.control.speed.derivative_s = 20e-3;
  s.control.speed.derivative_filter_s = 0.0;
  const double with = first_figure(s);
  std::printf("time constant %.5g s, with derivative %.5g s\n", without, with);
  EXPECT_NEAR(without, 20e-3 * share, 1e-3);
  EXPECT_NEAR(with, 40e-3 * share, 1e-3);
}

TEST(SpeedForm, ALimitOfTheCurrentIsTheSpeedControllersOwn) {
  // In one scenario, the torque at full output is 0.1 N m. In the other scenario, the current limit is 0.1 N
  // m/K_t, which is below the stall current. The design scales the gains by the torque, so both controllers
  // are equal.
  Scenario by_torque = out_of_reach(), by_current = by_torque;
  by_current.control.speed.torque_limit_Nm = 0.78;
  by_current.control.current.limit_A = 0.1 / K_t;
  EXPECT_LT(difference(by_torque, by_current), rounding);
  EXPECT_DOUBLE_EQ(study::compile(by_current)->drive.speed.limit, 0.1 / 0.78);
  by_current.control.current.limit_A = 30.0;  // exceeds the 23.3 A of full torque
  EXPECT_EQ(study::compile(by_current)->drive.speed.limit, 1.0);
}

TEST(SpeedForm, SaysWhatOnlyThePositionalFormHas) {
  Scenario s = maxon_scenario(Mode::speed, 50.0);
  s.control.speed.anti_windup = 0.5;
  s.control.speed.derivative_s = 1e-3;
  const base::Problems incremental = study::check(s);
  ASSERT_EQ(incremental.size(), 2u);
  EXPECT_THAT(
      to_string(incremental[0]),
      HasSubstr("control.speed.anti_windup = 0.5 applies only to control.speed.form = \"positional\"; set "
                "control.speed.form = \"positional\""));
  s.control.speed.form = SpeedForm::positional;
  EXPECT_TRUE(study::check(s).empty());
  s.control.speed.derivative_s = std::nullopt;
  s.control.speed.derivative_filter_s = 1e-3;
  ASSERT_EQ(study::check(s).size(), 1u);
  EXPECT_THAT(to_string(study::check(s)[0]), HasSubstr("no effect without control.speed.derivative_s"));
}

}  // namespace SIXSTEP_TEST_FILE

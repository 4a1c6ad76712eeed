// SPDX-License-Identifier: Apache-2.0
// Tests deadbeat current control and the feedback of the staying phase's current on the switching motor. The
// figures are the number of periods of a step, and the remaining ripple of commutation.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::CurrentFeedback;
using study::CurrentLoopType;
using study::MetricKind;
using study::Scenario;
using study::Signal;

double first_figure(const Scenario& s) {
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  EXPECT_FALSE(out && out->fault);
  return out ? out->comparisons[0].measured : -1e9;
}

/// With a locked rotor, a step of 1 A is complete after the delay and one period. A pulse at the beginning of
/// its period and a voltage over the whole period have different effects. The difference is at most R T/L of
/// the step (resistance R, period T, inductance L).
TEST(Deadbeat, AStepIsThereAPeriodAfterTheAnswerBegins) {
  for (const auto arithmetic : {study::Arithmetic::float64, study::Arithmetic::float32,
                                study::Arithmetic::q15, study::Arithmetic::q31})
    for (const int delay : {0, 1}) {
      Scenario s = maxon_scenario(Mode::current, 1.0);
      s.load.locked = true;
      s.pwm.delay_periods = delay;
      s.control.arithmetic = arithmetic;
      s.control.current.type = CurrentLoopType::deadbeat;
      s.duration_s = (1 + delay) * s.pwm.period_s + 1e-9;
      study::Measure last = measure(MetricKind::maximum, Signal::current);
      ask(s, last);
      const double x = 1.03 * 30e-6 / 0.572e-3;
      EXPECT_NEAR(first_figure(s), 1.0, x) << delay;
      s.duration_s -= 30e-6;
      EXPECT_LT(first_figure(s), delay == 0 ? 1e-4 : 0.1);
    }
}

struct Torque {
  double most, least, ripple_rms;
};

/// An external drive turns the motor at 150 rad/s. The drive controls 3 A, which is 0.1 N m, with
/// complementary chopping.
Torque torque_of(CurrentLoopType type, CurrentFeedback feedback) {
  Scenario s = maxon_scenario(Mode::current, 3.0);
  s.pwm.chopping = control::Chopping::complementary;
  s.load.dynamometer_times_s = {0.0};
  s.load.dynamometer_rad_s = {150.0};
  s.control.current.type = type;
  s.control.current.feedback = feedback;
  for (const MetricKind metric : {MetricKind::maximum, MetricKind::minimum, MetricKind::ripple_rms}) {
    study::Measure figure = measure(metric, Signal::torque);
    figure.from_s = 5e-3;
    ask(s, figure);
  }
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? Torque{out->comparisons[0].measured, out->comparisons[1].measured,
                      out->comparisons[2].measured}
             : Torque{};
}

/// A commutation halves the mean of the new pair's currents. A loop that measures this mean reacts at once:
/// the deadbeat loop within a period, the PI controller within its settling time. The staying phase's current
/// is proportional to the present torque, but it does not predict the dip.
TEST(Deadbeat, TakesOffTheRippleOfCommutation) {
  using enum CurrentFeedback;
  const Torque pi = torque_of(CurrentLoopType::pi, mean),
               pi_told = torque_of(CurrentLoopType::pi, staying_phase),
               deadbeat = torque_of(CurrentLoopType::deadbeat, mean),
               deadbeat_told = torque_of(CurrentLoopType::deadbeat, staying_phase);
  for (const Torque& t : {pi, pi_told, deadbeat, deadbeat_told})
    std::printf("%.4g to %.4g N m, rms %.3g\n", t.least, t.most, t.ripple_rms);
  EXPECT_LT(deadbeat.ripple_rms, 0.6 * pi.ripple_rms);
  EXPECT_GT(deadbeat.least, pi.least);
  EXPECT_LT(pi_told.least, pi.least) << "without the push the dip is deeper";
  EXPECT_LT(deadbeat_told.ripple_rms, 0.6 * pi_told.ripple_rms);
  EXPECT_LT(deadbeat_told.most, deadbeat.most) << "and nothing is pushed too far behind it";
}

TEST(Deadbeat, WhatItLacksIsRefusedWithACure) {
  Scenario s = maxon_scenario(Mode::current, 1.0);
  s.control.current.type = CurrentLoopType::deadbeat;
  EXPECT_TRUE(study::check(s).empty());
  const auto refused = [&](auto change, const char* where) {
    Scenario wrong = s;
    change(wrong);
    const base::Problems problems = study::check(wrong);
    ASSERT_FALSE(problems.empty()) << where;
    EXPECT_EQ(problems[0].where, where);
    EXPECT_FALSE(problems[0].cure.empty());
  };
  refused([](Scenario& x) { x.control.current.settle_s = 1e-3; }, "control.current.settle_s");
  refused([](Scenario& x) { x.control.current.damping = 0.9; }, "control.current.damping");
  refused([](Scenario& x) { x.control.current.d1 = 1, x.control.current.d0 = -0.9; }, "control.current.d1");
  refused([](Scenario& x) { x.control.current.kp = 1, x.control.current.ki = 0.1; }, "control.current.kp");
  refused([](Scenario& x) { x.control.current.back_emf_feed_forward = true; },
          "control.current.back_emf_feed_forward");
  refused(
      [](Scenario& x) { x.control.current.type = CurrentLoopType::pi, x.control.current.correction = 0.5; },
      "control.current.correction");
  refused(
      [](Scenario& x) {
        x.control.current.type = CurrentLoopType::hysteresis;
        x.control.current.feedback = CurrentFeedback::staying_phase;
      },
      "control.current.feedback");
  s.pwm.delay_periods = 1;
  s.pwm.sample = study::SampleAt::middle;
  const auto late = study::compile(s);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.problems()[0].where, "control.current.type");
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Changes [[at]] of gains, limits, mode, chopping and dead time. The tests check the instant of the change,
// equivalent scenarios, and the refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

Outcome outcome(const Scenario& s) {
  const auto out = run(s, {.keep_books = false});
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? *out : Outcome{};
}

/// A change at t = 0 is equivalent to a scenario that has the changed values from the start.
TEST(Tunings, AtTheStartTheyAreTheScenariosOwn) {
  for (const Arithmetic arithmetic : {Arithmetic::float64, Arithmetic::float32})
    for (Scenario plain : {cascade(12e-3), product_scenario(Mode::speed, 100.0)}) {
      plain.control.arithmetic = arithmetic;
      Scenario own = plain, told = plain;
      At at;
      own.control.current.settle_s = at.control.current.settle_s = 1.7e-3;
      own.control.speed.damping = at.control.speed.damping = 0.6;
      own.control.limits.current_A = at.control.limits.current_A = 8.0;
      own.pwm.chopping = control::Chopping::complementary;
      at.pwm.chopping = AtChopping::complementary;
      own.bridge.dead_time_s = 1e-6;
      at.bridge.dead_time_s = 1e-6;
      told.at = {at};
      EXPECT_EQ(outcome(told).digest, outcome(own).digest);
      EXPECT_NE(outcome(told).digest, outcome(plain).digest);
    }
}

TEST(Tunings, AModeAtTheStartIsTheScenariosOwn) {
  Scenario own = cascade(12e-3), told = own;
  told.control.mode = Mode::duty;
  told.reference.value = 0.3;
  At at;
  at.control.mode = AtMode::speed;
  at.reference = Reference{.value = 100.0};
  told.at = {at};
  EXPECT_EQ(outcome(told).digest, outcome(own).digest);
}

/// A change between two samples acts at the next sample. This is also true if the samples are in the middle
/// of a period.
TEST(Tunings, ActFromTheNextSampleOn) {
  for (const SampleAt sample : {SampleAt::start, SampleAt::middle}) {
    Scenario s = cascade(12e-3);
    s.pwm.sample = sample;
    At at;
    at.control.current.settle_s = 2e-3;
    at.control.mode = AtMode::current;
    at.reference = Reference{.value = 3.0};
    const double on = 34 * 30e-6 + (sample == SampleAt::middle ? 15e-6 : 0.0);
    const auto changed_at = [&](double time_s) {
      at.time_s = time_s;
      s.at = {at};
      return outcome(s).digest;
    };
    const std::uint64_t digest = changed_at(on);
    EXPECT_EQ(changed_at(on - 1e-12), digest);
    EXPECT_EQ(changed_at(on - 29.9e-6), digest);
    EXPECT_NE(changed_at(on + 1e-12), digest);
    EXPECT_NE(changed_at(on - 30e-6), digest);
  }
}

TEST(Tunings, EveryModeIsReachedFromEveryOther) {
  const struct {
    AtMode mode;
    double reference;
    MetricKind kind;
    Signal signal;
    double expected, tolerance;
  } goals[] = {{AtMode::off, 0.0, MetricKind::final_value, Signal::phase_a, 0.0, 0.0},
               {AtMode::duty, 0.5, MetricKind::mean, Signal::speed, 12.0 / 33.5e-3, 20.0},
               {AtMode::current, 1.0, MetricKind::mean, Signal::current, 1.0, 0.25},
               {AtMode::speed, 150.0, MetricKind::mean, Signal::speed, 150.0, 2.0},
               {AtMode::position, 720.0, MetricKind::final_value, Signal::position, 720.0, 3.0}};
  for (const auto& from : goals)
    for (const auto& to : goals) {
      if (from.mode == to.mode) continue;
      Scenario s = cascade(12e-3);
      // with a controlled current, the final speed must be below the highest speed that the bus allows
      s.load.viscous_Nm_s = 2e-4;
      s.control.mode = static_cast<Mode>(static_cast<int>(from.mode) - 1);
      s.reference.value = from.reference;
      s.duration_s = 1.0;
      s.control.position.gain_rad_s_per_deg = 0.5;
      At at;
      at.time_s = 20e-3;
      at.control.mode = to.mode;
      if (to.mode != AtMode::off) at.reference = Reference{.value = to.reference};
      s.at = {at};
      Measure m = measure(to.kind, to.signal);
      m.from_s = 0.9;
      ask(s, m);
      const Outcome out = outcome(s);
      ASSERT_EQ(out.comparisons.size(), 1u);
      if (to.mode == AtMode::duty) continue;  // the final speed depends on the friction
      EXPECT_NEAR(out.comparisons[0].measured, to.expected, to.tolerance)
          << int(from.mode) << " to " << int(to.mode);
    }
}

TEST(Tunings, ALowerLimitHoldsFromThereOn) {
  Scenario s = cascade(12e-3);
  s.control.limits.current_A = 10.0;
  At at;
  at.time_s = 2e-3;
  at.control.limits.current_A = 3.0;
  s.at = {at};
  Measure before = measure(MetricKind::maximum, Signal::current), after = before;
  before.to_s = 2e-3;
  after.from_s = 4e-3;
  ask(s, before);
  ask(s, after);
  const Outcome out = outcome(s);
  EXPECT_GT(out.comparisons[0].measured, 6.0);
  EXPECT_LT(out.comparisons[1].measured, 1.25 * 3.0 + 24.0 / 0.572e-3 * 30e-6);
}

std::string refused_at(const Scenario& s) {
  const base::Problems problems = check(s);
  if (problems.empty()) return "";
  EXPECT_FALSE(problems[0].cure.empty());
  return problems[0].where;
}

TEST(Tunings, WhatCannotBeIsRefusedAtItsKey) {
  const auto with = [](const auto& fill) {
    Scenario s = cascade(12e-3);
    At at;
    at.time_s = 1e-3;
    fill(s, at);
    s.at = {at};
    return refused_at(s);
  };
  EXPECT_EQ(with([](Scenario&, At& at) { at.control.current.d1 = 1.0; }), "at[0].control.current.d1");
  EXPECT_EQ(with([](Scenario&, At& at) { at.control.current.settle_s = 1e-6; }),
            "at[0].control.current.settle_s");
  EXPECT_EQ(with([](Scenario&, At& at) { at.control.current.band_A = 1.0; }), "at[0].control.current.band_A");
  EXPECT_EQ(with([](Scenario&, At& at) { at.control.mode = AtMode::current; }), "at[0].control.mode");
  EXPECT_EQ(with([](Scenario&, At& at) { at.control.mode = AtMode::speed; }), "at[0].control.mode");
  EXPECT_EQ(with([](Scenario&, At& at) {
              at.control.mode = AtMode::current;
              at.reference = Reference{.shape = Shape::ramp, .end = 3.0, .slope = 1e3};
            }),
            "at[0].reference");
  EXPECT_EQ(with([](Scenario&, At& at) {
              at.control.mode = AtMode::duty;
              at.reference = Reference{.value = 1.5};
            }),
            "at[0].reference.value");
  EXPECT_EQ(with([](Scenario& s, At& at) {
              s.control.slew = 1e3;
              at.control.mode = AtMode::current;
              at.reference = Reference{.value = 1.0};
            }),
            "at[0].control.mode");
  EXPECT_EQ(with([](Scenario&, At& at) { at.bridge.dead_time_s = 40e-6; }), "at[0].bridge.dead_time_s");
  EXPECT_EQ(with([](Scenario& s, At& at) {
              s.control.smooth_chopping.on = true;
              at.pwm.chopping = AtChopping::hard;
            }),
            "at[0].pwm.chopping");
  EXPECT_EQ(with([](Scenario& s, At& at) {
              ask(s, measure(MetricKind::settling_time, Signal::speed));
              at.control.mode = AtMode::current;
              at.reference = Reference{.value = 1.0};
            }),
            "compare[0].level");
  EXPECT_EQ(with([](Scenario&, At&) {}), "at[0].time_s");
}

/// A product that aligns or brakes needs a current loop in every mode of the run.
TEST(Tunings, AProductThatAlignsKeepsACurrentLoop) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.protection.align.current_A = 3.0;
  EXPECT_EQ(refused_at(s), "");
  At at;
  at.time_s = 1e-3;
  at.control.mode = AtMode::duty;
  at.reference = Reference{.value = 0.2};
  s.at = {at};
  EXPECT_EQ(refused_at(s), "protection.align.current_A");
}

/// The mode in which a reference applies determines its unit and its limits.
TEST(Tunings, AReferenceIsOfTheModeThatItStandsIn) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  At faster;
  faster.time_s = 1e-3;
  faster.reference = Reference{.value = 80.0};
  s.at = {faster};
  EXPECT_EQ(refused_at(s), "at[0].reference.value");
  At speed;
  speed.time_s = 0.5e-3;
  speed.control.mode = AtMode::speed;
  speed.reference = Reference{.value = 50.0, .unit = "rad/s"};
  s.at = {faster, speed};  // the order of the events is free
  EXPECT_EQ(refused_at(s), "");
}

}  // namespace SIXSTEP_TEST_FILE

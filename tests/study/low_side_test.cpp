// SPDX-License-Identifier: Apache-2.0
// Low-side shunts in whole runs. The share of control periods without a valid sample is that of the duty's
// arithmetic, in six-step by sectors and in the field-oriented drive period by period. Two shunts lose a current that
// three keep. Refusals, remarks and extreme values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/low_side_limits.hpp"
#include "sixstep/study/scenario/low_side_window.hpp"
#include "tests/support/field_ticks.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

Scenario with_shunts(Scenario s, ShuntLegs shunts) {
  s.sensors.currents = rig::CurrentMeasurement::low_side;
  s.sensors.shunts = shunts;
  s.sensors.current_range_A = 40.0;
  return s;
}

Scenario turned_at(Scenario s, double rad_s) {
  s.load.dynamometer_times_s = {0.0, 1.0};
  s.load.dynamometer_rad_s = {rad_s, rad_s};
  return s;
}

/// Six-step with a constant duty over two electrical turns, 100 periods a sector.
Scenario six_step(ShuntLegs shunts, double duty) {
  Scenario s = with_shunts(maxon_scenario(Mode::duty, duty), shunts);
  s.pwm.alignment = Alignment::centre;
  s.duration_s = 12 * 100 * s.pwm.period_s;
  return turned_at(s, base::sector_rad / 8 / (100 * s.pwm.period_s));
}

double blind_share(const Scenario& s) {
  const auto out = run(s);
  if (!out) {
    ADD_FAILURE() << to_string(out.problems()[0]);
    return -1;
  }
  EXPECT_FALSE(out->fault);
  return static_cast<double>(out->blind_samples) / static_cast<double>(out->shunt_samples);
}

/// The sink's lower switch stays on: its shunt shows the current always, the source's up to a duty of 1 - 2 us/30 us.
/// Each leg is the sink in a third of the sectors, the source in a third and free in a third.
TEST(LowSide, SixStepIsBlindInTheSectorsOfTheArithmetic) {
  using enum ShuntLegs;
  struct Case {
    ShuntLegs shunts;
    double below, above;  // share of blind periods at duties below and above the limit
  };
  for (const Case& c : {Case{abc, 0, 0}, Case{ab, 0, 1 / 3.0}, Case{bc, 0, 1 / 3.0}, Case{ac, 0, 1 / 3.0},
                        Case{a, 1 / 3.0, 2 / 3.0}, Case{b, 1 / 3.0, 2 / 3.0}, Case{c, 1 / 3.0, 2 / 3.0}})
    for (const double sign : {1.0, -1.0}) {
      const double edges = 14.0 / 1200;  // at each sector edge a sample may belong to either sector
      EXPECT_NEAR(blind_share(six_step(c.shunts, sign * 0.92)), c.below, edges) << int(c.shunts) << sign;
      EXPECT_NEAR(blind_share(six_step(c.shunts, sign * 0.94)), c.above, edges) << int(c.shunts) << sign;
    }
}

/// The lower switch is chopped: its current freewheels above, and after a pulse no shunt shows it. A sample in the
/// middle of a centred pulse shows it.
TEST(LowSide, ALowerSwitchThatIsChoppedIsShownInItsPulse) {
  Scenario s = six_step(ShuntLegs::abc, 0.5);
  s.pwm.pattern = control::PwmPattern::lower;
  EXPECT_EQ(blind_share(s), 1.0);
  s.pwm.sample = SampleAt::middle;
  EXPECT_EQ(blind_share(s), 0.0);
  s.reference.value = 0.06;  // below 2 us/30 us
  EXPECT_EQ(blind_share(s), 1.0);
}

/// In the held rotor the loop controls the sampled current to 5 A, in every arithmetic.
TEST(LowSide, TheCurrentLoopHoldsItsReferenceByTheSinksShunt) {
  for (const Arithmetic arithmetic :
       {Arithmetic::float64, Arithmetic::float32, Arithmetic::q14, Arithmetic::q30})
    for (const ShuntLegs shunts : {ShuntLegs::abc, ShuntLegs::ab, ShuntLegs::b}) {
      Scenario s = with_shunts(maxon_scenario(Mode::current, 5.0), shunts);
      s.load.locked = true;
      s.initial.angle_rad = 0.02;  // the pair a to b
      s.control.arithmetic = arithmetic;
      s.pwm.alignment = Alignment::centre;
      Measure m = measure(MetricKind::mean, Signal::current);
      m.from_s = 10e-3;
      ask(s, m);
      const auto out = run(s);
      ASSERT_TRUE(out) << to_string(out.problems()[0]);
      EXPECT_NEAR(out->comparisons[0].measured, 5.0, 80.0 / 4096) << int(arithmetic) << int(shunts);
      EXPECT_EQ(out->blind_samples, 0);
    }
}

/// The 251601 with a sinusoidal back-EMF; settling and dead time leave duties up to 1 - 2 2.5 us/50 us = 0.9.
Scenario field_oriented(ShuntLegs shunts, double rad_s) {
  Scenario s = with_shunts(maxon_scenario(Mode::current, 2.0), shunts);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.control.drive = FirmwareKind::field;
  s.pwm.alignment = Alignment::centre;
  s.pwm.period_s = 50e-6;
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 0.5e-6;
  s.sensors.shunt_settle_s = 2e-6;
  s.duration_s = 40e-3;
  return turned_at(s, rad_s);
}

struct Tick {
  control::LegCommands<double> command;
  std::uint32_t samples, blind;
};

/// A sample at tick n sees the period before it, whose command was computed at tick n - 2.
TEST(LowSide, TheFieldOrientedDriveIsBlindWhereTheDutiesSayIt) {
  for (const ShuntLegs shunts : {ShuntLegs::ab, ShuntLegs::bc, ShuntLegs::abc}) {
    const std::vector<Tick> ticks = field_ticks(field_oriented(shunts, 600), [](const auto& rig) {
      const rig::Diagnosis found = rig.firmware().diagnosis();
      return Tick{rig.firmware().state().command, found.shunt_samples, found.blind_samples};
    });
    ASSERT_EQ(ticks.size(), 800u);
    std::uint32_t blind = 0;
    for (std::size_t n = 2; n < ticks.size(); ++n) {
      int shown = 0;
      for (unsigned k = 0; k < 3; ++k)
        shown +=
            (static_cast<unsigned>(shunts) >> k & 1U) != 0 && ticks[n - 2].command.leg[k].duty <= 0.9 ? 1 : 0;
      blind += shown < 2 ? 1 : 0;
      EXPECT_EQ(ticks[n].blind, blind) << n;
      EXPECT_EQ(ticks[n].samples, n) << "all but the first, at which the bridge is off";
    }
    EXPECT_GT(blind, 0U);
  }
}

/// Mean torque of the last 20 ms, N m.
double torque(Scenario s) {
  Measure m = measure(MetricKind::mean, Signal::torque);
  m.from_s = 20e-3;
  ask(s, m);
  const auto out = run(s);
  return out ? out->comparisons[0].measured : NAN;
}

/// 2 A need a modulation of 0.67 at 400 rad/s, and of 0.91 at 560 rad/s. Two shunts measure up to 0.8, three up to 0.92.
TEST(LowSide, TwoShuntsLoseACurrentThatThreeKeep) {
  EXPECT_NEAR(*greatest_modulation(field_oriented(ShuntLegs::ab, 0)), 0.8, 1e-12);
  EXPECT_NEAR(*greatest_modulation(field_oriented(ShuntLegs::abc, 0)), 0.4 * 4 / std::sqrt(3.0), 1e-12);
  for (const double rad_s : {400.0, 560.0}) {
    Scenario s = field_oriented(ShuntLegs::abc, rad_s);
    const double three = torque(s);
    s.sensors.shunts = ShuntLegs::ab;
    const double two = torque(s);
    s.sensors.currents = rig::CurrentMeasurement::phases;
    const double phases = torque(s);
    EXPECT_NEAR(three, phases, 2e-3 * phases) << rad_s;
    if (rad_s < 500) {
      EXPECT_NEAR(two, phases, 2e-3 * phases);
    } else {
      EXPECT_LT(two, 0.85 * phases);
    }
  }
}

TEST(LowSide, TheRemarkSaysHowManyPeriodsAndUpToWhichDuty) {
  const auto out = run(field_oriented(ShuntLegs::ab, 560));
  ASSERT_TRUE(out);
  EXPECT_THAT(
      out->remarks,
      Contains(AllOf(HasSubstr(std::to_string(out->blind_samples) + " of 800 control periods"),
                     HasSubstr("low-side shunts ab show a chopped leg's current up to a duty of 0.9 ("),
                     HasSubstr("sensors.shunt_settle_s = 2 us, bridge.dead_time_s = 0.5 us"),
                     HasSubstr("up to a modulation of 0.8,"))));
  const auto six = run(six_step(ShuntLegs::a, 0.94));
  ASSERT_TRUE(six);
  EXPECT_THAT(six->remarks,
              Contains(AllOf(HasSubstr("up to a duty of 0.933"), HasSubstr("in a third of the sectors"))));
  const auto good = run(six_step(ShuntLegs::abc, 0.94));
  ASSERT_TRUE(good);
  EXPECT_THAT(good->remarks, Not(Contains(HasSubstr("low-side"))));
}

/// The window by its arithmetic: what bounds it, at both alignments and both sample instants.
TEST(LowSide, TheWindowFollowsFromItsTimes) {
  Scenario s = with_shunts(maxon_scenario(Mode::duty, 0.5), ShuntLegs::abc);
  s.bridge.dead_time_s = 1e-6;  // soft chopping turns on no other switch of the leg
  EXPECT_DOUBLE_EQ(low_side_of(s).greatest_duty, 1 - 1e-6 / 30e-6);
  EXPECT_EQ(low_side_of(s).least_duty, 1.0);
  s.pwm.chopping = control::Chopping::complementary;
  EXPECT_DOUBLE_EQ(low_side_of(s).greatest_duty, 1 - 2e-6 / 30e-6);
  s.sensors.current_delay_s = 1e-6;
  s.pwm.alignment = Alignment::centre;
  EXPECT_DOUBLE_EQ(low_side_of(s).greatest_duty, 1 - 6e-6 / 30e-6);
  s.sensors.shunt_least_on_s = 9e-6;
  EXPECT_DOUBLE_EQ(low_side_of(s).greatest_duty, 1 - 9e-6 / 30e-6);
  s.pwm.minimum_pulse_s = 12e-6;
  EXPECT_DOUBLE_EQ(low_side_of(s).greatest_duty, 1 - 12e-6 / 30e-6);
  s.pwm.sample = SampleAt::middle;
  EXPECT_EQ(low_side_of(s).greatest_duty, 0.0);
  EXPECT_DOUBLE_EQ(low_side_of(s).least_duty, 12e-6 / 30e-6);
  s.sensors.currents = rig::CurrentMeasurement::phases;
  EXPECT_EQ(low_side_of(s), control::LowSideConfig<double>{});
}

std::string problem_of(const Scenario& s) {
  const base::Problems found = check(s);
  return found.empty() ? "" : to_string(found[0]);
}

TEST(LowSide, WhatCannotBeMeasuredIsRefused) {
  EXPECT_EQ(problem_of(field_oriented(ShuntLegs::ab, 100)), "");
  EXPECT_THAT(problem_of(field_oriented(ShuntLegs::c, 100)),
              AllOf(HasSubstr("sensors.shunts = \"c\""), HasSubstr("needs two")));
  Scenario s = field_oriented(ShuntLegs::abc, 100);
  s.pwm.sample = SampleAt::middle;
  EXPECT_THAT(problem_of(s), HasSubstr("set sample = \"start\""));
  s = field_oriented(ShuntLegs::abc, 100);
  s.sensors.shunt_settle_s = 12.1e-6;
  EXPECT_THAT(problem_of(s),
              AllOf(HasSubstr("without a voltage each leg has a duty of 0.5"), HasSubstr("0.496")));
  s.sensors.shunt_settle_s = 11.9e-6;
  EXPECT_EQ(problem_of(s), "");
  s = with_shunts(hysteresis(), ShuntLegs::abc);
  EXPECT_THAT(problem_of(s), HasSubstr("event comparators watch the currents all the time"));
  s = with_shunts(cascade(), ShuntLegs::abc);
  s.sensors.current_range_A.reset();
  EXPECT_THAT(problem_of(s), HasSubstr("sensors.current_range_A"));
}

/// Values at the ends of the keys' ranges: a message, or a run with finite figures.
TEST(LowSide, ExtremeValuesAreRefusedOrRun) {
  for (const double settle_s : {0.0, 1e-12, 15e-6, 1.0, 9e6})
    for (const double least_s : {0.0, 29.9e-6, 1e3})
      for (const bool field : {false, true}) {
        Scenario s = field ? field_oriented(ShuntLegs::ab, 100) : six_step(ShuntLegs::c, 0.5);
        s.duration_s = 2e-3;
        s.sensors.shunt_settle_s = settle_s;
        s.sensors.shunt_least_on_s = least_s;
        const auto out = run(s);
        if (!out) {
          EXPECT_FALSE(out.problems()[0].cure.empty());
          continue;
        }
        EXPECT_LE(out->blind_samples, out->shunt_samples);
        for (const std::string& remark : out->remarks) EXPECT_THAT(remark, Not(HasSubstr("nan")));
      }
}

/// A key without effect is named.
TEST(LowSide, KeysOfOtherMeasurementsAreNamed) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.sensors.shunts = ShuntLegs::ab;
  const auto out = run(s);
  ASSERT_TRUE(out);
  EXPECT_THAT(out->remarks, Contains(HasSubstr("sensors.shunts (sensors.currents is not low-side)")));
}

}  // namespace SIXSTEP_TEST_FILE

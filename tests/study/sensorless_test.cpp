// SPDX-License-Identifier: Apache-2.0
// The sensorless drive in a scenario: starts in every arithmetic, the hand-over during the run, a dead Hall
// line, a rotor that does not follow, and the refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::HasSubstr;

Scenario sensorless(Mode mode, double reference) {
  Scenario s = maxon_scenario(mode, reference);
  s.control.drive = FirmwareKind::sensorless;
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  s.sensors.capture_Hz = 16e6;
  s.sheet.nominal_current_A = {2.0, "terminal", ""};
  s.load.coulomb_Nm = 0.01;
  s.duration_s = 2.2;
  return s;
}

TEST(SensorlessScenario, StartsAndHoldsItsSpeedInEveryArithmetic) {
  for (const Arithmetic a :
       {Arithmetic::float64, Arithmetic::float32, Arithmetic::q15, Arithmetic::q14, Arithmetic::q31}) {
    Scenario s = sensorless(Mode::speed, 100.0);
    s.control.arithmetic = a;
    if (a == Arithmetic::q15 || a == Arithmetic::q14) s.sensors.capture_Hz = 1e6;
    ask(s, over(MetricKind::mean, Signal::speed, 2.0, 2.2));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault) << to_string(*out.fault);
    EXPECT_TRUE(out.notes.empty()) << out.notes[0];
    // Linear interpolation gives the crossings between two samples. The error of the timer is one count of 1
    // MHz in 1.3 ms.
    EXPECT_NEAR(out.comparisons[0].measured, 100.0, 0.5) << static_cast<int>(a);
  }
}

TEST(SensorlessScenario, StartsByACurrentInDutyToo) {
  for (const Arithmetic a : {Arithmetic::float64, Arithmetic::q15}) {
    Scenario s = sensorless(Mode::duty, -0.4);
    s.control.arithmetic = a;
    ask(s, over(MetricKind::mean, Signal::speed, 2.1, 2.2));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault) << to_string(*out.fault);
    // K_t w = d U - R I - 3/pi p w L_s I (symbols of model.md), with the friction current I. The last term is
    // the voltage drop of a rectifier whose current commutates between phases. The ripple from the PWM is
    // neglected.
    const double I = (0.01 + 7.3e-6 * 268) / 0.0335;
    const double w = (0.4 * 24 - 1.03 * I) / (0.0335 + 3 / base::pi * 8 * 0.286e-3 * I);
    EXPECT_NEAR(out.comparisons[0].measured, -w, 0.01 * w);
  }
}

TEST(SensorlessScenario, GoesOverFromHallToTheBackEmfAndBack) {
  Scenario s = sensorless(Mode::speed, 100.0);
  s.duration_s = 1.2;
  s.sensors.rotor = RotorSensing::hall;
  s.control.sensorless.commutates = Commutates::hall;
  At there, back;
  there.time_s = 0.5;
  there.control.sensorless.commutates = AtCommutates::back_emf;
  back.time_s = 0.9;
  back.control.sensorless.commutates = AtCommutates::hall;
  s.at = {there, back};
  for (const auto& [from, to] : {std::pair{0.4, 0.5}, {0.6, 0.9}, {1.0, 1.2}}) {
    ask(s, over(MetricKind::mean, Signal::speed, from, to));
    ask(s, over(MetricKind::commutation_error, Signal::current, from, to));
  }
  const Outcome out = outcome_of(s);
  ASSERT_FALSE(out.fault);
  for (const std::size_t n : {0, 2, 4}) EXPECT_NEAR(out.comparisons[n].measured, 100.0, 0.5) << n;
  // With probes, the commutation error is zero. With crossings, it is the error of the interpolation.
  EXPECT_LT(out.comparisons[1].measured, 1e-6);
  EXPECT_GT(out.comparisons[3].measured, 1e-6);
  EXPECT_LT(out.comparisons[3].measured, 5.0);
  EXPECT_LT(out.comparisons[5].measured, 1e-6);
}

TEST(SensorlessScenario, TakesOverWhereAHallLineDies) {
  Scenario s = sensorless(Mode::speed, 100.0);
  s.duration_s = 0.8;
  s.sensors.rotor = RotorSensing::hall;
  s.control.sensorless.commutates = Commutates::hall;
  s.sensors.hall_break = {0.5, 2, Level01::low};
  ask(s, over(MetricKind::mean, Signal::speed, 0.6, 0.8));
  const Outcome out = outcome_of(s);
  ASSERT_FALSE(out.fault);
  EXPECT_NEAR(out.comparisons[0].measured, 100.0, 0.5);
  ASSERT_EQ(out.notes.size(), 1u);
  EXPECT_THAT(out.notes[0], HasSubstr("line H2 does not follow the rotor"));
}

TEST(SensorlessScenario, GivesUpOnARotorThatIsHeldAndSaysWhy) {
  Scenario s = sensorless(Mode::speed, 100.0);
  s.load.locked = true;
  s.duration_s = 12.0;
  const Outcome out = outcome_of(s);
  ASSERT_TRUE(out.fault && out.trip);
  EXPECT_THAT(out.fault->limit, HasSubstr("and stopped: "));
  EXPECT_THAT(out.trip->reasons[0], HasSubstr("ramp ended"));
  EXPECT_GT(out.simulated_s, 11.9) << "it coasts on";
}

TEST(SensorlessScenario, SaysWhatItCannotDo) {
  const auto refused = [](const Scenario& s, const std::string& where) {
    const base::Problems found = check(s);
    const bool any =
        std::any_of(found.begin(), found.end(), [&](const base::Problem& p) { return p.where == where; });
    EXPECT_TRUE(any) << where << (found.empty() ? " in nothing" : " in " + to_string(found[0]));
  };
  const Scenario good = sensorless(Mode::speed, 100.0);
  EXPECT_TRUE(check(good).empty());
  Scenario s = good;
  s.pwm.alignment = Alignment::edge;
  refused(s, "pwm.alignment");
  s = good;
  s.pwm.sample = SampleAt::start;
  refused(s, "pwm.sample");
  s = good;
  s.control.mode = Mode::position;
  refused(s, "control.mode");
  s = good;
  s.control.current.type = CurrentLoopType::hysteresis;
  refused(s, "control.current.type");
  s = good;
  s.control.sensorless.commutates = Commutates::hall;
  refused(s, "control.sensorless.commutates");
  s = good;
  s.sensors.rotor = RotorSensing::encoder;
  refused(s, "sensors.rotor");
  s = good;
  s.sensors.bus_bandwidth_Hz = 1e6;
  EXPECT_TRUE(check(s).empty());
  s.control.sensorless.follows = control::Follow::luenberger;
  refused(s, "sensors.bus_bandwidth_Hz");
  s = good;
  s.control.drive = FirmwareKind::lean;
  s.control.sensorless.overload = 2.0;
  refused(s, "control.sensorless");
}

/// The shortest on-time, 30 us times lowest_part, is at least 7 time constants of the filter.
TEST(SensorlessScenario, RunsBehindAFilterThatIsFastEnough) {
  Scenario s = sensorless(Mode::speed, 300.0);
  s.control.sensorless.lowest_part = 0.2;
  const double least_Hz = 7 / (2 * base::pi * 0.2 * 30e-6);
  s.sensors.bus_bandwidth_Hz = 0.99 * least_Hz;
  const auto refused = compile(s);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].where, "sensors.bus_bandwidth_Hz");
  EXPECT_THAT(refused.problems()[0].cure, HasSubstr("lowest_part"));
  s.sensors.bus_bandwidth_Hz = 1.01 * least_Hz;
  for (const BusSensing bus : {BusSensing::ideal, BusSensing::adc}) {
    s.sensors.bus = bus;
    s.sensors.bus_range_V = 30.0;
    const auto compiled = compile(s);
    ASSERT_TRUE(compiled);
    EXPECT_DOUBLE_EQ(compiled->board.front_end.divider_s, 1 / (2 * base::pi * *s.sensors.bus_bandwidth_Hz));
  }
  ask(s, over(MetricKind::mean, Signal::speed, 2.0, 2.2));
  const Outcome out = outcome_of(s);
  ASSERT_FALSE(out.fault) << to_string(*out.fault);
  EXPECT_TRUE(out.notes.empty()) << out.notes[0];
  EXPECT_NEAR(out.comparisons[0].measured, 300.0, 1.5);
}

Scenario by_comparators(rig::CrossingReference against) {
  Scenario s = sensorless(Mode::speed, 300.0);
  s.sensors.capture_Hz = 16e6;
  s.control.sensorless.lowest_part = 0.2;
  s.control.sensorless.follows = control::Follow::comparators;
  s.sensors.comparators = {
      against == rig::CrossingReference::half_bus ? 200e3 : 12e3, against, {0.02, -0.01, 0.0}, 0.03};
  return s;
}

TEST(SensorlessScenario, FollowsComparators) {
  for (const auto against : {rig::CrossingReference::virtual_star, rig::CrossingReference::half_bus}) {
    Scenario s = by_comparators(against);
    const auto compiled = compile(s);
    ASSERT_TRUE(compiled) << to_string(compiled.problems()[0]);
    const rig::CrossingComparators& fitted = compiled->board.front_end.comparators;
    EXPECT_DOUBLE_EQ(fitted.lag_s, 1 / (2 * base::pi * *s.sensors.comparators.bandwidth_Hz));
    EXPECT_EQ(fitted.against, against);
    EXPECT_EQ(fitted.offset_V[1], -0.01);
    EXPECT_EQ(fitted.hysteresis_V, 0.03);
    ask(s, over(MetricKind::mean, Signal::speed, 2.0, 2.2));
    const Outcome out = outcome_of(s);
    ASSERT_FALSE(out.fault) << to_string(*out.fault);
    EXPECT_TRUE(out.notes.empty()) << out.notes[0];
    EXPECT_NEAR(out.comparisons[0].measured, 300.0, 1.5);
  }
}

/// The message names a bandwidth. This bandwidth must pass the check.
TEST(SensorlessScenario, SaysTheBandwidthThatComparatorsNeed) {
  for (const auto against : {rig::CrossingReference::virtual_star, rig::CrossingReference::half_bus})
    for (const std::optional<double> wrong : {std::optional<double>{}, std::optional<double>(100.0)}) {
      Scenario s = by_comparators(against);
      s.sensors.comparators.bandwidth_Hz = wrong;
      const auto refused = compile(s);
      ASSERT_FALSE(refused);
      const base::Problem& told = refused.problems()[0];
      EXPECT_EQ(told.where, "sensors.comparators.bandwidth_Hz");
      const std::size_t digits = told.cure.find_first_of("0123456789");
      ASSERT_NE(digits, std::string::npos) << told.cure;
      s.sensors.comparators.bandwidth_Hz = std::stod(told.cure.substr(digits));
      EXPECT_TRUE(compile(s)) << told.cure;
    }
}

TEST(SensorlessScenario, ComparatorsThatHideTheBackEmfAreRefused) {
  Scenario s = by_comparators(rig::CrossingReference::virtual_star);
  s.sensors.comparators.offset_V = {1.5, 0, 0};
  const auto refused = compile(s);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems()[0].where, "sensors.comparators");
}

/// A divider reads zero while its terminal has another voltage. The drive then loses the rotor, and the loss
/// has one of several names. The drive starts again, and may give up.
TEST(SensorlessScenario, ADividerBreaksAtAnInstant) {
  for (const Wire leg : {Wire::a, Wire::b, Wire::c})
    for (const bool comparators : {false, true}) {
      Scenario s =
          comparators ? by_comparators(rig::CrossingReference::virtual_star) : sensorless(Mode::speed, 300.0);
      At at;
      at.time_s = 1.8;
      at.sensors.broken_divider = leg;
      s.at = {at};
      EXPECT_TRUE(check(s).empty());
      const Outcome out = outcome_of(s);
      ASSERT_TRUE(out.fault || !out.notes.empty());
      const std::string told = out.fault ? to_string(*out.fault) : out.notes[0];
      EXPECT_THAT(told, ::testing::AnyOf(HasSubstr("divider"), HasSubstr("demagnetisation"),
                                         HasSubstr("crossing"), HasSubstr("start")))
          << static_cast<int>(leg);
      s.at.clear();
      const Outcome whole = outcome_of(s);
      EXPECT_TRUE(!whole.fault && whole.notes.empty());
    }
}

TEST(SensorlessScenario, TerminalsKeysAreOfTheDriveThatLooksAtThem) {
  const auto where = [](const Scenario& s) {
    const base::Problems found = check(s);
    return found.empty() ? std::string() : found[0].where;
  };
  Scenario s = sensorless(Mode::speed, 100.0);
  s.sensors.terminal_gain_error = {0.01, -0.006, 0.003};
  EXPECT_EQ(where(s), "");
  const auto compiled = compile(s);
  ASSERT_TRUE(compiled);
  EXPECT_EQ(compiled->board.front_end.divider_gain_error[1], -0.006);
  s.sensors.terminal_gain_error = {0.01};
  EXPECT_EQ(where(s), "sensors.terminal_gain_error");
  s.sensors.terminal_gain_error.clear();
  s.sensors.comparators.hysteresis_V = 0.1;
  EXPECT_EQ(where(s), "sensors.comparators");
  s = sensorless(Mode::speed, 100.0);
  s.control.drive = FirmwareKind::lean;
  s.sensors.terminal_gain_error = {0.01, 0, 0};
  EXPECT_EQ(where(s), "sensors.terminal_gain_error");
  s.sensors.terminal_gain_error.clear();
  At at;
  at.time_s = 0.1;
  at.sensors.broken_divider = Wire::a;
  s.at = {at};
  EXPECT_EQ(where(s), "at[0].sensors.broken_divider");
}

TEST(SensorlessScenario, IsRefusedWhereItsCurrentDoesNotMoveTheLoad) {
  Scenario s = sensorless(Mode::speed, 100.0);
  s.control.sensorless.greatest_load = 3.0;
  const auto compiled = compile(s);
  ASSERT_FALSE(compiled);
  EXPECT_EQ(compiled.problems()[0].where, "control.sensorless.greatest_load");
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The export gate refuses each quantity that the drive reads but that the run does not measure. It refuses no
// other quantity.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> wheres(const base::Problems& problems) {
  std::vector<std::string> out;
  for (const base::Problem& p : problems) {
    EXPECT_FALSE(p.limit.empty() || p.cure.empty()) << p.where;
    out.push_back(p.where);
  }
  return out;
}

/// A scenario with a requirement and with the measurements of a board.
Scenario on_a_board(Mode mode) {
  Scenario s = maxon_scenario(mode, mode == Mode::duty ? 0.5 : 3.0);
  s.sensors = board_sensors();
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 10.0});
  return s;
}

std::vector<std::string> unmeasured(const Scenario& s) {
  EXPECT_TRUE(study::check(s).empty()) << to_string(study::check(s)[0]);
  return wheres(study::never_measured(s));
}

TEST(ExportGate, OnABoardNothingIsLeftUnmeasured) {
  for (const Mode mode : {Mode::duty, Mode::current, Mode::speed, Mode::position})
    EXPECT_THAT(unmeasured(on_a_board(mode)), IsEmpty()) << static_cast<int>(mode);
}

TEST(ExportGate, IdealSensorsAreRefusedWhereTheDriveReadsThem) {
  Scenario s = on_a_board(Mode::speed);
  s.sensors = {};
  EXPECT_THAT(unmeasured(s), ElementsAre("sensors.rotor", "sensors.currents"));
  s.control.current.measured_bus_from_V = 10.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("sensors.rotor", "sensors.currents", "sensors.bus"));
  s = on_a_board(Mode::current);
  s.sensors = {};
  EXPECT_THAT(unmeasured(s), ElementsAre("sensors.currents")) << "Hall lines alone commutate";
  s.control.current.back_emf_feed_forward = true;
  EXPECT_THAT(unmeasured(s), ElementsAre("sensors.rotor", "sensors.currents"));
  s = on_a_board(Mode::duty);
  s.sensors = {};
  s.pwm.delay_periods = 0;
  EXPECT_THAT(unmeasured(s), IsEmpty()) << "nothing is read";
}

/// The first message is complete: after its remedy, neither the check nor the gate refuses anything.
TEST(ExportGate, TheCureOfAnotherSensorIsAllThatHasToChange) {
  const Scenario usual = on_a_board(Mode::position);
  for (const study::RotorSensing rotor :
       {study::RotorSensing::encoder, study::RotorSensing::absolute, study::RotorSensing::resolver})
    for (const study::SensorShaft shaft : {study::SensorShaft::motor, study::SensorShaft::load}) {
      Scenario s = usual;
      s.sensors.rotor = rotor;
      s.sensors.shaft = shaft;
      s.sensors.resolver.excitation_Hz = 0.5 / s.pwm.period_s;
      s.pwm.commutation = study::CommutationAt::sample;
      if (shaft == study::SensorShaft::load) s.load.gear = 2.0;
      const bool encoder = rotor == study::RotorSensing::encoder;
      if (encoder) {
        s.at = {{.time_s = 1e-3}};
        s.at[0].sensors.missed_edges = 40;
        s.record.columns = {"encoder_A"};
      }
      ASSERT_TRUE(study::check(s).empty()) << to_string(study::check(s)[0]);
      const base::Problems told = study::never_measured(s);
      ASSERT_THAT(wheres(told), ElementsAre("sensors.rotor"));
      const std::string& cure = told[0].cure;
      EXPECT_NE(cure.find("set rotor = \"hall\""), cure.npos) << cure;
      EXPECT_EQ(cure.find("and shaft = \"motor\"") != cure.npos, shaft == study::SensorShaft::load) << cure;
      EXPECT_EQ(cure.find("at[0].sensors.missed_edges") != cure.npos, encoder) << cure;
      EXPECT_EQ(cure.find("record.columns = \"encoder_A\"") != cure.npos, encoder) << cure;
      EXPECT_NE(cure.find("design gains and [[require]] for Hall edges"), cure.npos) << cure;
      s.sensors.rotor = study::RotorSensing::hall;
      if (cure.find("shaft = ") != cure.npos) s.sensors.shaft = study::SensorShaft::motor;
      if (cure.find("missed_edges") != cure.npos) s.at.clear();
      if (cure.find("encoder_A") != cure.npos) s.record.columns.clear();
      EXPECT_THAT(unmeasured(s), IsEmpty());
      EXPECT_TRUE(study::check_columns(s).empty());
    }
}

TEST(ExportGate, AnAnswerWithoutDelayIsRefused) {
  Scenario s = on_a_board(Mode::current);
  s.pwm.delay_periods = 0;
  EXPECT_THAT(unmeasured(s), ElementsAre("pwm.delay_periods"));
  s.pwm.sample = study::SampleAt::middle;
  EXPECT_THAT(unmeasured(s), IsEmpty()) << "answered at the next start";
}

TEST(ExportGate, ComparatorsNeedNeitherConverterNorDelay) {
  Scenario s = on_a_board(Mode::current);
  s.sensors = {};
  s.pwm.delay_periods = 0;
  s.control.current = {.type = study::CurrentLoopType::hysteresis};
  EXPECT_THAT(unmeasured(s), IsEmpty());
  s.control.current.comparator = study::Comparator::sampled;
  EXPECT_THAT(unmeasured(s), ElementsAre("sensors.currents", "pwm.delay_periods"));
}

/// With every kind of chopping, a reversal changes a leg from one switch to the other. This change needs a
/// dead time.
TEST(ExportGate, ADriveWithoutDeadTimeIsRefused) {
  for (const Mode mode : {Mode::duty, Mode::current, Mode::speed, Mode::position})
    for (const auto chopping :
         {control::Chopping::soft, control::Chopping::hard, control::Chopping::complementary}) {
      Scenario s = on_a_board(mode);
      s.pwm.chopping = chopping;
      EXPECT_THAT(unmeasured(s), IsEmpty());
      for (const double none : {0.0, 1e-12, 5e-10}) {
        s.bridge.dead_time_s = none;
        EXPECT_THAT(unmeasured(s), ElementsAre("bridge.dead_time_s")) << none;
      }
    }
}

TEST(ExportGate, AFieldOrientedDriveReadsAnglesAndBusAndSwitchesBothWays) {
  Scenario s = on_a_board(Mode::current);
  s.control.drive = study::FirmwareKind::field;
  s.pwm.alignment = study::Alignment::centre;
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sensors = {};
  s.bridge.dead_time_s = 0;
  EXPECT_THAT(unmeasured(s),
              ElementsAre("sensors.rotor", "sensors.currents", "sensors.bus", "bridge.dead_time_s"));
  s.sensors = board_sensors();
  s.sensors.resolver.excitation_Hz = 0.5 / s.pwm.period_s;
  s.bridge.dead_time_s = 500e-9;
  for (const study::RotorSensing rotor : {study::RotorSensing::hall, study::RotorSensing::encoder,
                                          study::RotorSensing::absolute, study::RotorSensing::resolver}) {
    const bool hall = rotor == study::RotorSensing::hall;
    s.sensors.rotor = rotor;
    s.sensors.hall_angle = hall ? rig::HallAngleFrom::angle : rig::HallAngleFrom::sectors;
    EXPECT_THAT(unmeasured(s), IsEmpty()) << static_cast<int>(rotor);
  }
}

TEST(ExportGate, WhatTheRunChangedOfTheDriveIsNotWhatIsWritten) {
  Scenario s = on_a_board(Mode::current);
  s.at = {{.time_s = 1e-3, .reference = study::Reference{.value = 2.0}}, {.time_s = 2e-3}};
  s.at[1].load.torque_Nm = 0.01;
  EXPECT_THAT(unmeasured(s), IsEmpty()) << "setpoints and loads come from outside";
  s.at[0].control.current.settle_s = 3e-3;
  EXPECT_THAT(unmeasured(s), ElementsAre("at[0]"));
  s.at[1].pwm.chopping = study::AtChopping::soft;
  s.at[1].bridge.dead_time_s = 0.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("at[0]", "at[1]", "at[1]"));
}

TEST(ExportGate, ARunOfWhichNothingIsAskedHasShownNothing) {
  Scenario s = on_a_board(Mode::current);
  s.require.clear();
  EXPECT_THAT(unmeasured(s), ElementsAre("require"));
}

TEST(ExportGate, WhatTheRunMissedStandsAgainstItInDigitsThatTellItFromTheLimit) {
  Scenario s = on_a_board(Mode::current);
  s.duration_s = 2e-3;
  const auto held = study::clear_for_export(s);
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->clear()) << to_string(held->unheld[0]);
  const double most = held->outcome.verdicts[0].measured;
  s.require[0].max = most * (1 - 1e-9);
  const auto missed = study::clear_for_export(s);
  ASSERT_TRUE(missed);
  EXPECT_FALSE(missed->clear());
  ASSERT_EQ(missed->unheld.size(), 1u);
  EXPECT_NE(missed->unheld[0].limit.find("<= "), std::string::npos);
  EXPECT_GE(missed->unheld[0].value.size(), 9u) << missed->unheld[0].value;
  EXPECT_EQ(missed->outcome.digest, held->outcome.digest);
}

/// The timer counts whole microseconds. It rounds a dead time of 0.4 us to zero, and a dead time of 1.4 us to
/// 1 us.
TEST(ExportGate, ADeadTimeThatTheTimerShortensIsRefused) {
  Scenario s = on_a_board(Mode::current);
  s.pwm.timer_Hz = 1e6;
  for (const double dead_s : {0.4e-6, 1.4e-6, 1e-6, 2e-6, 0.96e-6}) {
    s.bridge.dead_time_s = dead_s;
    const bool shortened = dead_s == 0.4e-6 || dead_s == 1.4e-6;
    EXPECT_EQ(study::check(s).empty(), !shortened) << dead_s;
    s.bridge.dead_time_s = 1e-6;
    s.at = {{.time_s = 1e-3}};
    s.at[0].bridge.dead_time_s = dead_s;
    const base::Problems told = study::check(s);
    EXPECT_EQ(told.empty(), !shortened) << dead_s;
    for (const base::Problem& p : told) EXPECT_EQ(p.where, "at[0].bridge.dead_time_s");
    s.at.clear();
  }
}

/// The range of the converter ends at the controlled current. The lean drive has no fault that would report
/// this.
TEST(ExportGate, WhatFlowsBeyondTheConverterStandsAgainstIt) {
  Scenario s = on_a_board(Mode::current);
  s.duration_s = 5e-3;
  const auto held = study::clear_for_export(s);
  ASSERT_TRUE(held && held->clear());
  EXPECT_TRUE(held->outcome.comparisons.empty()) << "what the gate looks at is not the scenario's";
  s.sensors.current_range_A = 3.02;  // the reference is 3 A
  const auto blind = study::clear_for_export(s);
  ASSERT_TRUE(blind);
  ASSERT_THAT(wheres(blind->unheld), ElementsAre("sensors.current_range_A"));
  EXPECT_THAT(blind->unheld[0].limit, ::testing::HasSubstr("and the converter measures only up to"));
}

/// The range of the bus converter ends at 12 V, so the drive reads a bus of 24 V as 12 V.
TEST(ExportGate, ABusBeyondItsConverterStandsAgainstIt) {
  Scenario s = on_a_board(Mode::current);
  s.duration_s = 5e-3;
  s.sensors.bus = study::BusSensing::adc;
  for (const bool reads : {false, true})
    for (const double range_V : {12.0, 36.0}) {
      s.sensors.bus_range_V = range_V;
      if (reads) s.control.current.measured_bus_from_V = 10.0;
      const auto run = study::clear_for_export(s);
      ASSERT_TRUE(run) << to_string(run.problems()[0]);
      EXPECT_EQ(run->clear(), !reads || range_V > 24.0) << reads << " " << range_V;
      for (const base::Problem& p : run->unheld) EXPECT_EQ(p.where, "sensors.bus_range_V");
    }
}

/// The kinetic energy J/2 (500^2 - 71^2) (inertia J) charges the capacitor C by C/2 (U^2 - 24^2). The losses
/// in the winding reduce this energy. The bus voltage is therefore between 24 V and this U.
TEST(ExportGate, ABusThatBrakingRaisesStandsAgainstIt) {
  Scenario s = on_a_board(Mode::speed);
  s.reference = {};
  s.reference.shape = study::Shape::steps;
  s.reference.times_s = {0.0, 0.3};
  s.reference.values = {500.0, 71.0};
  s.duration_s = 0.6;
  s.supply.resistance_ohm = 0.05;
  s.supply.capacitance_F = 470e-6;
  s.supply.sinks = false;
  s.sensors.current_range_A = 60.0;
  s.require[0].max = 60.0;
  s.control.speed.settle_s = 40e-3;
  s.control.speed.torque_limit_Nm = 0.195;
  const double J = 1.35e-5, most_V = std::sqrt(24.0 * 24 + J * (500.0 * 500 - 71.0 * 71) / 470e-6);
  const auto raised = study::clear_for_export(s);
  ASSERT_TRUE(raised) << to_string(raised.problems()[0]);
  ASSERT_THAT(wheres(raised->unheld), ElementsAre("the bus"));
  const double bus_V = std::stod(raised->unheld[0].value);
  EXPECT_GT(bus_V, 30.0);
  EXPECT_LT(bus_V, most_V);
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::bus_voltage), {}, most_V});
  const auto bounded = study::clear_for_export(s);
  ASSERT_TRUE(bounded);
  EXPECT_TRUE(bounded->clear()) << to_string(bounded->unheld[0]);
  s.require.pop_back();
  s.supply.sinks = true;
  const auto taken = study::clear_for_export(s);
  ASSERT_TRUE(taken);
  EXPECT_TRUE(taken->clear()) << to_string(taken->unheld[0]);
}

TEST(ExportGate, ALimitOfTheBusBeyondItsConverterIsRefused) {
  Scenario s = on_a_board(Mode::current);
  s.supply.resistance_ohm = 0.05;
  s.supply.capacitance_F = 2e-3;
  s.sensors.bus = study::BusSensing::adc;
  s.control.regeneration.limit_V = 30.0;
  for (const double range_V : {26.0, 30.0, 30.1}) {
    s.sensors.bus_range_V = range_V;
    const base::Problems told = study::check(s);
    EXPECT_EQ(told.empty(), range_V > 30.05) << range_V;
    for (const base::Problem& p : told) EXPECT_EQ(p.where, "control.regeneration.limit_V");
  }
}

/// The scenario never stops the drive, but the first test on the bench does. The rotor's 0.6 J would return
/// to 0.1 mF. This capacitor stores only 0.03 J up to the threshold, so the supply must sink the rest.
TEST(ExportGate, AStopThatEndsInAFaultStandsAgainstIt) {
  Scenario s = braking_onto_a_small_bus();
  for (const bool sinks : {true, false}) {
    s.supply.sinks = sinks;
    const auto run = study::clear_for_export(s);
    ASSERT_TRUE(run) << to_string(run.problems()[0]);
    EXPECT_TRUE(run->outcome.passed());
    EXPECT_EQ(run->clear(), sinks);
    if (sinks) continue;
    ASSERT_THAT(wheres(run->unheld), ElementsAre("protection.brake_current_A"));
    EXPECT_THAT(run->unheld[0].limit, ::testing::HasSubstr("a stop at 0.5 s in a fault: over-voltage"));
  }
  s.protection.off_at_s = 0.4;  // the run includes the stop, and its requirements cover it
  const auto shown = study::clear_for_export(s);
  ASSERT_TRUE(shown);
  EXPECT_TRUE(shown->outcome.trip);
}

TEST(ExportGate, ATripStandsAgainstItToo) {
  Scenario s = product_scenario(Mode::current, 3.0);
  s.duration_s = 5e-3;
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.protection.over_current_A = 1.0;
  const auto tripped = study::clear_for_export(s);
  ASSERT_TRUE(tripped) << to_string(tripped.problems()[0]);
  EXPECT_THAT(wheres(tripped->unmeasured), ElementsAre("protection.over_current_A", "require"));
  ASSERT_EQ(tripped->unheld.size(), 1u);
  EXPECT_NE(tripped->unheld[0].limit.find("over-current"), std::string::npos);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// check() finds each contradiction, names its key, and finds nothing in a good scenario.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/scenarios.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

std::vector<std::string> places(const Scenario& s) {
  std::vector<std::string> out;
  for (const base::Problem& p : study::check(s)) out.push_back(p.where);
  return out;
}

TEST(Check, GoodScenariosHaveNoProblems) {
  for (const auto& s :
       {maxon_scenario(control::Mode::duty, 0.5), current_square(),
        maxon_scenario(control::Mode::speed, 200.0), maxon_scenario(control::Mode::position, 90.0),
        maxon_scenario(control::Mode::off, 0.0)})
    EXPECT_THAT(places(s), ::testing::IsEmpty());
}

struct Contradiction {
  const char* where;
  std::function<void(Scenario&)> make;
};

TEST(Check, EachContradictionIsFoundAndNamed) {
  using study::CurrentLoopType;
  const Contradiction table[] = {
      {"supply.resistance_ohm", [](Scenario& s) { s.supply.resistance_ohm = 0.1; }},
      {"supply.capacitance_F", [](Scenario& s) { s.supply.capacitance_F = 1e-3; }},
      {"supply.sinks", [](Scenario& s) { s.supply.sinks = false; }},
      {"initial.bus_V", [](Scenario& s) { s.initial.bus_V = 20.0; }},
      {"initial.speed_rad_s",
       [](Scenario& s) {
         s.load.locked = true;
         s.initial.speed_rad_s = 1.0;
       }},
      {"sensors.current_range_A", [](Scenario& s) { s.sensors.currents = rig::CurrentSensing::phases; }},
      {"sensors.current_offset_A",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentSensing::phases;
         s.sensors.current_range_A = 10.0;
         s.sensors.current_offset_A = -10.0;
       }},
      {"sensors.currents",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentSensing::dc_link;
         s.sensors.current_range_A = 10.0;
       }},
      {"sensors.adc_bits",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentSensing::phases;
         s.sensors.current_range_A = 10.0;
         s.sensors.adc_bits = 13;
         s.control.arithmetic = study::Arithmetic::q15;
       }},
      {"control.regeneration.limit_V",
       [](Scenario& s) {
         s.control.regeneration = {24.0, 1.0};
       }},
      {"control.regeneration.gain_A_per_V", [](Scenario& s) { s.control.regeneration.limit_V = 30.0; }},
      {"sensors.bus_range_V", [](Scenario& s) { s.sensors.bus = study::BusSensing::adc; }},
      {"sensors.timeout_s",
       [](Scenario& s) {
         s.sensors.rotor = study::RotorSensing::hall;
         s.sensors.timeout_s = 100.0;
         s.sensors.capture_Hz = 1e8;
       }},
      {"sensors.hall_break.at_s", [](Scenario& s) { s.sensors.hall_break.at_s = 1.0; }},
      {"pwm.sample",
       [](Scenario& s) {
         s.pwm.sample = study::SampleAt::middle;
         s.control.mode = control::Mode::current;
         s.control.current = {.type = CurrentLoopType::hysteresis};
       }},
      {"reference.unit", [](Scenario& s) { s.reference.unit = "V"; }},
      {"reference.times_s", [](Scenario& s) { s.reference.shape = study::Shape::steps; }},
      {"reference.values",
       [](Scenario& s) {
         s.reference.shape = study::Shape::steps;
         s.reference.times_s = {0.0, 1e-3};
         s.reference.values = {1.0};
       }},
      {"load.times_s",
       [](Scenario& s) {
         s.load.times_s = {2e-3, 1e-3};
         s.load.torques_Nm = {0.1, 0.2};
       }},
      {"load.times_s",
       [](Scenario& s) {
         s.load.times_s = {25e-3};
         s.load.torques_Nm = {0.1};
       }},
      {"control.current.d1", [](Scenario& s) { s.control.current.kp = 1.0; }},
      {"control.current.d1", [](Scenario& s) { s.control.current.settle_s = 1e-3; }},
      {"control.current.d1", [](Scenario& s) { s.control.current.d0.reset(); }},
      {"control.speed.ki", [](Scenario& s) { s.control.speed.ki = 0.1; }},
      {"control.current.type", [](Scenario& s) { s.control.current.type = CurrentLoopType::hysteresis; }},
      {"control.current.on",
       [](Scenario& s) {
         s.control.current = {.type = CurrentLoopType::hysteresis};
         s.control.current.on = study::HysteresisOn::phase;
         s.control.current.comparator = study::Comparator::sampled;
       }},
      {"pwm.delay_periods",
       [](Scenario& s) {
         s.control.current = {.type = CurrentLoopType::hysteresis};
         s.pwm.delay_periods = 1;
       }},
      {"pwm.delay_periods", [](Scenario& s) { s.pwm.delay_periods = 2; }},
      {"bridge.dead_time_s", [](Scenario& s) { s.bridge.dead_time_s = 30e-6; }},
      {"record.columns", [](Scenario& s) { s.record.columns = {"i_d_A"}; }},
      {"require[0]", [](Scenario& s) { s.require.push_back({}); }},
      {"require[0].min", [](Scenario& s) { s.require.push_back({.measure = {}, .min = 2.0, .max = 1.0}); }},
      {"compare[0].to_s",
       [](Scenario& s) {
         ask(s, {});
         s.compare[0].measure.from_s = 5e-3;
         s.compare[0].measure.to_s = 4e-3;
       }},
      {"compare[0].to_s",
       [](Scenario& s) {
         ask(s, {});
         s.compare[0].measure.to_s = 1.0;
       }},
  };
  for (const Contradiction& c : table) {
    Scenario s = current_square();
    c.make(s);
    EXPECT_THAT(places(s), ::testing::ElementsAre(c.where));
    EXPECT_FALSE(study::run(s)) << c.where;
  }
}

TEST(Check, ASheetWithoutVoltageAndStallPointNeedsTheTorqueLimit) {
  Scenario s = maxon_scenario(control::Mode::speed, 200.0);
  s.sheet.nominal_voltage_V.reset();
  EXPECT_THAT(places(s), ::testing::IsEmpty());
  s.sheet.stall_torque_mNm.reset();
  EXPECT_THAT(places(s), ::testing::ElementsAre("control.speed.torque_limit_Nm"));
  s.control.speed.torque_limit_Nm = 0.5;
  EXPECT_THAT(places(s), ::testing::IsEmpty());
  s.control.speed.torque_limit_Nm.reset();
  s.control.mode = control::Mode::current;
  EXPECT_THAT(places(s), ::testing::IsEmpty());
}

TEST(Check, DutyBeyondOneIsNamedByTheKeyThatHoldsIt) {
  Scenario s = maxon_scenario(control::Mode::duty, 1.5);
  EXPECT_THAT(places(s), ::testing::ElementsAre("reference.value"));
  s.reference.shape = study::Shape::square;
  s.reference.high = -2.0;
  EXPECT_THAT(places(s), ::testing::ElementsAre("reference.high"));
  s.reference.high = 0.5;
  s.reference.low = -2.0;
  EXPECT_THAT(places(s), ::testing::Not(::testing::IsEmpty()));
}

TEST(Check, AllProblemsComeAtOnceAndEachHasACure) {
  Scenario s = current_square();
  s.supply.sinks = false;
  s.control.current.kp = 1.0;
  s.pwm.delay_periods = 7;
  EXPECT_EQ(places(s).size(), 3u);
  for (const base::Problem& p : study::check(s)) {
    EXPECT_FALSE(p.limit.empty());
    EXPECT_FALSE(p.cure.empty());
  }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// check() finds each contradiction and names its key. It accepts a valid scenario.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "sixstep/study/check/check.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;
using study::Shape;

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
      {"sensors.current_range_A", [](Scenario& s) { s.sensors.currents = rig::CurrentMeasurement::phases; }},
      {"sensors.current_offset_A",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentMeasurement::phases;
         s.sensors.current_range_A = 10.0;
         s.sensors.current_offset_A = -10.0;
       }},
      {"sensors.currents",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentMeasurement::dc_link;
         s.sensors.current_range_A = 10.0;
       }},
      {"sensors.adc_bits",
       [](Scenario& s) {
         s.sensors.currents = rig::CurrentMeasurement::phases;
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
      {"reference.times_s", [](Scenario& s) { s.reference = {.shape = study::Shape::steps}; }},
      {"reference.values",
       [](Scenario& s) {
         s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 1e-3}, .values = {1.0}};
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
      {"pwm.minimum_pulse_s", [](Scenario& s) { s.pwm.minimum_pulse_s = 15.1e-6; }},
      {"record.columns", [](Scenario& s) { s.record.columns = {"i_x_A"}; }},
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

study::Reference shaped(Shape shape, study::Reference r) {
  r.shape = shape;
  return r;
}

TEST(Check, EachSlipOfAMovingReferenceIsFoundAndNamed) {
  const std::pair<const char*, study::Reference> table[] = {
      {"reference.end_s", shaped(Shape::ramp, {.end = 5.0})},
      {"reference.slope", shaped(Shape::ramp, {.end = 5.0, .end_s = 0.01, .slope = 1.0})},
      {"reference.end_s", shaped(Shape::ramp, {.begin_s = 0.01, .end = 5.0, .end_s = 0.01})},
      {"reference.slope", shaped(Shape::trapezoid, {.end = 5.0, .acceleration = 1.0})},
      {"reference.acceleration", shaped(Shape::trapezoid, {.end = 5.0, .slope = 1.0})},
      {"reference.end_s", shaped(Shape::trapezoid, {.end_s = 1.0, .slope = 1.0, .acceleration = 1.0})},
      {"reference.frequency_Hz", shaped(Shape::sine, {.amplitude = 5.0})},
      {"reference.frequency_Hz", shaped(Shape::sine, {.amplitude = 5.0, .frequency_Hz = 16667.0})},
      {"reference.amplitude", shaped(Shape::constant, {.amplitude = 5.0})},
      {"reference.start", shaped(Shape::steps, {.times_s = {0.0}, .values = {1.0}, .start = 1.0})},
      {"reference.file", shaped(Shape::csv, {})},
      {"reference.values", shaped(Shape::csv, {.times_s = {0.0, 1.0}, .values = {1.0}})},
      {"reference.times_s", shaped(Shape::csv, {.times_s = {1.0, 1.0}, .values = {1.0, 2.0}})},
      {"reference.column", shaped(Shape::constant, {.column = "x"})},
      {"reference.period_s", shaped(Shape::square, {.high = 1.0, .period_s = 1e-9})},
  };
  for (const auto& [where, reference] : table) {
    Scenario s = current_square();
    s.reference = reference;
    EXPECT_THAT(places(s), ::testing::ElementsAre(where));
    s.reference = {};
    s.at.push_back({.time_s = 1e-3, .reference = reference});
    EXPECT_THAT(places(s), ::testing::ElementsAre("at[0]." + std::string(where)));
  }
}

TEST(Check, EachSlipOfAnEventIsFoundAndNamed) {
  const std::pair<const char*, study::At> table[] = {
      {"at[0].time_s", {.time_s = 1e-3}},
      {"at[0].time_s", {.time_s = 1.0, .load = {.torque_Nm = 0.1}}},
      {"at[0].supply.sinks", {.time_s = 1e-3, .supply = {.sinks = false}}},
      {"at[0].supply.voltage_V", {.time_s = 1e-3, .supply = {.voltage_V = 31.0}}},
      {"at[0].request", {.time_s = 1e-3, .request = study::DriveRequest::clear}},
      {"at[0].reference.unit", {.time_s = 1e-3, .reference = study::Reference{.unit = "V"}}},
      {"at[0].reference.times_s",
       {.time_s = 15e-3,
        .reference = study::Reference{.shape = Shape::steps, .times_s = {10e-3}, .values = {1.0}}}},
  };
  for (const auto& [where, event] : table) {
    Scenario s = current_square();
    s.control.regeneration = {30.0, 1.0};
    s.at.push_back(event);
    EXPECT_THAT(places(s), ::testing::ElementsAre(where));
  }
  Scenario off = maxon_scenario(control::Mode::off, 0.0);
  off.at.push_back({.time_s = 1e-3, .reference = study::Reference{}});
  EXPECT_THAT(places(off), ::testing::ElementsAre("at[0].reference"));
}

TEST(Check, AMovingReferenceHasNoStepsToTakeFiguresOf) {
  for (const study::MetricKind metric :
       {study::MetricKind::reach_time, study::MetricKind::settling_time, study::MetricKind::overshoot}) {
    Scenario s = current_square();
    s.reference = {.shape = Shape::ramp, .end = 5.0, .end_s = 10e-3};
    ask(s, measure(metric, study::Signal::current));
    EXPECT_THAT(places(s), ::testing::ElementsAre("compare[0].metric"));
    s.compare[0].measure.from_s = 10e-3;  // the reference is constant from 10 ms on
    EXPECT_THAT(places(s), ::testing::IsEmpty());
    s.compare[0].measure.from_s.reset();
    s.compare[0].measure.level = 5.0;  // alternatively, the scenario states the level
    EXPECT_THAT(places(s), ::testing::IsEmpty());
  }
}

TEST(Check, ASheetWithoutANominalCurrentNeedsTheTorqueLimit) {
  Scenario s = maxon_scenario(control::Mode::speed, 200.0);
  s.control.speed.torque_limit_Nm.reset();
  s.sheet.nominal_current_A = {2.33, "terminal", ""};
  EXPECT_THAT(places(s), ::testing::IsEmpty());
  s.sheet.nominal_current_A.reset();
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
  s.reference = {.shape = Shape::square, .high = -2.0};
  EXPECT_THAT(places(s), ::testing::ElementsAre("reference.high"));
  s.reference.high = 0.5;
  s.reference.low = -2.0;
  EXPECT_THAT(places(s), ::testing::Not(::testing::IsEmpty()));
  s.reference = {.shape = Shape::sine, .offset = 0.5, .amplitude = 0.6, .frequency_Hz = 100.0};
  EXPECT_THAT(places(s), ::testing::ElementsAre("reference.amplitude"));
  s.reference = {.shape = Shape::ramp, .end = 2.0, .end_s = 40e-3};  // the ramp has reached 1 when the run
                                                                     // ends
  EXPECT_THAT(places(s), ::testing::IsEmpty());
  s.at.push_back({.time_s = 1e-3, .reference = study::Reference{.value = -1.1}});
  EXPECT_THAT(places(s), ::testing::ElementsAre("at[0].reference.value"));
}

TEST(Check, AllProblemsComeAtOnceAndEachHasACure) {
  Scenario s = current_square();
  s.supply.sinks = false;
  s.control.current.kp = 1.0;
  s.bridge.dead_time_s = 1.0;
  EXPECT_EQ(places(s).size(), 3u);
  for (const base::Problem& p : study::check(s)) {
    EXPECT_FALSE(p.limit.empty());
    EXPECT_FALSE(p.cure.empty());
  }
}

}  // namespace SIXSTEP_TEST_FILE

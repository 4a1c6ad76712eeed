// SPDX-License-Identifier: Apache-2.0
// The test run of a design uses the board's sensor: encoder, absolute encoder or resolver, on either side of
// a gear. The verdict refers to this run.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/scenario_spec.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::analysis;
using control::Mode;
using study::RotorSensing;
using study::SensorShaft;

constexpr RotorSensing shaft_sensors[] = {RotorSensing::encoder, RotorSensing::absolute,
                                          RotorSensing::resolver};

/// The board of a scenario with the given rotor sensor.
study::Scenario board_with(RotorSensing rotor, Mode mode = Mode::speed) {
  study::Scenario s;
  s.motor = "maxon-251601";
  s.sheet = sixstep::testing::maxon_sheet();
  s.supply.voltage_V = 24;
  s.pwm.commutation = study::CommutationAt::sample;
  s.control.mode = mode;
  s.sensors.capture_Hz =
      16e6;  // with 1 MHz, the steps of an encoder's speed reach the limits (high_speed_test.cpp)
  s.sensors = with_rotor(s.sensors, rotor, s.pwm.period_s);
  return s;
}

DesignStudy studied(const study::Scenario& board) {
  const auto s = study_design(
      {.subject = {.motor = board.motor, .sheet = board.sheet, .board = board}, .spec = spec_of(board)});
  EXPECT_TRUE(s) << to_string(s.problems().front());
  return *s;
}

double figure(const DesignStudy& s, const std::string& name) {
  for (const study::ComparisonResult& c : s.outcome.comparisons)
    if (c.figure == name) return c.measured;
  ADD_FAILURE() << name;
  return NAN;
}

TEST(DesignSensors, TheRunHasTheSensorOfTheBoard) {
  for (const RotorSensing rotor : shaft_sensors) {
    const DesignStudy s = studied(board_with(rotor));
    EXPECT_EQ(s.scenario.sensors.rotor, rotor);
    EXPECT_TRUE(s.usable());
    EXPECT_GT(s.design.lag.delay_s(), 0.0);
    // The loop settles as the linear design with the sensor's delay predicts.
    EXPECT_LT(figure(s, "settling time"), 1.25 * s.design.loop("speed").step.settling_s);
    // The digests differ, so the run does not use the ideal sensor.
    const auto ideal = study::run(with_ideal_sensors(s.scenario), {});
    ASSERT_TRUE(ideal);
    EXPECT_NE(ideal->digest, s.outcome.digest);
  }
}

TEST(DesignSensors, AMoveRestsWithinWhatTheSensorTells) {
  for (const RotorSensing rotor : shaft_sensors) {
    const DesignStudy s = studied(board_with(rotor, Mode::position));
    EXPECT_TRUE(s.usable());
    // Three counts are 0.26 degrees with 4 x 1024 counts per turn, and 0.07 degrees with 2^14 counts per
    // turn.
    EXPECT_LE(figure(s, "swing around the target"), rotor == RotorSensing::encoder ? 4 * 360.0 / 4096 : 0.1);
  }
}

/// The load makes one turn for n turns of the motor. The total inertia J_1 + J_2/n^2 (motor J_1, load J_2) is
/// the same as without a gear, so the loops are equal. The sensor is on the load's side of the gear.
TEST(DesignSensors, BehindAGearTheLoopsAreOfTheMotorsShaft) {
  study::Scenario geared = board_with(RotorSensing::absolute);
  geared.load.gear = 5.0;
  geared.load.inertia_kg_m2 = 25 * 3e-6;
  geared.sensors.shaft = SensorShaft::load;
  geared.sensors.absolute.bits = 18;
  study::Scenario straight = board_with(RotorSensing::absolute);
  straight.load.inertia_kg_m2 = 3e-6;
  EXPECT_NEAR(spec_of(geared).load_inertia_kg_m2, 3e-6, 1e-20);
  const DesignStudy s = studied(geared), t = studied(straight);
  EXPECT_EQ(s.scenario.sensors.shaft, SensorShaft::load);
  EXPECT_EQ(s.scenario.load.gear, 5.0);
  EXPECT_NEAR(s.scenario.load.inertia_kg_m2, 25 * 3e-6, 1e-18);
  EXPECT_NEAR(s.scenario.load.torque_Nm, 5 * t.scenario.load.torque_Nm, 1e-12);
  EXPECT_TRUE(s.usable());
  EXPECT_NEAR(figure(s, "settling time"), figure(t, "settling time"), 0.1 * figure(t, "settling time"));
}

/// One probe edge is 3 degrees late, and the next edge is 2 degrees early. They are 55 degrees apart instead
/// of 60.
TEST(DesignSensors, ProbesBesideTheirPlacesMakeTheSpeedStray) {
  study::Scenario board = board_with(RotorSensing::hall);
  board.sensors.hall_edges_deg = {3, -2, 0, 0, 0, 0};
  board.sensors.hall_delay_s = 20e-6;
  board.sensors.speed_edges = 1;
  const design::RotorSensing one = rotor_sensing_of(board);
  EXPECT_NEAR(one.stray_rad, 5 * base::pi / 180, 1e-15);
  EXPECT_NEAR(design::speed_lag(one, 8, 100, 0).delay_s(), base::pi / 3 / 800 + 20e-6, 1e-18);
  int told = 0;
  for (const design::DerivationStep& step : design::lag_steps(one, 8, 100, 0)) {
    told += step.symbol == "dw" || step.symbol == "w_min";
    if (step.symbol == "dw") {
      EXPECT_NEAR(step.value, 100 * 5.0 / 60, 1e-12);
    }
    if (step.symbol == "w_min") {
      EXPECT_NEAR(step.value, base::pi / 3 / 8 / board.sensors.timeout_s, 1e-12);
    }
  }
  EXPECT_EQ(told, 2);
  // If the board states no edge errors, the derivation prints dw_3. This is the step of the measured speed if
  // successive edges are 3 degrees late and early in turn. A speed from six edges has no such step.
  const auto dw = [&board](std::vector<double> edges_deg, const char* symbol, int speed_edges) {
    board.sensors.hall_edges_deg = std::move(edges_deg);
    board.sensors.speed_edges = speed_edges;
    for (const design::DerivationStep& step : design::lag_steps(rotor_sensing_of(board), 8, 100, 0))
      if (step.symbol == symbol) return step.value;
    return 0.0;
  };
  EXPECT_NEAR(dw({}, "dw_3", 1), dw({3, -3, 3, -3, 3, -3}, "dw", 1), 1e-12);
  EXPECT_EQ(dw({}, "dw_3", 6), 0.0);
  board.sensors.hall_edges_deg = {3, -2, 0, 0, 0, 0};
  // Over a whole electrical turn, the errors of the edges cancel. Learned edges have no error.
  board.sensors.speed_edges = 6;
  EXPECT_EQ(rotor_sensing_of(board).stray_rad, 0.0);
  board.sensors.speed_edges = 1;
  board.sensors.hall_angle = rig::HallAngleFrom::learned_edges;
  EXPECT_EQ(rotor_sensing_of(board).stray_rad, 0.0);
}

TEST(DesignSensors, AnotherSensorThanTheBoardsTakesItsPlaceWhole) {
  study::Scenario board = board_with(RotorSensing::absolute);
  board.load.gear = 3.0;
  board.sensors.shaft = SensorShaft::load;
  board.sensors = with_rotor(board.sensors, RotorSensing::hall, board.pwm.period_s);
  const design::RotorSensing hall = rotor_sensing_of(board);
  EXPECT_TRUE(hall.hall);
  EXPECT_EQ(hall.shaft.kind, design::ShaftSensorKind::none);
  EXPECT_EQ(board.sensors.shaft, SensorShaft::motor);
}

/// Peaks of the excitation coincide with control ticks. Half an excitation period is therefore a whole number
/// of control periods, near 50 us (10 kHz).
TEST(DesignSensors, AResolverIsExcitedInStepWithTheControl) {
  for (const double period_s : {10e-6, 25e-6, 30e-6, 40e-6, 50e-6, 100e-6}) {
    const study::Sensors s = with_rotor({}, RotorSensing::resolver, period_s);
    const double periods = 0.5 / s.resolver.excitation_Hz / period_s;
    EXPECT_NEAR(periods, std::round(periods), 1e-9) << period_s;
    EXPECT_GE(periods, 1.0 - 1e-9);
    EXPECT_LE(std::fabs(periods * period_s - 50e-6), std::max(period_s / 2, period_s - 50e-6) + 1e-12)
        << period_s;
  }
}

TEST(DesignSensors, WhatASensorlessDriveComesToIsTold) {
  study::Scenario board = board_with(RotorSensing::ideal);
  board.pwm.commutation = study::CommutationAt::hall_edge;
  board.pwm.alignment = study::Alignment::centre;
  board.pwm.sample = study::SampleAt::middle;
  board.control.drive = study::FirmwareKind::sensorless;
  board.control.current.settle_s = 1e-3;
  board.control.speed.settle_s = 50e-3;
  board.control.speed.torque_limit_Nm = 0.1;
  board.sensors.currents = rig::CurrentMeasurement::phases;
  board.sensors.current_range_A = 25;
  board.sensors.bus = study::BusSensing::adc;
  board.sensors.bus_range_V = 36;
  board.reference.value = 200;
  board.duration_s = 1;
  ASSERT_TRUE(study::check(board).empty()) << to_string(study::check(board).front());
  const DesignStudy s = studied(board);
  ASSERT_GE(s.sensorless.size(), 3u);
  EXPECT_EQ(s.sensorless[1].symbol, "w_low");
  // The lowest speed w_low is at least 1/20 of the no-load speed.
  EXPECT_GE(s.sensorless[1].value, 0.05 * 24 / s.design.motor.K_t_Nm_A * (1 - 1e-12));
  // A load that the start cannot accelerate is refused, and the message names the key.
  board.control.sensorless.greatest_load = 2.0;
  const auto refused = study_design(
      {.subject = {.motor = board.motor, .sheet = board.sheet, .board = board}, .spec = spec_of(board)});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.problems().front().where.find("greatest_load"), std::string::npos);
}

}  // namespace SIXSTEP_TEST_FILE

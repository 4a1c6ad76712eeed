// SPDX-License-Identifier: Apache-2.0
// A change [[at]] during a run acts at its instant and follows the physical law. It has the same effect under
// each of its names.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/figures.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::At;
using study::Scenario;
using study::Shape;

/// Rows on a grid, each with the time and one column.
std::vector<std::pair<double, double>> curve(Scenario s, const char* column, double grid_s) {
  s.record.grid_s = grid_s;
  s.record.columns = {column};
  std::vector<std::pair<double, double>> rows;
  const auto out = study::run(s, {.on_record = [&](study::Row row) { rows.emplace_back(row[0], row[1]); }});
  EXPECT_TRUE(out) << to_string(out.problems().at(0));
  return rows;
}

TEST(Events, WhatHasAKeyOfItsOwnIsTheSameEventToTheBit) {
  Scenario by_keys = product_scenario(Mode::speed, 100.0), by_events = by_keys;
  by_keys.duration_s = by_events.duration_s = 0.15;
  by_keys.reference = {.shape = Shape::steps, .times_s = {0.0, 0.05}, .values = {100.0, 110.0}};
  by_keys.load.times_s = {0.06};
  by_keys.load.torques_Nm = {0.01};
  by_keys.sensors.hall_break = {.at_s = 0.14, .line = 2, .level = study::Level01::high};
  by_keys.protection.off_at_s = 0.08;
  by_events.at = {{.time_s = 0.08, .request = study::DriveRequest::off},
                  {.time_s = 0.14, .sensors = {.hall_break = study::AtHallBreak{2, study::PinLevel::high}}},
                  {.time_s = 0.05, .reference = study::Reference{.value = 110.0}},
                  {.time_s = 0.06, .load = {.torque_Nm = 0.01}}};
  const std::uint64_t digest = outcome_of(by_keys).digest;
  EXPECT_EQ(outcome_of(by_events).digest, digest);
  while (!by_events.at.empty()) {  // each event changes the run
    by_events.at.pop_back();
    EXPECT_NE(outcome_of(by_events).digest, digest) << by_events.at.size();
  }
}

TEST(Events, AStepOfAStiffSupplyDrivesTheHeldMotorFromThereOn) {
  Scenario s = maxon_scenario(Mode::duty, 1.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  s.duration_s = 4e-3;
  s.at = {{.time_s = 1e-3, .supply = {.voltage_V = 36.0}}, {.time_s = 2e-3, .supply = {.voltage_V = 12.0}}};
  const double tau = 0.572e-3 / 1.03, R = 1.03;
  double i = 0.0, U = 24.0, since = 0.0;
  for (const auto& [t, measured] : curve(s, "i_m_A", 1e-4)) {
    const double now = U / R + (i - U / R) * std::exp(-(t - since) / tau);
    EXPECT_NEAR(measured, now, 1e-12 * 36.0 / R) << t;
    if (t == 1e-3 || t == 2e-3) {
      i = now;
      since = t;
      U = t == 1e-3 ? 36.0 : 12.0;
    }
  }
}

TEST(Events, ASourceBehindItsResistanceIsFollowedAndMayCeaseToSink) {
  // No current is drawn, so the bus follows the source with R C = 1 ms. While the source cannot sink, a bus
  // voltage above the source's voltage remains constant.
  Scenario s = maxon_scenario(Mode::off, 0.0);
  s.duration_s = 5e-3;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.5, .capacitance_F = 2e-3};
  s.at = {{.time_s = 1e-3, .supply = {.voltage_V = 30.0}},
          {.time_s = 2e-3, .supply = {.voltage_V = 20.0, .sinks = false}},
          {.time_s = 3e-3, .supply = {.sinks = true}}};
  const double at_2 = 30.0 - 6.0 * std::exp(-1.0);
  for (const auto& [t, bus] : curve(s, "bus_V", 1e-4)) {
    const double expected = t <= 1e-3   ? 24.0
                            : t <= 2e-3 ? 30.0 - 6.0 * std::exp(-(t - 1e-3) / 1e-3)
                            : t <= 3e-3 ? at_2
                                        : 20.0 + (at_2 - 20.0) * std::exp(-(t - 3e-3) / 1e-3);
    EXPECT_NEAR(bus, expected, 1e-12 * 30.0) << t;
  }
}

TEST(Events, AClampTakesTheKineticEnergyAndLetsGoFromRest) {
  Scenario s = maxon_scenario(Mode::off, 0.0);
  s.duration_s = 0.3;
  s.initial.speed_rad_s = 200.0;
  s.load.coulomb_Nm = 1e-4;
  s.at = {{.time_s = 0.1, .load = {.locked = true}},
          {.time_s = 0.2, .load = {.torque_Nm = -0.01, .locked = false}}};
  const double J = 1.35e-5, B = 7.3e-6, c = 1e-4, tau = J / B;
  const auto speed = [&](double from, double torque, double t) {  // J w' = torque - B w
    return torque / B + (from - torque / B) * std::exp(-t / tau);
  };
  for (const auto& [t, w] : curve(s, "speed_rad_s", 0.01)) {
    const double expected = t < 0.1 ? speed(200.0, -c, t) : t <= 0.2 ? 0.0 : speed(0.0, 0.01 - c, t - 0.2);
    EXPECT_NEAR(w, expected, 1e-12 * 700.0) << t;
  }
  const study::Outcome out = outcome_of(s);
  ASSERT_TRUE(out.energy);
  EXPECT_LT(std::fabs(out.energy->mechanical_residual), 1e-12);
  // The work of the load and the stored energy become friction and clamp losses, except for the kinetic
  // energy at the end.
  EXPECT_GT(out.energy->friction, 0.5 * J * 190.0 * 190.0);
}

TEST(Events, AClearedFaultLetsTheProductDriveRunAgain) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.load.coulomb_Nm = 0.002;
  s.duration_s = 0.9;
  s.at = {{.time_s = 0.2, .supply = {.voltage_V = 8.0}},  // below under_voltage_V = 10
          {.time_s = 0.21, .supply = {.voltage_V = 24.0}},
          {.time_s = 0.4, .request = study::DriveRequest::clear},
          {.time_s = 0.42, .request = study::DriveRequest::off},
          {.time_s = 0.44, .request = study::DriveRequest::on}};
  Witness again, never;
  const auto out = study::run(s, {.on_event = std::ref(again)});
  ASSERT_TRUE(out && out->trip);
  EXPECT_EQ(out->trip->reasons.at(0), "under-voltage");
  // The speed returns to the reference. The tolerance is the ripple of a speed that is measured by edges: one
  // count of 1 MHz in 1309 us.
  EXPECT_NEAR(again.last_speed, 100.0, 2.0);
  s.at[2].request = study::DriveRequest::off;  // the drive stays off without clearing
  ASSERT_TRUE(study::run(s, {.on_event = std::ref(never)}));
  EXPECT_LT(never.off_for_good(), 0.201);
}

}  // namespace SIXSTEP_TEST_FILE

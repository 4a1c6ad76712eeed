// SPDX-License-Identifier: Apache-2.0
// Tests crossed wires in whole runs: values of converters, one shunt, columns, figures of merit and logic.
// tests/rig/wiring_test.cpp tests directions and torques.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using rig::WireOrder;

Outcome outcome(const Scenario& s, const Listeners& listeners = {}) {
  const auto out = run(s, listeners);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? *out : Outcome{};
}

/// The scenario with straight wires, in the general kernel.
Scenario straight(Scenario s) {
  At at;
  at.bridge.phases = AtOrder::abc;
  s.at.push_back(at);
  s.initial.angle_rad = 17 * base::pi / 180 / 8;
  return s;
}

/// Both phases and probes are exchanged cyclically, and the rotor is turned by 120 degrees. The board then
/// receives the same signals.
Scenario moved_on(Scenario s) {
  s.bridge.phases = s.sensors.hall_lines = WireOrder::bca;
  s.initial.angle_rad = (120 + 17) * base::pi / 180 / 8;
  return s;
}

Scenario one_shunt(Scenario s) {
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.pwm.alignment = Alignment::centre;
  s.pwm.sample = SampleAt::middle;
  return s;
}

std::vector<Scenario> drives() {
  Scenario sampled = current_square(), flashed = product_scenario(Mode::speed, 100.0);
  sampled.sensors = board_sensors();
  flashed.duration_s = 30e-3;
  Scenario by_edges = cascade(30e-3);  // the first edge counts relative to the state of the lines at power-up
  by_edges.sensors = board_sensors();
  by_edges.control.speed.settle_s = 0.1;
  by_edges.control.current.limit_A = 10;
  return {cascade(), sampled, one_shunt(sampled), flashed, one_shunt(flashed), hysteresis(), by_edges};
}

TEST(Wires, ThatAreMovedOnTogetherAreNotSeenByTheDrive) {
  for (Scenario s : drives()) {
    ask(s, measure(MetricKind::mean, Signal::gate_T1));
    ask(s, measure(MetricKind::mean, Signal::gate_T6));
    ask(s, measure(MetricKind::mean, Signal::duty));
    ask(s, measure(MetricKind::rms, Signal::current));
    ask(s, measure(MetricKind::final_value, Signal::speed));
    const Outcome a = outcome(straight(s)), b = outcome(moved_on(s));
    ASSERT_EQ(a.comparisons.size(), 5u);
    for (std::size_t n = 0; n < 5; ++n)
      EXPECT_NEAR(b.comparisons[n].measured, a.comparisons[n].measured, 1e-8) << n;
    EXPECT_EQ(b.turn_ons, a.turn_ons);
  }
}

TEST(Wires, CurrentsOfTheTraceAreTheMotorsAndItsGatesTheBoards) {
  const auto rows = [](const Scenario& s) {
    std::vector<std::vector<double>> out;
    outcome(s, {.on_record = [&](Row row) { out.emplace_back(row.begin(), row.end()); }});
    return out;
  };
  Scenario s = cascade();
  s.record.columns = {"i_a_A", "i_b_A", "i_c_A", "gate_T1", "gate_T2", "gate_T5", "gate_T6", "hall", "duty"};
  const auto a = rows(straight(s)), b = rows(moved_on(s));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    const std::size_t phase_at[] = {2, 3, 1};  // columns of i_b, i_c, i_a at legs a, b, c
    for (std::size_t leg = 0; leg < 3; ++leg) ASSERT_NEAR(b[n][phase_at[leg]], a[n][1 + leg], 1e-8) << n;
    for (std::size_t c = 4; c < 10; ++c) ASSERT_NEAR(b[n][c], a[n][c], 1e-8) << n << " column " << c;
  }
}

TEST(Wires, MayChangeDuringARunAndMustChangeSomething) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.load.coulomb_Nm = 0.01;
  s.duration_s = 60e-3;
  At swapped;
  swapped.time_s = 20e-3;
  swapped.bridge.phases = AtOrder::bac;
  swapped.sensors.hall_lines = AtOrder::acb;
  s.at.push_back(swapped);
  ask(s, measure(MetricKind::final_value, Signal::speed));
  EXPECT_LT(outcome(s).comparisons[0].measured, -50) << "a drive that ran forward brakes and turns round";
  At nothing;
  nothing.time_s = 30e-3;
  s.at.push_back(nothing);
  const auto refused = run(s);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.problems()[0]), ::testing::HasSubstr("changes nothing"));
}

TEST(Wires, AnInvertedLineIsNamedByTheProductDrive) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.2;
  At inverted;
  inverted.time_s = 0.1;
  inverted.sensors.hall_inverted = AtHallLines::line_3;
  s.at.push_back(inverted);
  EXPECT_TRUE(needs_general_plant(s));
  const Outcome out = outcome(s);
  ASSERT_TRUE(out.trip);
  EXPECT_THAT(out.trip->reasons, ::testing::Contains(::testing::HasSubstr("all")));
  EXPECT_EQ(out.trip->hall_line, 3);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The course that controllers are compared on, and what their figures are made of.
#include "sixstep/analysis/contest/contest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/scenarios.hpp"
#include "text/scenario/scenario_file.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::analysis;

base::Result<ContestBench> bench_of(const std::string& motor) {
  const auto sheet = text::read_sheet(motor);
  EXPECT_TRUE(sheet);
  return contest_bench({.motor = motor, .sheet = *sheet});
}

TEST(Contest, WindowsLieInTheirOrderAndHoldTenElectricalTurns) {
  for (const char* motor : {"maxon-251601", "maxon-339285", "teknic-m2310p", "dji-2212-920kv"}) {
    const auto bench = bench_of(motor);
    ASSERT_TRUE(bench) << motor;
    const Course& c = bench->course;
    EXPECT_GT(c.load_at_s, c.calm_s);
    EXPECT_GT(c.slow_at_s, c.load_at_s);
    EXPECT_GT(c.end_s - c.slow_calm_s, c.slow_at_s);
    const double turn_rad = 2 * std::numbers::pi / bench->design.motor.machine.pole_pairs;
    EXPECT_GE(c.calm_s * c.rated_rad_s, 10 * turn_rad);
    EXPECT_GE(c.slow_calm_s * c.slow_rad_s, 10 * turn_rad);
    // The bus drives the rated torque at the rated speed, K_t w + R i < U, with two fifths of that speed to spare.
    const design::MotorModel& m = bench->design.motor;
    EXPECT_LE(
        c.rated_rad_s,
        0.6 * (bench->design.bus_V - 2 * m.machine.R_ohm * bench->design.nominal_current_A) / m.K_t_Nm_A);
  }
}

TEST(Contest, UsualBridgeHasEdgesOfFiftyNanoseconds) {
  const auto bench = bench_of("maxon-251601");
  ASSERT_TRUE(bench);
  const study::Bridge b = usual_bridge(bench->design);
  EXPECT_NEAR(b.turn_on_J, 0.5 * 24 * 2.33 * 50e-9, 0.01 * b.turn_on_J);  // three digits, rounded up
  EXPECT_EQ(b.turn_on_J, b.turn_off_J);
  EXPECT_EQ(b.on_resistance_ohm, 0.011);  // 1 % of 1.03 ohm, two digits, rounded up
}

TEST(Contest, ABoardIsTakenAndItsSwitchesCostWhatIsUsualWhereItNamesNothing) {
  const auto sheet = text::read_sheet("maxon-251601");
  ASSERT_TRUE(sheet);
  study::Scenario board = sixstep::testing::cascade();
  board.bridge.on_resistance_ohm = 0.02;
  board.pwm.period_s = 40e-6;
  const auto ideal = contest_bench({.motor = "maxon-251601", .sheet = *sheet, .board = board});
  ASSERT_TRUE(ideal) << to_string(ideal.problems()[0]);
  EXPECT_EQ(ideal->scenario.bridge.on_resistance_ohm, 0.02);
  EXPECT_EQ(ideal->scenario.pwm.period_s, 40e-6);
  EXPECT_EQ(ideal->scenario.bridge.turn_on_J, usual_bridge(ideal->design).turn_on_J);
  board.bridge = {.turn_on_J = 3e-6, .turn_off_J = 2e-6, .energies_at_V = 24, .energies_at_A = 5};
  const auto named = contest_bench({.motor = "maxon-251601", .sheet = *sheet, .board = board});
  ASSERT_TRUE(named);
  EXPECT_EQ(named->scenario.bridge.turn_on_J, 3e-6);
}

TEST(Contest, FiguresAreSumsOfGauges) {
  std::vector<double> gauges(std::size(contest_gauges));
  for (std::size_t n = 0; n < gauges.size(); ++n)
    gauges[n] = std::pow(2.0, double(n));  // no two sums are alike
  const auto gauge = [&](Gauge g) { return gauges[static_cast<std::size_t>(g)]; };
  const std::vector<double> values = contest_values_of(gauges);
  ASSERT_EQ(values.size(), std::size(contest_figures));
  EXPECT_EQ(values[loss_figure], gauge(Gauge::copper) + gauge(Gauge::conduction) + gauge(Gauge::switching));
  EXPECT_EQ(values[ripple_figure], gauge(Gauge::ripple_rms));
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (contest_figures[f].less != Gauge::least_torque) continue;
    EXPECT_EQ(values[f], gauge(Gauge::mean_torque) - gauge(Gauge::least_torque));
  }
  // Each gauge stands where its name says.
  EXPECT_EQ(contest_gauges[static_cast<std::size_t>(Gauge::turn_ons)].signal, study::Signal::gate_T1);
  EXPECT_EQ(contest_gauges[static_cast<std::size_t>(Gauge::brake_peak)].part, CoursePart::brake);
  EXPECT_EQ(static_cast<std::size_t>(Gauge::none), std::size(contest_gauges));
}

TEST(Contest, TheWorstOfDrivesIsTheLargestAndNoValueIsWorse) {
  PlanColumns columns;
  columns.figures.assign(std::size(contest_gauges), {"x", "1"});
  RunRecord record;
  record.figures.assign(std::size(contest_gauges), 1.0);
  Contest contest;
  contest.drives = 2;
  contest.rows.resize(2);
  ContestRow& row = contest.rows[1];
  take_nominal(row, record, columns);
  EXPECT_TRUE(row.nominal_held);
  record.number = 2;  // the second controller's first drive
  const std::size_t settles = static_cast<std::size_t>(Gauge::start_settles),
                    peak = static_cast<std::size_t>(Gauge::start_peak);
  record.figures[settles] = 0.5;
  record.figures[peak] = 3.0;
  take_drive(contest, record, columns);
  EXPECT_EQ(row.worst[0], 1.0);
  EXPECT_EQ(row.worst[2], 3.0);
  record.figures[settles] = std::numeric_limits<double>::quiet_NaN();
  record.end = RunEnd::fault;
  take_drive(contest, record, columns);
  EXPECT_TRUE(std::isnan(row.worst[0]));
  EXPECT_EQ(row.drives, 2U);
  EXPECT_EQ(row.held, 1U);
  EXPECT_EQ(contest.rows[0].drives, 0U);
  record.number = 4;  // of no controller
  take_drive(contest, record, columns);
  EXPECT_EQ(row.drives, 2U);
}

TEST(Contest, ALinearMotorAndABusTooLowAreRefused) {
  const auto linear = bench_of("example-linear");
  ASSERT_FALSE(linear);
  EXPECT_NE(to_string(linear.problems().front()).find("linear"), std::string::npos);
  const auto sheet = text::read_sheet("maxon-251601");
  ASSERT_TRUE(sheet);
  EXPECT_FALSE(
      contest_bench({.motor = "maxon-251601", .sheet = *sheet, .voltage_V = 2.0}));  // 2.33 A need 2.4 V
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// Tests the course on which controllers are compared, and the figures that are computed from its runs.
#include "sixstep/analysis/contest/contest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "sixstep/study/measure/figures.hpp"
#include "tests/support/scenarios.hpp"
#include "text/scenario/scenario_file.hpp"

namespace SIXSTEP_TEST_FILE {

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
    EXPECT_GE(c.calm_s * c.high_rad_s, 10 * turn_rad);
    EXPECT_GE(c.slow_calm_s * c.slow_rad_s, 10 * turn_rad);
    // The bus voltage U limits the speed w under full load: K_t w + 2 R i = U, with the nominal current i.
    // The high speed is at most 0.6 times this limit.
    const design::MotorModel& m = bench->design.motor;
    EXPECT_LE(
        c.high_rad_s,
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
  GaugeValues gauges{};
  // so that all sums differ
  for (std::size_t n = 0; n < gauges.size(); ++n) gauges[n] = std::pow(2.0, double(n));
  const auto gauge = [&](Gauge g) { return gauges[static_cast<std::size_t>(g)]; };
  const ContestValues values = contest_values_of(gauges);
  EXPECT_EQ(values[loss_figure], gauge(Gauge::copper) + gauge(Gauge::conduction) + gauge(Gauge::switching));
  EXPECT_EQ(values[ripple_figure], gauge(Gauge::ripple_rms));
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (contest_figures[f].less != Gauge::least_torque) continue;
    EXPECT_EQ(values[f], gauge(Gauge::mean_torque) - gauge(Gauge::least_torque));
  }
  // The list contest_gauges has the order of the enumeration Gauge.
  EXPECT_EQ(contest_gauges[static_cast<std::size_t>(Gauge::turn_ons)].signal, study::Signal::gate_T1);
  EXPECT_EQ(contest_gauges[static_cast<std::size_t>(Gauge::brake_peak)].part, CoursePart::brake);
  EXPECT_EQ(static_cast<std::size_t>(Gauge::none), std::size(contest_gauges));
}

/// A contest with invented results. Two controllers run with a spread of three values, as in
/// contest_entries().
struct MadeUp {
  Contest contest;

  MadeUp() {
    base::Result<ContestBench> bench = bench_of("maxon-251601");
    study::Scenario scenario = bench->scenario;
    for (const char* key :
         {"motor_override.resistance_ohm", "motor_override.inductance_mH", "supply.voltage_V"})
      scenario.spread.emplace_back().key = key;
    const std::span<const Contestant> who = contestants();
    contest = contest_of(*bench, {{&who[0], {}, scenario}, {&who[1], {}, scenario}}, 2, 1);
  }
  /// All requirements hold, and each gauge is a power of two, so all figures differ.
  study::Outcome outcome() const {
    const study::Scenario& s = *contest.entries[0].scenario;
    study::Outcome o;
    for (const study::Requirement& r : s.require)
      o.verdicts.push_back({r.measure.label, "rad/s", *r.min, r.min, r.max, true});
    for (std::size_t g = 0; g < std::size(contest_gauges); ++g)
      o.comparisons.push_back({std::string(contest_gauges[g].label),
                               std::string(study::figure_unit(s.compare[g].measure)),
                               std::pow(2.0, double(g)), 0.0, ""});
    return o;
  }
  RunRecord drive(std::size_t number, const study::Outcome& o) const {
    PlannedRun run{*contest.entries[0].scenario, {}};
    for (const InputColumn& column : contest.columns->strayed) run.strayed.push_back({column.key, 1e6});
    return record_of(contest.columns, number, point_of_run(contest.plan, number), run, o);
  }
};

/// A row begins with the values of the spread. Each figure is still found by its name.
TEST(Contest, AFigureIsFoundByItsNameWhateverStandsBeforeIt) {
  MadeUp made;
  EXPECT_EQ(made.contest.columns->strayed.size(), 3U);
  const study::Outcome o = made.outcome();
  take_nominal(made.contest, 0, o);
  take_drive(made.contest, made.drive(0, o));
  const ContestRow& row = made.contest.rows[0];
  ASSERT_EQ((*row.nominal)->problem, "");
  GaugeValues gauges{};
  for (std::size_t g = 0; g < gauges.size(); ++g) gauges[g] = std::pow(2.0, double(g));
  EXPECT_EQ(row.values, contest_values_of(gauges));
  EXPECT_EQ(row.worst, row.values);
  EXPECT_EQ(row.held, 1U);
}

TEST(Contest, ARunOfOtherValuesOrFiguresIsNoRow) {
  const MadeUp made;
  PlannedRun run{*made.contest.entries[0].scenario, {{"supply.voltage_V", 24.0}}};
  const auto row = [&](const PlannedRun& r, const study::Outcome& o) {
    return record_of(made.contest.columns, 0, point_of_run(made.contest.plan, 0), r, o);
  };
  EXPECT_EQ(row(run, made.outcome())->end, RunEnd::refused) << "one of three strays";
  run.strayed.clear();
  for (const InputColumn& column : made.contest.columns->strayed) run.strayed.push_back({column.key, 1.0});
  EXPECT_EQ(row(run, made.outcome())->end, RunEnd::whole);
  study::Outcome other = made.outcome();
  std::swap(other.comparisons[0], other.comparisons[1]);
  EXPECT_EQ(row(run, other)->end, RunEnd::refused);
  other = made.outcome();
  other.comparisons.pop_back();
  EXPECT_NE(row(run, other)->problem, "");
  std::swap(run.strayed[0], run.strayed[1]);
  EXPECT_EQ(row(run, made.outcome())->end, RunEnd::refused);
  RunValues values = *made.drive(0, made.outcome());
  values.figures.insert(values.figures.begin(), {1.0, 2.0, 3.0});
  EXPECT_FALSE(RunRecord::of(made.contest.columns, values));
}

TEST(Contest, TheWorstOfDrivesIsTheLargestAndNoValueIsWorse) {
  MadeUp made;
  study::Outcome o = made.outcome();
  double& settles = o.comparisons[static_cast<std::size_t>(Gauge::start_settles)].measured;
  double& peak = o.comparisons[static_cast<std::size_t>(Gauge::start_peak)].measured;
  take_nominal(made.contest, 1, o);
  const ContestRow& row = made.contest.rows[1];
  EXPECT_TRUE(row.nominal_held);
  const double nominal_s = settles;
  settles = nominal_s / 2;
  peak *= 3.0;
  take_drive(made.contest, made.drive(2, o));  // the second controller's first drive
  EXPECT_EQ((*row.worst)[0], nominal_s);
  EXPECT_EQ((*row.worst)[2], peak);
  settles = std::numeric_limits<double>::quiet_NaN();
  o.fault = base::Problem{"t = 1 s", "", "shoot-through", ""};
  take_drive(made.contest, made.drive(3, o));
  EXPECT_TRUE(std::isnan((*row.worst)[0]));
  EXPECT_EQ(row.drives, 2U);
  EXPECT_EQ(row.held, 1U);
  EXPECT_EQ(made.contest.rows[0].drives, 0U);
  take_drive(made.contest, made.drive(4, o));  // no controller has a run of this number
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

}  // namespace SIXSTEP_TEST_FILE

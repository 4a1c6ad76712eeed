// SPDX-License-Identifier: Apache-2.0
// The runs of a plan are equal to single runs, for any number of threads. They can be stopped and
// interrupted.
#include "batch/plan_runs.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "sixstep/analysis/statistics/series.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "tests/support/scenarios.hpp"

namespace batch {
namespace SIXSTEP_TEST_FILE {

using namespace sixstep::testing;

study::Spread spread(const char* key, double relative) {
  study::Spread s;
  s.key = key;
  s.relative = relative;
  return s;
}

/// Several drives of one scenario, as the option --runs simulates them.
struct Drives {
  study::Scenario scenario;
  analysis::Plan plan;
  analysis::TableColumns columns = analysis::columns_of(plan, scenario);
  std::mutex guard{};
  std::map<std::size_t, analysis::RunRecord> rows{};

  Drives(study::Scenario s, std::size_t count, std::uint64_t seed)
      : scenario(std::move(s)), plan{.axes = {}, .drives = count, .seed = seed} {}

  PlanRuns runs(unsigned jobs = 0) {
    return {.plan = plan,
            .columns = columns,
            .scenario = [this](std::size_t n) -> base::Result<analysis::PlannedRun> {
              return analysis::planned_drive(scenario, plan.seed, n);
            },
            .wanted = {},
            .take =
                [this](analysis::RunRecord&& record) {
                  const std::lock_guard lock(guard);
                  const std::size_t n = record->number;
                  rows.emplace(n, std::move(record));
                },
            .stop = {},
            .jobs = jobs};
  }
  analysis::Series series() const {
    analysis::Series all = analysis::series_of(*columns);
    for (const auto& [n, row] : rows) add(all, row);
    return all;
  }
};

/// A locked rotor at full voltage. The final current is U/R_tt (1 - exp(-t/tau)) with the bus voltage U, the
/// line-to-line resistance R_tt and the time constant tau. The run lasts 30 time constants.
study::Scenario stall(double limit_A) {
  study::Scenario s = maxon_scenario(sixstep::control::Mode::duty, 1.0);
  s.load.locked = true;
  s.duration_s = 30 * 0.572e-3 / 1.03;
  study::Requirement r;
  r.measure = measure(study::MetricKind::final_value, study::Signal::current);
  r.max = limit_A;
  s.require.push_back(r);
  ask(s, measure(study::MetricKind::maximum, study::Signal::current));
  return s;
}

TEST(PlanRuns, GiveTheSpreadThatTheCircuitsLawGives) {
  study::Scenario s = stall(24.0 / 1.03);
  s.spread = {spread("motor_override.resistance_ohm", 0.1)};
  ASSERT_EQ(study::check(s), base::Problems{});
  constexpr std::size_t count = 200;
  Drives drives(s, count, 11);
  run_plan(drives.runs());
  const analysis::Series series = drives.series();
  ASSERT_EQ(series.runs, count);
  ASSERT_EQ(series.figures.size(), 2u);
  const analysis::SpreadFigure& current = series.figures[0];
  std::size_t holds = 0;
  analysis::Statistics expected;
  for (std::size_t n = 0; n < count; ++n) {
    const double R = study::varied(s, 11, n).sheet.resistance_ohm->value, tau_s = 0.572e-3 / R;
    EXPECT_EQ(drives.rows.at(n)->strayed, std::vector<double>{R});
    expected.add(24.0 / R * (1.0 - std::exp(-s.duration_s / tau_s)));
    holds += R >= 1.03;
  }
  // The error of the engine is 2e-15 of the current (README, R1), which is nine roundings. exp() in the
  // expected value adds its own rounding error.
  constexpr double bound = 16 * 0x1p-52 * 24.0 / 0.927;
  for (const double p : {0.0, 0.05, 0.5, 0.95, 1.0})
    EXPECT_NEAR(*current.statistics.quantile(p), *expected.quantile(p), bound) << p;
  EXPECT_NEAR(*current.statistics.mean(), *expected.mean(), bound);
  EXPECT_NEAR(*current.statistics.standard_deviation(), *expected.standard_deviation(), bound);
  EXPECT_EQ(current.holds, holds);
  EXPECT_EQ(series.passed, holds);
  EXPECT_TRUE(current.column.required);
  EXPECT_FALSE(series.figures[1].column.required);
}

study::Scenario two_ms() {
  study::Scenario s = current_square();
  s.duration_s = 2e-3;
  s.spread = {spread("motor_override.inductance_mH", 0.2), spread("supply.voltage_V", 0.1)};
  return s;
}

TEST(PlanRuns, AreEachRunAloneToTheBitOnAnyNumberOfThreads) {
  const study::Scenario s = two_ms();
  std::uint64_t whole = 0;
  for (const unsigned jobs : {1u, 2u, 3u, 8u}) {
    Drives drives(s, 20, 3);
    run_plan(drives.runs(jobs));
    ASSERT_EQ(drives.rows.size(), 20u);
    for (const auto& [n, row] : drives.rows)
      EXPECT_EQ(row->digest, study::run(study::varied(s, 3, n))->digest);
    if (jobs == 1) whole = drives.series().digest;
    EXPECT_EQ(drives.series().digest, whole) << jobs;
  }
  Drives few(s, 7, 3);
  run_plan(few.runs(2));
  EXPECT_EQ(few.rows.at(6)->digest, study::run(study::varied(s, 3, 6))->digest)
      << "a longer series begins as a shorter one";
}

TEST(PlanRuns, MakeWhatIsWantedAlone) {
  Drives drives(two_ms(), 20, 3);
  PlanRuns runs = drives.runs(2);
  runs.wanted = [](std::size_t n) { return n % 3 == 1; };
  run_plan(runs);
  ASSERT_EQ(drives.rows.size(), 7u);
  for (const auto& [n, row] : drives.rows) EXPECT_EQ(n % 3, 1u);
}

TEST(PlanRuns, CountWhatCouldNotStartAndGoOn) {
  Drives drives(stall(100.0), 4, 1);
  PlanRuns runs = drives.runs(1);
  runs.scenario = [&](std::size_t n) -> base::Result<analysis::PlannedRun> {
    study::Scenario s = drives.scenario;
    if (n % 2 == 0) s.sheet.resistance_ohm->value = 0.0;
    if (n == 3) return base::Problem{"--set a.b", "1", "is not a key", "write another"};
    return analysis::PlannedRun{std::move(s), {}};
  };
  run_plan(runs);
  const analysis::Series series = drives.series();
  EXPECT_EQ(series.runs, 4u);
  EXPECT_EQ(series.passed, 1u);
  ASSERT_EQ(series.refused.size(), 3u);
  EXPECT_EQ(series.refused[1].number, 2u);
  EXPECT_THAT(series.refused[1].problem, ::testing::HasSubstr("resistance_ohm"));
  EXPECT_THAT(series.refused[2].problem, ::testing::HasSubstr("--set a.b"));
  ASSERT_EQ(series.figures.size(), 2u);
  EXPECT_EQ(series.figures[0].holds, 1u);
  EXPECT_EQ(series.figures[0].statistics.count(), 1u);
  EXPECT_EQ(series.figures[0].statistics.missing(), 3u);
}

/// As in a single run, the measured values fulfil the requirements although a fault stopped the run. The
/// report also names the fault.
TEST(PlanRuns, AFaultIsToldBesideRequirementsThatTheValuesHold) {
  const Drives drives(stall(100.0), 2, 1);
  const base::Result<study::Outcome> whole = study::run(stall(100.0));
  study::Outcome stopped = *whole;
  stopped.fault = base::Problem{"t = 0.1 s", "", "shoot-through", ""};
  analysis::Series series = analysis::series_of(*drives.columns);
  const analysis::PlannedRun run{drives.scenario, {}};
  add(series, analysis::record_of(drives.columns, 0, {}, run, whole));
  add(series, analysis::record_of(drives.columns, 1, {}, run, stopped));
  EXPECT_EQ(series.passed, 1u);
  EXPECT_EQ(series.figures[0].holds, 2u);
  EXPECT_FALSE(series.figures[0].missed);
  ASSERT_EQ(series.faults.size(), 1u);
  EXPECT_EQ(series.faults[0].number, 1u);
}

TEST(PlanRuns, AStopEndsTheRunsUnderWayAndLeavesNoRowOfThem) {
  study::Scenario s = two_ms();
  s.duration_s = 3600.0;  // hours of work each
  Drives drives(s, 50, 1);
  std::stop_source stop;
  PlanRuns runs = drives.runs(2);
  runs.stop = stop.get_token();
  std::atomic<int> begun = 0;
  runs.scenario = [&, make = runs.scenario](std::size_t n) {
    if (++begun == 2) stop.request_stop();
    return make(n);
  };
  run_plan(runs);
  EXPECT_TRUE(drives.rows.empty());
  EXPECT_LE(begun, 3);
}

TEST(PlanRuns, AnExceptionOfWhoTakesThemEndsTheBatchAndComesOut) {
  for (const unsigned jobs : {1u, 3u}) {
    Drives drives(two_ms(), 1'000'000'000, 1);
    std::atomic<std::size_t> begun{0};
    PlanRuns runs = drives.runs(jobs);
    runs.scenario = [&, make = runs.scenario](std::size_t n) {
      ++begun;
      return make(n);
    };
    runs.take = [](analysis::RunRecord&& record) {
      if (record->number == 4) throw std::runtime_error("full disk");
    };
    EXPECT_THROW(run_plan(runs), std::runtime_error);
    EXPECT_LE(begun, 1000u);
  }
}

TEST(PlanRuns, OfNothingAreNothing) {
  Drives drives(two_ms(), 3, 1);
  PlanRuns runs = drives.runs(2);
  runs.wanted = [](std::size_t) { return false; };
  run_plan(runs);
  EXPECT_TRUE(drives.rows.empty());
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace batch

// SPDX-License-Identifier: Apache-2.0
// The points of a plan are checked against the law of each sampling method.
#include "sixstep/analysis/plan/plan.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "sixstep/analysis/plan/permuted.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::Axis;
using analysis::Plan;
using analysis::Sampling;
using analysis::Spacing;
using ::testing::ElementsAre;

Axis range(const std::string& key, double from, double to, std::size_t points = 0) {
  return {.key = key, .values = {}, .from = from, .to = to, .points = points};
}

Plan range_plan() { return {.axes = {range("a", 1, 2, 3)}}; }

TEST(Plan, AGridHasEveryValueWithEveryOtherTheLastAxisFirst) {
  const Plan plan{.axes = {{.key = "pwm.chopping", .values = {"\"soft\"", "\"hard\""}}, range("b", 1, 2, 3)}};
  ASSERT_EQ(analysis::runs_of(plan), 6u);
  EXPECT_THAT(analysis::point_of_run(plan, 0), ElementsAre("\"soft\"", "1"));
  EXPECT_THAT(analysis::point_of_run(plan, 1), ElementsAre("\"soft\"", "1.5"));
  EXPECT_THAT(analysis::point_of_run(plan, 2), ElementsAre("\"soft\"", "2"));
  EXPECT_THAT(analysis::point_of_run(plan, 3), ElementsAre("\"hard\"", "1"));
  EXPECT_THAT(analysis::point_of_run(plan, 5), ElementsAre("\"hard\"", "2"));
}

/// The size of a temperature is its rise above ambient; the size of a difference of temperatures counts from
/// 0. Another zero of the temperature scale changes no size.
TEST(Plan, TheSizeOfATemperatureIsItsRise) {
  for (const double zero : {0.0, 273.15}) {
    study::Scenario s = sixstep::testing::maxon_scenario(control::Mode::duty, 1.0);
    s.heat.ambient_degC = 25 + zero;
    for (const study::MetricKind metric : {study::MetricKind::maximum, study::MetricKind::peak_to_peak}) {
      study::Requirement r;
      r.measure = sixstep::testing::measure(metric, study::Signal::winding_temperature);
      r.max = metric == study::MetricKind::maximum ? 85 + zero : 60;
      s.require.push_back(r);
    }
    const auto columns = analysis::columns_of(range_plan(), s);
    for (const analysis::FigureColumn& f : columns->figures) EXPECT_DOUBLE_EQ(f.size(*f.max), 60) << f.name;
  }
}

TEST(Plan, ALogarithmicGridHasEqualRatiosAndExactEnds) {
  Plan plan{.axes = {range("a", 3e-6, 0.7, 8)}};
  plan.axes[0].spacing = Spacing::logarithmic;
  std::vector<double> x;
  for (std::size_t n = 0; n < 8; ++n) x.push_back(std::stod(analysis::point_of_run(plan, n)[0]));
  EXPECT_EQ(x.front(), 3e-6);
  EXPECT_EQ(x.back(), 0.7);
  for (std::size_t n = 0; n + 1 < 8; ++n) EXPECT_NEAR(x[n + 1] / x[n], std::pow(0.7 / 3e-6, 1.0 / 7), 1e-10);
}

TEST(Plan, ALatinHypercubeHasOnePointInEachPartOfEachAxis) {
  for (const std::size_t points : {1u, 2u, 7u, 100u, 1000u}) {
    const Plan plan{.axes = {range("a", 0, 1), range("b", 0, 1), range("c", 0, 1)},
                    .sampling = Sampling::latin_hypercube,
                    .points = points,
                    .seed = 5};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::set<std::size_t> parts;
      for (std::size_t n = 0; n < points; ++n)
        parts.insert(
            static_cast<std::size_t>(analysis::coordinates(plan, n)[axis] * static_cast<double>(points)));
      EXPECT_EQ(parts.size(), points) << axis;
      EXPECT_LT(*parts.rbegin(), points);
    }
  }
}

TEST(Plan, ASaltelliRowHasTwoPointsAndEachKeyOfOneInTheOther) {
  const Plan plan{.axes = {range("a", 0, 1), range("b", 0, 1)}, .sampling = Sampling::saltelli, .points = 3};
  ASSERT_EQ(analysis::points_of(plan), 12u);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto a = analysis::coordinates(plan, 4 * row), b = analysis::coordinates(plan, 4 * row + 1);
    EXPECT_THAT(analysis::coordinates(plan, 4 * row + 2), ElementsAre(b[0], a[1]));
    EXPECT_THAT(analysis::coordinates(plan, 4 * row + 3), ElementsAre(a[0], b[1]));
  }
}

TEST(Plan, EachPointIsRunOnEachDrive) {
  const Plan plan{.axes = {range("a", 0, 1, 2)}, .drives = 3};
  ASSERT_EQ(analysis::runs_of(plan), 6u);
  EXPECT_EQ(analysis::drive_of_run(plan, 4), 1u);
  EXPECT_THAT(analysis::point_of_run(plan, 4), ElementsAre("1"));
  EXPECT_THAT(analysis::point_of_run(plan, 2), ElementsAre("0"));
}

TEST(Plan, ListedValuesAreDrawnAlike) {
  const Plan plan{.axes = {{.key = "a", .values = {"1", "2", "4"}}},
                  .sampling = Sampling::latin_hypercube,
                  .points = 300};
  int ones = 0;
  for (std::size_t n = 0; n < 300; ++n) ones += analysis::point_of_run(plan, n)[0] == "1";
  EXPECT_EQ(ones, 100);
}

TEST(Plan, APermutationMeetsEveryPlaceOnce) {
  for (const std::uint64_t count : {1u, 2u, 3u, 10u, 255u, 256u, 257u, 5000u}) {
    std::set<std::uint64_t> places;
    for (std::uint64_t n = 0; n < count; ++n) places.insert(analysis::permuted(n, count, 1, 2));
    EXPECT_EQ(places.size(), count);
    EXPECT_LT(*places.rbegin(), count);
  }
}

TEST(Plan, EveryMistakeIsToldAtItsKey) {
  const auto where = [](const Plan& plan) {
    const base::Problems problems = analysis::check(plan);
    return problems.empty() ? "" : problems.front().where;
  };
  EXPECT_EQ(where({}), "vary");
  EXPECT_EQ(where({.axes = {range("a", 0, 1, 1)}}), "vary[0].points");
  EXPECT_EQ(where({.axes = {range("a", 0, NAN, 3)}}), "vary[0].from");
  EXPECT_EQ(where({.axes = {range("a", 0, 1, 3), range("a", 0, 2, 3)}}), "vary[1].key");
  Plan log{.axes = {range("a", 0, 1, 3)}};
  log.axes[0].spacing = Spacing::logarithmic;
  EXPECT_EQ(where(log), "vary[0].from");
  EXPECT_EQ(where({.axes = {range("a", 0, 1)}, .sampling = Sampling::sobol}), "points");
  EXPECT_EQ(where({.axes = {range("a", 0, 1, 100000), range("b", 0, 1, 100000)}}), "points");
  Plan wide{.sampling = Sampling::saltelli, .points = 1};
  for (int n = 0; n < 33; ++n) wide.axes.push_back(range(std::to_string(n), 0, 1));
  EXPECT_EQ(where(wide), "vary");
}

}  // namespace SIXSTEP_TEST_FILE

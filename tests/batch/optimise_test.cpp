// SPDX-License-Identifier: Apache-2.0
// The search finds the optimum of a locked rotor, I = U/R, and names the active limit.
#include "batch/optimise.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <mutex>

#include "sixstep/study/scenario/spread.hpp"
#include "tests/support/scenarios.hpp"

namespace batch {
namespace SIXSTEP_TEST_FILE {

using namespace sixstep::testing;
using ::testing::ElementsAre;

/// The rotor is locked at full voltage for thirty time constants. The figure is the final current.
struct Held {
  std::optional<double> min, max;
  std::size_t drives = 0;
  double spread = 0.0;
  bool tells_current = false;  ///< reports the current also as a compared figure

  analysis::Plan plan() const {
    return {.axes = {{.key = "supply.voltage_V", .values = {}, .from = 6, .to = 24},
                     {.key = "motor_override.resistance_ohm",
                      .values = {},
                      .from = 1,
                      .to = 4,
                      .spacing = analysis::Spacing::logarithmic}},
            .sampling = analysis::Sampling::sobol,
            .points = 100,
            .drives = drives};
  }
  study::Scenario scenario() const {
    study::Scenario s = maxon_scenario(sixstep::control::Mode::duty, 1.0);
    s.load.locked = true;
    s.duration_s = 30 * 0.572e-3;
    study::Requirement r;
    r.measure = measure(study::MetricKind::final_value, study::Signal::current);
    r.min = min;
    r.max = max;
    if (min || max) s.require.push_back(r);
    ask(s, measure(study::MetricKind::maximum, study::Signal::current));
    if (spread > 0) {
      study::Spread strays;
      strays.key = "motor_override.resistance_ohm";
      strays.relative = spread;
      s.spread.push_back(strays);
    }
    return s;
  }
};

struct Found {
  std::optional<analysis::Optimum> best;
  std::map<std::size_t, analysis::RunRecord> rows;
  double U = 0.0, R = 0.0;
};

Found search(const Held& held, std::size_t evaluations, unsigned jobs = 1,
             const std::map<std::size_t, analysis::RunRecord>& before = {}) {
  const analysis::Plan plan = held.plan();
  const study::Scenario nominal = held.scenario();
  const analysis::TableColumns columns = analysis::columns_of(plan, nominal);
  Found found;
  std::mutex guard;
  const auto at = [&](const std::vector<std::string>& point,
                      std::size_t drive) -> base::Result<analysis::PlannedRun> {
    study::Scenario s = nominal;
    s.supply.voltage_V = std::stod(point[0]);
    s.sheet.resistance_ohm->value = std::stod(point[1]);
    if (plan.drives == 0) return analysis::PlannedRun{s, {}};
    return analysis::planned_drive(s, plan.seed, drive);
  };
  found.best = optimise({.plan = plan,
                         .columns = columns,
                         .figure = columns->figures.size() - 1,
                         .evaluations = evaluations,
                         .scenario = at,
                         .known = [&](std::size_t n) -> std::optional<analysis::RunRecord> {
                           const auto row = before.find(n);
                           return row == before.end() ? std::nullopt : std::optional(row->second);
                         },
                         .take =
                             [&](analysis::RunRecord&& row) {
                               const std::lock_guard lock(guard);
                               const std::size_t n = row->number;
                               found.rows.emplace(n, std::move(row));
                             },
                         .progress = {},
                         .stop = {},
                         .jobs = jobs});
  if (found.best) {
    found.U = std::stod(found.best->point[0]);
    found.R = std::stod(found.best->point[1]);
  }
  return found;
}

TEST(Optimise, WithoutRequirementsEndsInTheCornerOfTheLeastCurrent) {
  const Found found = search({}, 100);
  ASSERT_TRUE(found.best);
  EXPECT_NEAR(found.U, 6.0, 6e-3);
  EXPECT_NEAR(found.R, 4.0, 4e-3 * std::log(4.0));
  EXPECT_TRUE(found.best->holds);
  ASSERT_EQ(found.best->limits.size(), 2u);
  EXPECT_EQ(found.best->limits[0].what, "supply.voltage_V");
  EXPECT_FALSE(found.best->limits[0].upper);
  EXPECT_EQ(found.best->limits[1].what, "motor_override.resistance_ohm");
  EXPECT_TRUE(found.best->limits[1].upper);
}

/// With enough points, the search ends at the smallest current, I = 6 V/4 ohm. With too few points, it stops
/// earlier and reports this.
TEST(Optimise, SaysWhetherItEndedByItself) {
  const Found enough = search({}, 400), few = search({}, 4);
  ASSERT_TRUE(enough.best && few.best);
  EXPECT_TRUE(enough.best->converged);
  EXPECT_LT(enough.best->evaluations, 400u);
  EXPECT_FALSE(few.best->converged);
  EXPECT_EQ(few.best->evaluations, 4u);
  const auto current = [](const Found& f) { return f.best->figures.back(); };
  EXPECT_NEAR(current(enough), 1.5, 2e-3);
  EXPECT_GT(current(few), current(enough)) << "there was less to be found";
}

TEST(Optimise, StopsAtARequirementAndNamesIt) {
  const Found found = search({.min = 10.0}, 100);
  ASSERT_TRUE(found.best);
  EXPECT_TRUE(found.best->holds);
  EXPECT_GE(found.best->figures[0], 10.0);
  EXPECT_LE(found.best->figures[0], 10.01);
  EXPECT_NEAR(found.U / found.R, found.best->figures[0], 1e-9 * 10.0);
  ASSERT_FALSE(found.best->limits.empty());
  EXPECT_FALSE(found.best->limits[0].of_key);
  EXPECT_FALSE(found.best->limits[0].upper);
}

/// The drives of the spread differ in their resistance. The drive with the largest resistance determines the
/// result.
TEST(Optimise, IsRobustOverTheDrives) {
  const Held held{.min = 10.0, .drives = 6, .spread = 0.1};
  const Found found = search(held, 60, 2);
  ASSERT_TRUE(found.best);
  ASSERT_TRUE(found.best->holds);
  study::Scenario s = held.scenario();
  s.supply.voltage_V = found.U;
  s.sheet.resistance_ohm->value = found.R;
  double least = 1e9, most = 0.0;
  for (std::size_t n = 0; n < 6; ++n) {
    const double I = found.U / study::varied(s, 1, n).sheet.resistance_ohm->value;
    least = std::min(least, I);
    most = std::max(most, I);
  }
  EXPECT_NEAR(found.best->figures[0], least, 1e-8);
  EXPECT_NEAR(found.best->figures[1], most, 1e-8);
  EXPECT_GE(least, 10.0);
  EXPECT_LE(least, 10.1);
}

TEST(Optimise, TellsTheNearestPointWhereNoneHolds) {
  const Found found = search({.min = 30.0}, 100);
  ASSERT_TRUE(found.best);
  EXPECT_FALSE(found.best->holds);
  EXPECT_GT(found.best->figures[0], 23.9) << "24 V over 1 ohm is the most there is";
}

TEST(Optimise, TakesTheSameWayOnAnyNumberOfThreadsAndFromRowsThatAreThere) {
  const Held held{.min = 10.0, .drives = 3, .spread = 0.1};
  const Found one = search(held, 40, 1), two = search(held, 40, 3);
  EXPECT_EQ(one.best->point, two.best->point);
  ASSERT_EQ(one.rows.size(), two.rows.size());
  std::map<std::size_t, analysis::RunRecord> half = one.rows;
  half.erase(half.find(60), half.end());
  half.erase(7);
  const Found again = search(held, 40, 2, half);
  EXPECT_EQ(again.best->point, one.best->point);
  EXPECT_EQ(again.rows.size(), one.rows.size() - half.size()) << "what was there was not run again";
  for (const auto& [n, row] : again.rows) EXPECT_EQ(row->digest, one.rows.at(n)->digest);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace batch

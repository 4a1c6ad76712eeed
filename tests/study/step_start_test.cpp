// SPDX-License-Identifier: Apache-2.0
// A figure of merit derives its start from the steps of a reference (docs/reference/figures.md). It is
// compared with windows whose start is given.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

/// The largest figure of the steps 0, 5, -5, 5, -5 A. Each step is measured in a separate window, with the
/// start that `start_of` returns.
template <class StartOf>
double slowest(MetricKind metric, StartOf start_of) {
  Scenario s = current_square();
  for (int n = 0; n < 4; ++n) {
    Measure m = measure(metric, Signal::current);
    m.from_s = n * 5e-3;
    m.to_s = (n + 1) * 5e-3;
    m.level = n % 2 == 0 ? 5.0 : -5.0;
    m.start = start_of(n);
    ask(s, m);
  }
  const std::vector<double> each = figures_of(s);
  return *std::max_element(each.begin(), each.end());
}

double own_steps(MetricKind metric, std::optional<double> start = {}) {
  Scenario s = current_square();
  Measure m = measure(metric, Signal::current);
  m.start = start;
  ask(s, m);
  return figures_of(s)[0];
}

double level_before(int n) { return n == 0 ? 0.0 : n % 2 == 0 ? -5.0 : 5.0; }
double zero(int) { return 0.0; }

TEST(StepStart, OfARiseIsTheReferencesLevelBefore) {
  const double rise = slowest(MetricKind::rise_time, level_before);
  EXPECT_EQ(own_steps(MetricKind::rise_time), rise);
  EXPECT_NE(rise, slowest(MetricKind::rise_time, zero)) << "else this test shows nothing";
}

TEST(StepStart, OfAReachIsZeroAtTheReversalsOfASquare) {
  const double reach = slowest(MetricKind::reach_time, zero);
  EXPECT_EQ(own_steps(MetricKind::reach_time), reach);
  EXPECT_NE(reach, slowest(MetricKind::reach_time, level_before)) << "else this test shows nothing";
}

TEST(StepStart, IsTheGivenOneWhereOneIsGiven) {
  const auto given = [](int) { return 2.0; };
  for (const MetricKind metric : {MetricKind::reach_time, MetricKind::rise_time})
    EXPECT_EQ(own_steps(metric, 2.0), slowest(metric, given));
}

}  // namespace SIXSTEP_TEST_FILE

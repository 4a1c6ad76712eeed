// SPDX-License-Identifier: Apache-2.0
// A reference may have any number of steps. In a segment, only the figure of merit of the present step is
// computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "sixstep/study/run/run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

double cpu_seconds(const study::Scenario& s) {
  const std::clock_t begin = std::clock();
  const auto out = study::run(s, {.keep_books = false});
  EXPECT_TRUE(out);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// The minimum of three runs, because other programs on the machine make a run longer, never shorter.
double least_cpu_seconds(const study::Scenario& s) {
  return std::min({cpu_seconds(s), cpu_seconds(s), cpu_seconds(s)});
}

// If each segment called all 4000 gauges, the run would take forty times as long.
TEST(ManySteps, CostNoMoreThanTheRunBetweenThem) {
  study::Scenario s = maxon_scenario(control::Mode::current, 0.0);
  s.load.locked = true;
  s.duration_s = 2.0;
  s.reference.shape = study::Shape::square;
  s.reference.high = 5.0;
  s.reference.low = -5.0;
  s.reference.period_s = 1e-3;
  const double alone = least_cpu_seconds(s);
  study::Measure m = measure(study::MetricKind::reach_time, study::Signal::current);
  m.fraction = 0.3;
  s.require.push_back({m, {}, 1e-3});
  EXPECT_LT(least_cpu_seconds(s), 5 * alone);
}

}  // namespace SIXSTEP_TEST_FILE

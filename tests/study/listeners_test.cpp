// SPDX-License-Identifier: Apache-2.0
// The listeners of a run receive the events in order and do not change the run.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

double asked(const Outcome& out, std::size_t n = 0) { return out.comparisons.at(n).measured; }

TEST(Listeners, KeepGoingDoesNotChangeABit) {
  // If a slice of the run ends between two events, the expansion restarts.
  Scenario s = maxon_scenario(Mode::duty, 0.7);
  s.duration_s = 50e-3;
  ask(s, measure(MetricKind::final_value, Signal::speed));
  ask(s, measure(MetricKind::final_value, Signal::phase_a));
  ask(s, measure(MetricKind::mean, Signal::current));
  const auto alone = run(s), watched = run(s, {.keep_going = [](double) { return true; }});
  ASSERT_TRUE(alone && watched);
  EXPECT_EQ(alone->segments, watched->segments);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(asked(*alone, n), asked(*watched, n));
}

TEST(Listeners, KeepGoingSwallowsNoSample) {
  Scenario s = current_square();
  s.duration_s = 40e-3;
  Measure m = measure(MetricKind::final_value, Signal::current);
  m.sampled = true;
  m.from_s = 30e-3;  // a tick; a slice of the run may end there
  m.to_s = 30.01e-3;
  ask(s, m);
  const auto alone = run(s), watched = run(s, {.keep_going = [](double) { return true; }});
  ASSERT_TRUE(alone && watched);
  EXPECT_FALSE(std::isnan(asked(*alone)));
  EXPECT_EQ(asked(*alone), asked(*watched));
}

/// Checks the rows of every event. It records the largest backward step of time, and the largest jump of u_a
/// between rows of equal time.
struct Rows {
  double last = 0, worst_back = 0, jump = 0, u_before = 0, t_before = -1;
  void operator()(Row row) {
    worst_back = std::max(worst_back, last - row[0]);
    last = row[0];
    if (row[0] == t_before) jump = std::max(jump, std::fabs(row[4] - u_before));
    t_before = row[0];
    u_before = row[4];
  }
};

TEST(Listeners, EventRowsHoldBothSidesOfAJump) {
  Rows rows;
  ASSERT_TRUE(run(maxon_scenario(Mode::duty, 0.5), {.on_event = std::ref(rows)}));
  EXPECT_NEAR(rows.jump, 24.0, 1e-9);
  EXPECT_EQ(rows.last, 20e-3);
  EXPECT_LE(rows.worst_back, 4 * 0x1p-52 * 20e-3);
}

TEST(Listeners, TimeOfEventRowsNeverDecreases) {
  Rows rows;
  ASSERT_TRUE(run(maxon_scenario(Mode::duty, 0.5), {.on_event = std::ref(rows)}));
  EXPECT_EQ(rows.worst_back, 0.0);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The commutation error is compared with its cause, which is the offset of the probes, their delay, or the
// time between an edge and the sample.
#include <gtest/gtest.h>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr double pole_pairs = 8, deg = 180 / base::pi;

/// An external drive turns the motor over five electrical turns.
Scenario turned(double w_rad_s) {
  Scenario s = maxon_scenario(Mode::current, 1.0);
  s.load.dynamometer_times_s = {0.0};
  s.load.dynamometer_rad_s = {w_rad_s};
  s.duration_s = 5 * 2 * base::pi / pole_pairs / std::fabs(w_rad_s);
  ask(s, measure(MetricKind::commutation_error, Signal::current));
  ask(s, measure(MetricKind::commutation_error_rms, Signal::current));
  return s;
}

struct Errors {
  double worst = 0, rms = 0;
};
Errors errors(const Scenario& s) {
  const std::vector<double> found = figures_of(s);
  return {found[0], found[1]};
}

TEST(CommutationError, IsNothingAtTheEdges) {
  for (const double w : {60.0, -60.0}) {
    const Errors e = errors(turned(w));
    EXPECT_LT(e.worst, 1e-6) << w;
    EXPECT_LT(e.rms, 1e-6) << w;
  }
}

TEST(CommutationError, IsTheOffsetOfTheProbes) {
  for (const double w : {60.0, -60.0})
    for (const double offset : {20.0, -7.0}) {
      Scenario s = turned(w);
      s.sensors.hall_offset_deg = offset;
      const Errors e = errors(s);
      EXPECT_NEAR(e.worst, std::fabs(offset), 1e-6) << w << " " << offset;
      EXPECT_NEAR(e.rms, std::fabs(offset), 1e-6) << w << " " << offset;
    }
}

TEST(CommutationError, IsTheAngleOfTheDelay) {
  Scenario s = turned(60);
  s.sensors.hall_delay_s = 200e-6;
  const Errors e = errors(s);
  EXPECT_NEAR(e.worst, 60 * pole_pairs * 200e-6 * deg, 1e-6);
  EXPECT_NEAR(e.rms, e.worst, 1e-6);
}

// With commutation at the samples, the error is between 0 and the angle of one period. The rms of a uniform
// distribution is this angle divided by sqrt(3). From 30 commutations, the rms is accurate to a fifth.
TEST(CommutationError, IsSpreadOverAPeriodAtSamples) {
  Scenario s = turned(61);
  s.pwm.commutation = CommutationAt::sample;
  s.pwm.period_s = 100e-6;
  const double most = 61 * pole_pairs * s.pwm.period_s * deg;
  const Errors e = errors(s);
  EXPECT_LE(e.worst, most * (1 + 1e-9));
  EXPECT_GT(e.worst, 0.8 * most);
  EXPECT_NEAR(e.rms, most / std::sqrt(3.0), 0.2 * most / std::sqrt(3.0));
}

TEST(CommutationError, IsNoNumberWithoutACommutation) {
  Scenario s = turned(60);
  s.duration_s = 1e-3;
  EXPECT_TRUE(std::isnan(errors(s).worst));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// A speed PI controller that sets the duty directly (thesis 6.2.2) neither measures nor limits a current.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/run/run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

Scenario direct(double reference_rad_s, double duration_s) {
  Scenario s = maxon_scenario(Mode::speed, reference_rad_s);
  s.control.speed.output = SpeedOutput::duty;
  s.control.speed.torque_limit_Nm.reset();
  s.pwm.chopping = control::Chopping::complementary;
  s.duration_s = duration_s;
  return s;
}

/// The placed poles belong to the first-order plant J dw/dt = K_t (d U - K_t w)/R - B w.
TEST(SpeedToDuty, PlacesThePolesOfTheWindingsFirstOrder) {
  Scenario s = direct(100.0, 1e-3);
  s.control.speed.settle_s = 50e-3;
  s.control.speed.damping = 0.9;
  const auto out = run(s);
  ASSERT_TRUE(out);
  ASSERT_EQ(out->gains.size(), 1u) << "no current loop";
  const double T = 30e-6, R = 1.03, K_t = 0.0335, J = 1.35e-5, B = 7.3e-6;
  const double a = (B + K_t * K_t / R) / J, b = K_t * 24 / (R * J);
  const double a0 = -std::exp(-a * T), b0 = b / a * (1 - std::exp(-a * T));
  const double w0 = 4.6 / (0.9 * 50e-3);
  const double re = std::exp(-0.9 * w0 * T) * std::cos(w0 * std::sqrt(1 - 0.81) * T);
  const double magnitude_2 = std::exp(-2 * 0.9 * w0 * T);
  EXPECT_NEAR(out->gains[0].d1, (-2 * re - a0 + 1) / b0, 1e-11 / b0);
  EXPECT_NEAR(out->gains[0].d0, (magnitude_2 + a0) / b0, 1e-11 / b0);
}

/// The integral removes the error, with and without a load, forwards and backwards. If the window is not a
/// whole number of sectors, the ripple of commutation changes the mean. K_t i/J over a sector is below 1
/// rad/s, and a window of 40 sectors contains one incomplete sector.
TEST(SpeedToDuty, HoldsTheSpeedUnderLoad) {
  for (const double reference : {200.0, -200.0}) {
    Scenario s = direct(reference, 0.4);
    s.control.speed.settle_s = 50e-3;
    s.control.speed.damping = 0.9;
    s.load.times_s = {0.2};
    s.load.torques_Nm = {reference > 0 ? 0.03 : -0.03};
    Measure before = measure(MetricKind::mean, Signal::speed), after = before;
    before.from_s = 0.15, before.to_s = 0.2;
    after.from_s = 0.35, after.to_s = 0.4;
    ask(s, before);
    ask(s, after);
    const auto out = run(s);
    ASSERT_TRUE(out);
    ASSERT_FALSE(out->fault);
    for (const ComparisonResult& figure : out->comparisons) EXPECT_NEAR(figure.measured, reference, 1.0 / 40);
  }
}

TEST(SpeedToDuty, RefusesWhatOnlyACurrentLoopCouldHold) {
  Scenario s = direct(100.0, 1e-3);
  s.control.current.limit_A = 5.0;
  s.control.speed.torque_limit_Nm = 0.1;
  s.control.limits.current_A = 4.0;
  const auto out = run(s);
  ASSERT_FALSE(out);
  ASSERT_EQ(out.problems().size(), 3u);
  for (const base::Problem& p : out.problems())
    EXPECT_EQ(p.limit, "needs a current loop, which control.speed.output = \"duty\" does not have")
        << p.where;
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// A design warns about speeds far above the speed of its test. Such a speed may be unreachable, or the steps
// of its measured value may reach a limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::analysis;
using design::Concern;

/// The order of a design for the maxon motor with an encoder of 1024 lines. The board's timer captures the
/// encoder's edges with the clock `capture_Hz`.
DesignOrder on_encoder_board(double capture_Hz = 1e6) {
  DesignOrder order{.subject = {"maxon-251601", sixstep::testing::maxon_sheet(), {}},
                    .spec = design::on_a_board(),
                    .advises = false};
  order.spec.mode = control::Mode::speed;
  order.spec.rotor = {.hall = false,
                      .shaft = {.kind = design::ShaftSensorKind::encoder,
                                .period_s = order.spec.period_s,
                                .lines = 1024,
                                .capture_Hz = capture_Hz,
                                .timeout_s = 0.05}};
  return order;
}

const design::Warning* warning_of(const DesignStudy& s, Concern of) {
  const auto found = std::find_if(s.warnings.begin(), s.warnings.end(),
                                  [of](const design::Warning& w) { return w.of == of; });
  return found == s.warnings.end() ? nullptr : &*found;
}

/// The mean speed at the end of the design's test run, with a step to `rad_s`.
double held(const design::DriveDesign& d, DesignSubject subject, double rad_s) {
  const study::Scenario small = design_scenario(d, subject);
  subject.step = rad_s - small.reference.values.front();
  const auto outcome = study::run(design_scenario(d, subject));
  return outcome ? outcome->verdicts.front().measured : 0.0;
}

/// The measured speed w has steps of w/(f T): one tick of the timer's clock f in the period T. The speed loop
/// multiplies a step by its gain d1. The torque limit clips the result if it exceeds the torque that the load
/// leaves. The speed stops where both are equal: d1 w/(f T) = 1 - load/limit.
TEST(HighSpeed, StandsWhereATickIsWhatTheLoadLeavesOfTheLimit) {
  const DesignOrder order = on_encoder_board();
  const auto s = study_design(order);
  ASSERT_TRUE(s);
  const design::DriveDesign& d = s->design;
  const double left = 1.0 - s->scenario.load.torque_Nm / d.torque_limit_Nm, f = 1e6;
  const double stands = left * f * order.spec.period_s / d.loop("speed").gains.d1;
  EXPECT_NEAR(held(d, order.subject, 500), stands, 0.1 * stands);
  const design::Warning* w = warning_of(*s, Concern::grain);
  ASSERT_NE(w, nullptr);
  EXPECT_TRUE(w->grave);
  EXPECT_FALSE(s->usable());
}

TEST(HighSpeed, OfAFasterClockIsHeld) {
  const DesignOrder order = on_encoder_board(16e6);
  const auto s = study_design(order);
  ASSERT_TRUE(s);
  EXPECT_EQ(warning_of(*s, Concern::grain), nullptr);
  EXPECT_TRUE(s->usable());
  EXPECT_EQ(s->scenario.sensors.capture_Hz, 16e6);
  EXPECT_NEAR(held(s->design, order.subject, s->design.high_speed_rad_s), s->design.high_speed_rad_s, 1.0);
}

/// With the timer clock that the advice names, the design is usable.
TEST(HighSpeed, IsAdvisedAClockThatHolds) {
  DesignOrder order = on_encoder_board();
  order.advises = true;
  const auto s = study_design(order);
  ASSERT_TRUE(s);
  ASSERT_FALSE(s->usable());
  EXPECT_NE(s->warnings.front().cure.find("capture_Hz = 1.6e+07"), std::string::npos)
      << s->warnings.front().cure;
}

/// The largest error of a speed that is computed from edges counted in whole timer ticks. The edges are
/// `edge_s` apart, or up to 2 % closer or farther. The simulation of the counter gives the error.
double counted_step(double edge_s, int edges, double f_Hz, double speed) {
  double most = 0.0;
  for (int near = -20; near <= 20; ++near) {
    const double true_ticks = edge_s * f_Hz * (1 + near * 1e-3);
    for (int n = 0; n < 5000; ++n) {
      const double ticks = std::floor((n + edges) * true_ticks) - std::floor(n * true_ticks);
      most = std::max(most, std::fabs(speed * edges * true_ticks / ticks - speed));
    }
  }
  return most;
}

TEST(HighSpeed, StepsOfTheMeasuredSpeedAreThoseThatATimerMakes) {
  const double f = 1e6, p = 8, speed = 431.7;
  design::RotorSensing hall{.hall = true, .edges = 1, .capture_Hz = f};
  const double sector = base::pi / 3 / (p * speed);
  for (const int edges : {1, 2, 6}) {
    hall.edges = edges;
    const double step = design::speed_step_rad_s(hall, p, speed, 500.0);
    EXPECT_NEAR(step, counted_step(sector, edges, f, speed), 0.03 * step) << edges;
  }
  const design::RotorSensing encoder = on_encoder_board().spec.rotor;
  const double count = 2 * base::pi / 4096 / speed, period = encoder.shaft.period_s;
  const double step = design::speed_step_rad_s(encoder, p, speed, 500.0);
  const int counts = static_cast<int>(period / count);
  EXPECT_NEAR(step, counted_step(count, counts, f, speed), 0.15 * step);
}

/// If misplaced probes make a sector longer by the angle s, its measured speed is wrong by the part s/(60
/// degrees). Over a whole turn the errors cancel.
TEST(HighSpeed, StepsOfProbesBesideTheirPlacesAreTheirs) {
  const double p = 4, speed = 300, stray = 5 * base::pi / 180;
  design::RotorSensing hall{.hall = true, .edges = 1, .stray_rad = stray};
  const double sector = base::pi / 3, longer = speed * sector / (sector - stray) - speed;
  EXPECT_NEAR(design::speed_step_rad_s(hall, p, speed, 500.0), longer, 0.1 * longer);
  hall.edges = 0;
  EXPECT_EQ(design::speed_step_rad_s(hall, p, speed, 1.0), 0.0);  // a slow loop uses six edges
}

DesignOrder on_hall(double step, double settle_s, control::Chopping chopping) {
  DesignOrder order{.subject = {"maxon-251601", sixstep::testing::maxon_sheet(), {}},
                    .spec = design::on_a_board(),
                    .advises = false};
  order.spec.mode = control::Mode::speed;
  order.spec.chopping = chopping;
  if (settle_s > 0) order.spec.settle_s = settle_s;
  order.subject.step = step;
  return order;
}

/// The speed at full duty with the same load: the highest speed that the drive reaches.
double full_on_speed(const study::Scenario& of) {
  study::Scenario s = of;
  s.control = {};
  s.control.mode = control::Mode::duty;
  s.reference = {};
  s.reference.value = 1.0;
  s.compare.clear();
  s.require.resize(1);
  const auto outcome = study::run(s);
  return outcome ? outcome->verdicts.front().measured : 0.0;
}

TEST(AskedStep, BeyondWhatBusAndLoadAllowIsGraveHoweverSlowTheLoop) {
  for (const DesignOrder& order :
       {on_hall(550, 0, control::Chopping::soft), on_hall(560, 0.3, control::Chopping::complementary)}) {
    const auto s = study_design(order);
    ASSERT_TRUE(s);
    const double stands = s->outcome.verdicts.front().measured;
    EXPECT_NEAR(stands, full_on_speed(s->scenario), 0.01 * stands);
    const design::Warning* w = warning_of(*s, Concern::reach);
    ASSERT_NE(w, nullptr);
    EXPECT_TRUE(w->grave);
    EXPECT_EQ(warning_of(*s, Concern::settling), nullptr);
    EXPECT_NE(w->what.find(*order.subject.step == 550 ? "656.5" : "666.5"), std::string::npos) << w->what;
  }
}

TEST(AskedStep, OutOfReachIsAdvisedASmallerOneThatHolds) {
  DesignOrder order = on_hall(550, 0, control::Chopping::soft);
  order.advises = true;
  const auto s = study_design(order);
  ASSERT_TRUE(s);
  const std::string& cure = s->warnings.front().cure;
  const std::size_t at = cure.find("step = ");
  ASSERT_NE(at, std::string::npos) << cure;
  order.subject.step = std::stod(cure.substr(at + 7));
  EXPECT_LT(*order.subject.step, 550);
  const auto next = study_design(order);
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->usable());
}

/// If the acceleration at the torque limit takes long, the run's final window begins after the acceleration.
TEST(AskedStep, IsRunUntilItHasArrived) {
  DesignOrder order = on_encoder_board(16e6);
  order.spec.voltage_V = 48;
  order.spec.chopping = control::Chopping::complementary;
  order.subject.step = 700;
  const auto s = study_design(order);
  ASSERT_TRUE(s);
  const std::vector<double>& levels = s->scenario.reference.values;
  EXPECT_NEAR(s->outcome.verdicts.front().measured, levels[1], 0.02 * 700);
  EXPECT_LT(*s->ideal_swing_rad_s, 0.02 * 700);
  EXPECT_TRUE(s->usable()) << s->warnings.front().what;
}

}  // namespace SIXSTEP_TEST_FILE

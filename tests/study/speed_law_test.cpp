// SPDX-License-Identifier: Apache-2.0
// Tests the speed controllers other than the PI controller in the full switching simulation. Each controller
// settles as its design rule states, and controls the speed against a load. Keys that a law does not have are
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/design/loops/speed_laws.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using study::SpeedLaw;
using ::testing::HasSubstr;

constexpr double T = 30e-6, J = 1.35e-5, B = 7.3e-6, T_max = 0.1, settle = 20e-3;
constexpr SpeedLaw laws[] = {SpeedLaw::state_feedback, SpeedLaw::disturbance_rejection,
                             SpeedLaw::sliding_mode};

/// The reference is 100 rad/s, and from 0.05 s on 108 rad/s. From 0.1 s on, a load of 30 mN m acts. The
/// torque limit is 100 mN m.
Scenario loaded(SpeedLaw law) {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.16;
  s.initial.speed_rad_s = 100;
  s.pwm.chopping = control::Chopping::complementary;
  s.pwm.alignment = study::Alignment::centre;  // sampled in the middle: the reading is the mean current, at
                                               // any ripple
  s.pwm.sample = study::SampleAt::middle;
  s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.05}, .values = {100.0, 108.0}};
  s.control.current.settle_s = 1e-3;
  s.control.speed.law = law;
  s.control.speed.settle_s = settle;
  s.control.speed.torque_limit_Nm = T_max;
  study::At load;
  load.time_s = 0.1;
  load.load.torque_Nm = 0.03;
  s.at.push_back(load);
  s.record.columns = {"speed_rad_s"};
  return s;
}

struct Course {
  std::vector<double> t, w;
};
Course course(const Scenario& s) {
  Course all;
  const auto out = study::run(s, {.on_record = [&](study::Row row) {
                                all.t.push_back(row[0]);
                                all.w.push_back(row[1]);
                              }});
  EXPECT_TRUE(out && !out->fault) << (out ? "" : to_string(out.problems()[0]));
  return all;
}

double largest_step(const Course& c, double from_s, double to_s, double level) {
  double apart = 0;
  for (std::size_t n = 0; n < c.t.size(); ++n)
    if (c.t[n] >= from_s && c.t[n] < to_s) apart = std::fmax(apart, std::fabs(c.w[n] - level));
  return apart;
}

/// The last instant at which the speed deviates from 108 rad/s by more than a hundredth of the step.
double settled_after(const Course& c) {
  double last = 0;
  for (std::size_t n = 0; n < c.t.size(); ++n)
    if (c.t[n] > 0.05 && c.t[n] < 0.1 && std::fabs(c.w[n] - 108) > 0.08) last = c.t[n] - 0.05;
  return last;
}

/// The error of a step of 8 rad/s is 8 exp(-4.6 t/settle). At the design's settling time, it is below 0.08
/// rad/s plus a ripple. The deviation before the step is a bound of this ripple. The lag of the torque is
/// added to the time.
void expect_settled_as_designed(const Course& c, double lag_s) {
  const double ripple = largest_step(c, 0.045, 0.05, 100), per_s = 4.6 / settle;
  EXPECT_LT(ripple, 0.03);
  EXPECT_GT(settled_after(c), std::log(8 / (0.08 + ripple)) / per_s);
  EXPECT_LT(settled_after(c), std::log(8 / (0.08 - ripple)) / per_s + lag_s + T);
}

/// The mean is over eight whole sectors. The ripple of commutation changes it by at most the effect of one
/// missing sector. In single precision, a number near 108 changes by (1 - p) of the error per sample (pole
/// p). It stops changing when this change is below its last digit.
void expect_no_error_left(const Course& c, double digit_rad_s = 0.0) {
  const double sectors_s = 8 * (3.14159265358979 / 3 / 8 / 108);
  double sum = 0, ripple = 0;
  int count = 0;
  for (std::size_t n = 0; n < c.t.size(); ++n)
    if (c.t[n] >= 0.16 - sectors_s) {
      sum += c.w[n] - 108;
      ripple = std::fmax(ripple, std::fabs(c.w[n] - 108));
      ++count;
    }
  EXPECT_LT(ripple, 0.15);
  EXPECT_NEAR(sum / count, 0.0, ripple / 8 + digit_rad_s / (1 - std::exp(-4.6 * T / settle)));
}

/// The deepest dip of the speed of a linear drive with the same law. The torque lags by `lag_periods`
/// samples, and the torque of the shaft is constant between samples.
double deepest_in_theory(const Scenario& s, double lag_periods) {
  const auto compiled = study::compile(s);
  const control::DriveConfig<double>& d = compiled->drive;
  control::DriveExtrasState<double> state;
  control::PiState<double> pi;
  const double a = std::exp(-B * T / J), b = T_max / B * (1 - a), c = lag_periods / (1 + lag_periods);
  double w = 100, t = 0, deepest = 0;
  for (int n = 0; n < 6000; ++n) {
    const double u =
        control::detail::speed_with_extras<double>(d.extras, state, d.speed, pi, 100 - w, w, nullptr);
    t = c * t + (1 - c) * u;
    w = a * w + b * (t - (n < 3000 ? 0.0 : 0.3));
    if (n > 3000) deepest = std::fmax(deepest, 100 - w);
  }
  return deepest;
}

TEST(SpeedLaw, EachSettlesAsItsRuleSaysAndBearsALoad) {
  for (const SpeedLaw law : laws) {
    const Scenario s = loaded(law);
    const Course c = course(s);
    ASSERT_GT(c.w.size(), 5000u);
    const double dip = largest_step(c, 0.1, 0.13, 108);
    const auto compiled = study::compile(s);
    const control::PiConfig<double>& current = compiled->drive.current;
    const double lag = design::current_lag_periods(1.03, current.d1 + current.d0);
    const double theory = deepest_in_theory(s, lag);
    std::printf("law %d: settled after %.5g ms, a load takes %.4g rad/s of it (linear %.4g)\n",
                static_cast<int>(law), 1e3 * settled_after(c), dip, theory);
    expect_settled_as_designed(c, lag * T);
    EXPECT_NEAR(dip, theory, 0.1) << "the ripple under load";
    expect_no_error_left(c);
  }
}

/// Runs every law in single precision, both in the six-step drive and in the field-oriented drive.
TEST(SpeedLaw, EachRunsInEveryDriveThatHasASpeedLoop) {
  for (const SpeedLaw law : laws)
    for (const bool field : {false, true}) {
      Scenario s = loaded(law);
      s.control.arithmetic = study::Arithmetic::float32;
      if (field) {
        s.control.drive = study::FirmwareKind::field;
        s.control.current.settle_s = std::nullopt;
        s.pwm.chopping = control::Chopping::soft;
        s.pwm.sample = study::SampleAt::start;
        s.sheet.back_emf = design::BackEmfShape::sine;
      }
      const Course c = course(s);
      SCOPED_TRACE(std::to_string(static_cast<int>(law)) + (field ? " in the field" : " in six steps"));
      // The current lags by a twentieth of the control frequency, or by 1 ms. This is at most six periods.
      expect_settled_as_designed(c, 6 * T);
      expect_no_error_left(c, 0x1p-17);
    }
}

/// The drive accelerates at full torque towards a speed that it cannot reach. When the reference falls, the
/// output must leave its limit at once.
TEST(SpeedLaw, NoneWindsUpAgainstItsLimit) {
  for (const SpeedLaw law : laws) {
    Scenario s = loaded(law);
    s.at.clear();
    s.initial.speed_rad_s = 0;
    s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.05}, .values = {600.0, 300.0}};
    s.duration_s = 0.2;
    const Course c = course(s);
    double least = 1e9;
    for (std::size_t n = 0; n < c.t.size(); ++n)
      if (c.t[n] > 0.06) least = std::fmin(least, c.w[n]);
    // In 50 ms, 0.1 N m accelerates the rotor to 369 rad/s. Then the speed may fall below 300 rad/s by at
    // most a hundredth of the 69 rad/s.
    EXPECT_GT(least, 300 - 0.7) << static_cast<int>(law);
    EXPECT_LT(largest_step(c, 0.19, 0.2, 300), 0.1) << static_cast<int>(law);
  }
}

TEST(SpeedLaw, AnIPControllerComesToItsSetpointWithoutPassingIt) {
  Scenario s = loaded(SpeedLaw::pi);
  s.control.speed.form = study::SpeedForm::positional;
  s.control.speed.damping = 1.0;
  s.control.speed.setpoint_weight = 0.0;
  s.at.clear();
  const auto over = [](const Scenario& x) {
    const Course c = course(x);
    double most = 0;
    for (std::size_t n = 0; n < c.t.size(); ++n)
      if (c.t[n] > 0.05) most = std::fmax(most, c.w[n]);
    return most - 108;
  };
  EXPECT_LT(over(s), 0.05);
  s.control.speed.setpoint_weight = 1.0;
  EXPECT_GT(over(s), 0.8) << "the PI's zero makes a tenth of the step";
}

TEST(SpeedLaw, SaysWhatALawDoesNotHave) {
  Scenario s = loaded(SpeedLaw::state_feedback);
  ASSERT_TRUE(study::check(s).empty());
  s.control.speed.kp = 0.1;
  s.control.speed.ki = 0.001;
  s.control.speed.damping = 0.9;
  s.control.speed.settle_s = std::nullopt;
  const base::Problems gains = study::check(s);
  std::string all;
  for (const base::Problem& p : gains) all += to_string(p) + "\n";
  EXPECT_THAT(
      all,
      HasSubstr(
          "control.speed.kp = 0.1 applies only to a PI, which control.speed.law = \"state-feedback\" does not have"));
  EXPECT_THAT(all, HasSubstr("control.speed.damping"));
  s = loaded(SpeedLaw::sliding_mode);
  s.control.arithmetic = study::Arithmetic::q31;
  s.control.speed.form = study::SpeedForm::positional;
  ASSERT_EQ(study::check(s).size(), 2u);
  for (const base::Problem& p : study::check(s)) EXPECT_FALSE(p.cure.empty());
  s = loaded(SpeedLaw::pi);
  s.control.speed.setpoint_weight = 0.5;
  s.control.speed.observer_ratio = 4;
  ASSERT_EQ(study::check(s).size(), 2u);
  EXPECT_THAT(to_string(study::check(s)[0]),
              HasSubstr("applies only to control.speed.form = \"positional\""));
  EXPECT_THAT(to_string(study::check(s)[1]),
              HasSubstr("applies only to an observer, which law = \"pi\" does not have"));
  s = loaded(SpeedLaw::state_feedback);
  s.load.viscous_Nm_s = 0.01;  // J/B = 1.35 ms
  const auto refused = study::compile(s);
  ASSERT_FALSE(refused);
  EXPECT_THAT(
      to_string(refused.problems()[0]),
      HasSubstr(
          "control.speed.settle_s = 0.02 is longer than the settling time that friction causes without a controller"));
}

}  // namespace SIXSTEP_TEST_FILE

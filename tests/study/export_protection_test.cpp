// SPDX-License-Identifier: Apache-2.0
// Thresholds that never act, act too late, or stop a sound run: the run does not reach them, so that only the
// gate reports them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> unmeasured(const Scenario& s) {
  EXPECT_TRUE(study::check(s).empty()) << to_string(study::check(s)[0]);
  std::vector<std::string> out;
  for (const base::Problem& p : study::never_measured(s)) out.push_back(p.where);
  return out;
}

/// The torque limit is 0.195 N m, which is 5.82 A.
Scenario limited_by_torque() {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 15.0});
  s.control.current.limit_A.reset();
  s.control.speed.torque_limit_Nm = 0.195;
  return s;
}

/// A held rotor takes the speed loop's limit, 0.195 N m / 33.5 mNm/A, and no more.
TEST(ExportProtection, AStallThatTheLimitHidesStandsAgainstIt) {
  Scenario s = limited_by_torque();
  s.protection.stall_s = 0.1;
  for (const double amps : {5.6, 5.75, 5.82, 12.0}) {
    s.protection.stall_current_A = amps;
    const base::Problems told = study::never_measured(s);
    EXPECT_EQ(told.empty(), amps < 0.98 * 0.195 / 33.5e-3 - 0.02) << amps;
    for (const base::Problem& p : told)
      EXPECT_THAT(to_string(p), ::testing::HasSubstr("5.82 A, control.speed.torque_limit_Nm over K_t"));
  }
  s.control.current.limit_A = 10.0;  // the torque limit is the lower one
  s.protection.stall_current_A = 8.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_current_A"));
  s.control.mode = Mode::current;  // the reference is the largest command
  s.reference.value = -7.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_current_A"));
  s.reference.value = -9.0;
  EXPECT_THAT(unmeasured(s), IsEmpty());
}

/// The drive's largest command is the smallest of its limits; a threshold below it stops a sound run.
TEST(ExportProtection, AnOverCurrentBelowTheLimitThatBindsStandsAgainstIt) {
  Scenario s = limited_by_torque();
  s.protection.stall_current_A.reset();
  s.protection.stall_s.reset();
  const auto told = [&s](double threshold_A) {
    s.protection.over_current_A = threshold_A;
    std::string text;
    for (const base::Problem& p : study::never_measured(s)) text += to_string(p);
    return text;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(told(5.8), HasSubstr("its own limits allow: 5.82 A, control.speed.torque_limit_Nm over K_t"));
  EXPECT_EQ(told(5.9), "");
  s.control.limits.current_A = 5.0;
  EXPECT_THAT(told(4.9), HasSubstr("5 A, control.limits.current_A"));
  EXPECT_EQ(told(5.1), "");
  s.control.limits.torque_Nm = 0.1;  // 2.99 A
  EXPECT_THAT(told(2.9), HasSubstr("2.99 A, control.limits.torque_Nm over K_t"));
  EXPECT_EQ(told(3.1), "");
}

/// The longest stall that the winding stands follows from the thermal model: I^2 R heats the winding from
/// cold to its limit in the closed form's time. This time is finite, and longer than without any cooling.
TEST(ExportProtection, AStallThatTheWindingDoesNotStandStandsAgainstIt) {
  Scenario s = product_scenario(Mode::current, 15.0);
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 25.0});
  s.protection.over_current_A = 18.0;
  s.protection.stall_current_A = 10.0;
  s.sheet = curve_sheet();
  s.sheet.nominal_current_A->frame = "terminal";
  const auto thermal = design::thermal_model(s.sheet);
  ASSERT_TRUE(thermal);
  const double capacity = thermal->winding_s / thermal->winding_housing_K_W;
  const double watts = 15.0 * 15.0 * 1.03;
  const double uncooled_s = capacity * (thermal->max_winding_degC - 25) / watts;
  // Warm copper has more loss: up to 1.4 times at 125 degC.
  for (const double stall_s : {uncooled_s / 1.5, uncooled_s * 1.5}) {
    s.protection.stall_s = stall_s;
    if (stall_s < uncooled_s)
      EXPECT_THAT(unmeasured(s), IsEmpty()) << stall_s;
    else
      EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_s")) << stall_s;
  }
}

TEST(ExportProtection, AnOverSpeedThatNothingReachesStandsAgainstIt) {
  Scenario s = product_scenario(Mode::current, 3.0);
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 15.0});
  const double no_load = 24.0 / 33.5e-3;
  s.protection.over_speed_rad_s = 1.9 * no_load;
  EXPECT_THAT(unmeasured(s), IsEmpty());
  s.protection.over_speed_rad_s = 1e5;
  EXPECT_THAT(unmeasured(s), ElementsAre("protection.over_speed_rad_s"));
}

}  // namespace SIXSTEP_TEST_FILE

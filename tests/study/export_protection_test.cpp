// SPDX-License-Identifier: Apache-2.0
// Thresholds of the protection may never act, act too late, or stop a sound run. The runs do not reach these
// thresholds, so only the export gate can report them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/run/export_gate.hpp"
#include "sixstep/study/run/export_notes.hpp"
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

/// The torque limit is 0.195 N m. It corresponds to 5.82 A.
Scenario limited_by_torque() {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.pwm.delay_periods = 1;
  s.bridge.dead_time_s = 500e-9;
  s.require.push_back({measure(study::MetricKind::maximum, study::Signal::current), {}, 15.0});
  s.control.current.limit_A.reset();
  s.control.speed.torque_limit_Nm = 0.195;
  return s;
}

/// With a locked rotor, the current is at most the limit of the speed loop, 0.195 N m/(33.5 mNm/A).
TEST(ExportProtection, AStallThatTheLimitHidesStandsAgainstIt) {
  Scenario s = limited_by_torque();
  s.protection.stall_s = 0.1;
  for (const double amps : {5.6, 5.75, 5.82, 12.0}) {
    s.protection.stall_current_A = amps;
    const base::Problems told = study::never_measured(s);
    EXPECT_EQ(told.empty(), amps < 0.98 * 0.195 / 33.5e-3 - 0.02) << amps;
    for (const base::Problem& p : told)
      EXPECT_THAT(to_string(p), ::testing::HasSubstr("5.82 A, control.speed.torque_limit_Nm divided by K_t"));
  }
  s.control.current.limit_A = 10.0;  // the torque limit is the lower limit
  s.protection.stall_current_A = 8.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_current_A"));
  s.control.mode = Mode::current;  // the reference is the largest command
  s.reference.value = -7.0;
  EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_current_A"));
  s.reference.value = -9.0;
  EXPECT_THAT(unmeasured(s), IsEmpty());
}

/// The drive has several limits, and the smallest limit is its largest command. An over-current threshold
/// below this current stops a sound run.
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
  EXPECT_THAT(told(5.8),
              HasSubstr("the drive's limits allow: 5.82 A, control.speed.torque_limit_Nm divided by K_t"));
  EXPECT_EQ(told(5.9), "");
  s.control.limits.current_A = 5.0;
  EXPECT_THAT(told(4.9), HasSubstr("5 A, control.limits.current_A"));
  EXPECT_EQ(told(5.1), "");
  s.control.limits.torque_Nm = 0.1;  // 2.99 A
  EXPECT_THAT(told(2.9), HasSubstr("2.99 A, control.limits.torque_Nm divided by K_t"));
  EXPECT_EQ(told(3.1), "");
}

/// The thermal model gives the longest stall that the winding withstands. In this time, I^2 R heats the cold
/// winding to its limit. The closed form is finite and longer than the time without any cooling.
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
  // Warm copper has a higher loss, up to 1.4 times at 125 degC.
  for (const double stall_s : {uncooled_s / 1.5, uncooled_s * 1.5}) {
    s.protection.stall_s = stall_s;
    if (stall_s < uncooled_s)
      EXPECT_THAT(unmeasured(s), IsEmpty()) << stall_s;
    else
      EXPECT_THAT(unmeasured(s), ElementsAre("protection.stall_s")) << stall_s;
  }
}

/// At the other end of the thermal ranges, the heat capacity of the winding is lower, so the permissible time
/// is shorter. The limit is the shorter time. It is longer than the time of heating without any cooling at
/// this end.
TEST(ExportProtection, AStallTimeIsJudgedByTheWorseEndsOfTheThermalRanges) {
  Scenario s = limited_by_torque();
  s.protection.stall_current_A = 4.0;
  s.sheet = curve_sheet();
  s.sheet.nominal_current_A->frame = "terminal";
  const double amps = 0.195 / 33.5e-3, watts = amps * amps * 1.03;
  const auto first_refused = [&s] {
    double low = 1e-3, high = 1e3;
    while (high > low * (1 + 1e-6)) {
      s.protection.stall_s = std::sqrt(low * high);
      (study::never_measured(s).empty() ? low : high) = *s.protection.stall_s;
    }
    return low;
  };
  const double by_values_s = first_refused();
  s.sheet.thermal_time_constant_winding_s->range = base::Interval{11.7, 17.7};
  s.sheet.thermal_resistance_winding_housing_K_W->range = base::Interval{4.0, 5.3};
  const double by_ends_s = first_refused();
  // The shortest possible time is the time of heating without cooling, with the copper loss at the final
  // temperature.
  EXPECT_LT(by_ends_s, 0.6 * by_values_s);
  EXPECT_GT(by_ends_s, 11.7 / 5.3 * 100 / (1.393 * watts));
  s.sheet.thermal_time_constant_winding_s = base::Quantity{11.7, "", ""};
  s.sheet.thermal_resistance_winding_housing_K_W = base::Quantity{5.3, "", ""};
  EXPECT_NEAR(first_refused() / by_ends_s, 1, 1e-5) << "a motor file with these values says the same";
}

/// An accepted offset reduces the range of the converter in one direction. The remaining range must contain
/// the over-current threshold.
TEST(ExportProtection, AnAcceptedOffsetLeavesTheRangeThatTheOverCurrentNeeds) {
  Scenario s = limited_by_torque();
  const double range_A = *s.sensors.current_range_A;
  for (const double over_A : {7.0, 15.0, 20.0})
    for (const double part : {0.02, 0.2, 0.3, 0.45, 0.55, 0.9}) {
      s.protection.over_current_A = over_A;
      s.protection.offset_tolerance_A = part * range_A;
      const double left_A = range_A - part * range_A;
      const bool shows = left_A >= over_A && left_A >= range_A / 2;
      EXPECT_EQ(unmeasured(s).empty(), shows) << over_A << " A, " << part;
    }
}

/// The time until a switch is off is the gate charge divided by the driver's current.
TEST(ExportProtection, ADeadTimeShorterThanTheGateNeedsStandsAgainstIt) {
  Scenario s = limited_by_torque();
  s.bridge.gate_current_A = 0.1;
  s.bridge.gate_source_charge_C = 5e-9;
  s.bridge.gate_drain_charge_C = 10e-9;  // 150 ns
  for (const double dead_s : {50e-9, 140e-9, 160e-9, 500e-9}) {
    s.bridge.dead_time_s = dead_s;
    EXPECT_EQ(unmeasured(s).empty(), dead_s > 150e-9) << dead_s;
    EXPECT_EQ(study::short_dead_time(s), "") << "the charges decide";
  }
  s.bridge.gate_drain_charge_C = 50e-9;  // 550 ns: the cure must be a longer dead time
  s.bridge.dead_time_s = 500e-9;
  const base::Problems refused = study::never_measured(s);
  ASSERT_EQ(refused.size(), 1u);
  s.bridge.dead_time_s = std::stod(refused[0].cure.substr(refused[0].cure.rfind(' ')));
  EXPECT_GT(s.bridge.dead_time_s, 550e-9);
  EXPECT_TRUE(unmeasured(s).empty());
  s.bridge.gate_current_A = s.bridge.gate_source_charge_C = s.bridge.gate_drain_charge_C = 0;
  for (const double dead_s : {25e-9, 50e-9, 99e-9, 101e-9, 500e-9}) {
    s.bridge.dead_time_s = dead_s;
    EXPECT_EQ(study::short_dead_time(s).empty(), dead_s > 100e-9) << dead_s;
  }
  s.bridge.device = study::Device::igbt;
  s.bridge.dead_time_s = 400e-9;
  EXPECT_NE(study::short_dead_time(s), "");
}

/// If the sheet lacks a line that a check needs, the gate names the check. If the sheet has the line, the
/// gate does not name the check.
TEST(ExportProtection, AChecksMissingLineIsNamed) {
  using ::testing::HasSubstr;
  Scenario s = limited_by_torque();
  s.protection.stall_current_A = 4.0;
  s.protection.stall_s = 60.0;
  s.sheet = curve_sheet();
  s.sheet.nominal_current_A.reset();
  s.sheet.max_speed_rpm = base::Quantity{8000, "", ""};
  const auto told = [&s] {
    std::string text;
    for (const std::string& one : study::unchecked(s, *design::motor_model(s.sheet))) text += one + '\n';
    return text;
  };
  EXPECT_EQ(told(), "");
  EXPECT_THAT(study::limit_above_nominal(s, *design::motor_model(s.sheet)),
              HasSubstr("lets 5.82 A flow: by the"))
      << "the thermal values bound the current without a nominal one";
  s.sheet.max_speed_rpm.reset();
  EXPECT_THAT(told(),
              HasSubstr("protection.over_speed_rad_s = 500 rad/s: the motor file has no max_speed_rpm"));
  s.sheet.thermal_time_constant_winding_s.reset();
  EXPECT_THAT(
      told(),
      HasSubstr("for protection.stall_s = 60 s: the motor file has no thermal_time_constant_winding_s"));
  EXPECT_THAT(told(),
              HasSubstr("withstands 5.82 A, control.speed.torque_limit_Nm divided by K_t, continuously"));
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

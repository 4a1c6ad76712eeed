// SPDX-License-Identifier: Apache-2.0
// A remark names each limit of the model that the run exceeds, with its numbers. It names no other limit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The number that follows the text `word` in the first remark with this text.
double number_behind(const std::vector<std::string>& remarks, const std::string& word) {
  for (const std::string& text : remarks)
    if (const std::size_t at = text.find(word); at != std::string::npos)
      return std::stod(text.substr(at + word.size()));
  ADD_FAILURE() << "no remark has: " << word;
  return NAN;
}

/// A drive that controls 20 A with a locked rotor, supplied by a battery of `Ah` ampere hours.
Scenario on_battery(double Ah, double charge) {
  Scenario s = maxon_scenario(Mode::current, 20.0);
  s.load.locked = true;
  s.duration_s = 0.5;
  s.supply.source = study::SourceKind::battery;
  s.supply.battery_charges = {0, 1};
  s.supply.battery_voltages_V = {22, 25};
  s.supply.battery_capacity_Ah = Ah;
  s.supply.battery_charge = charge;
  s.supply.resistance_ohm = 0.02;
  s.supply.capacitance_F = 1e-3;
  return s;
}

/// At the instant in the remark, the integral of the source's current must be equal to the charge of the
/// battery.
TEST(LimitRemarks, ABatteryIsEmptyWhenWhatItHadHasFlowed) {
  Scenario s = on_battery(1e-3, 0.5);
  const auto remarks = outcome_of(s).remarks;
  const double empty_s = number_behind(remarks, "empty at t = ");
  s.duration_s = empty_s;
  s.compare = {{measure(study::MetricKind::mean, study::Signal::source_current), 0.0, ""}};
  const double flowed_As = outcome_of(s).comparisons.at(0).measured * empty_s;
  EXPECT_NEAR(flowed_As, 0.5 * 1e-3 * 3600, 0.01 * flowed_As);
  EXPECT_THAT(outcome_of(on_battery(1.0, 0.5)).remarks, Not(Contains(HasSubstr("battery was"))));
}

/// The remark proposes a band and states its frequency. The band must give this frequency. A run with a
/// slightly larger band has no remark.
TEST(LimitRemarks, AHysteresisThatNoBridgeSwitchesIsTold) {
  Scenario s = maxon_scenario(Mode::current, 5.0);
  s.load.locked = true;
  s.duration_s = 20e-3;
  s.control.current = {.type = study::CurrentLoopType::hysteresis, .band_A = 0.01};
  const auto fast = outcome_of(s);
  // The current rises and falls by two bands, at the rates (U - R I)/L and R I/L. The duty is R I/U.
  const double d = 5.0 * 1.03 / 24, foretold_Hz = 24 / (0.572e-3 * 2 * 0.01) * d * (1 - d);
  const double told_Hz = 1e3 * number_behind(fast.remarks, "chop at ");
  EXPECT_NEAR(told_Hz / foretold_Hz, 1, 0.1);
  s.pwm.period_s = 60e-6;
  EXPECT_NEAR(1e3 * number_behind(outcome_of(s).remarks, "chop at ") / told_Hz, 1, 0.02)
      << "whatever the period";
  s.control.current.band_A = number_behind(fast.remarks, "band_A = ");
  const auto slow = outcome_of(s);
  EXPECT_NEAR(static_cast<double>(slow.turn_ons) / slow.simulated_s / 200e3, 1, 0.1);
  s.control.current.band_A *= 1.1;
  EXPECT_THAT(outcome_of(s).remarks, Not(Contains(HasSubstr("comparators chop"))));
}

/// The run starts with a cold winding. By the plain values of the sheet, the winding withstands its mean
/// loss. At the worse ends of the ranges, it does not.
TEST(LimitRemarks, AColdWindingIsJudgedByTheWorseEnds) {
  Scenario s = maxon_scenario(Mode::current, 10.0);
  s.load.locked = true;
  s.duration_s = 2.0;
  s.pwm.period_s = 100e-6;
  s.sheet.thermal_resistance_winding_housing_K_W = base::Quantity{4.0, "", ""};
  s.sheet.thermal_resistance_housing_ambient_K_W = base::Quantity{4.0, "", ""};
  s.sheet.thermal_time_constant_winding_s = base::Quantity{10.0, "", ""};
  s.sheet.thermal_time_constant_motor_s = base::Quantity{200.0, "", ""};
  s.sheet.max_winding_temperature_degC = base::Quantity{125.0, "", ""};
  // 206 J heat 2.5 J/K by less than 100 K, and 1 J/K by more than 100 K.
  const auto told = [&s] {
    const auto remarks = outcome_of(s).remarks;
    return std::any_of(remarks.begin(), remarks.end(), [](const auto& text) {
      return text.find("the copper loss of the run heats the winding") != text.npos;
    });
  };
  EXPECT_FALSE(told());
  s.sheet.thermal_time_constant_winding_s->range = base::Interval{4.0, 10.0};
  EXPECT_TRUE(told());
  s.sheet.thermal_time_constant_winding_s->range = base::Interval{9.9, 10.0};
  EXPECT_FALSE(told());
}

/// A spinning rotor brakes and charges a small battery.
TEST(LimitRemarks, ABatteryIsFullWhereItIsGivenMore) {
  Scenario s = on_battery(1e-5, 0.9);
  s.load.locked = false;
  s.initial.speed_rad_s = 600;
  s.reference.value = -5.0;
  s.pwm.chopping = control::Chopping::complementary;
  s.duration_s = 10e-3;
  EXPECT_GT(number_behind(outcome_of(s).remarks, "its charge rose to "), 1.0);
  s.supply.battery_charge = 0.1;
  EXPECT_THAT(outcome_of(s).remarks, Not(Contains(HasSubstr("battery was"))));
}

TEST(LimitRemarks, ARotorFasterThanItsSheetAllows) {
  Scenario s = maxon_scenario(Mode::duty, 1.0);
  s.initial.speed_rad_s = 650;
  s.duration_s = 20e-3;
  s.compare = {{measure(study::MetricKind::maximum, study::Signal::speed), 0.0, ""}};
  s.sheet.max_speed_rpm = base::Quantity{.value = 6000.0};
  const study::Outcome out = outcome_of(s);
  EXPECT_NEAR(number_behind(out.remarks, "the rotor reached "), out.comparisons.at(0).measured, 1.0);
  EXPECT_THAT(out.remarks, Contains(HasSubstr("(6000 rpm)")));
  s.sheet.max_speed_rpm->value = 10000;
  EXPECT_THAT(outcome_of(s).remarks, Not(Contains(HasSubstr("the sheet allows"))));
}

/// A braking rotor charges a capacitor. The energy of the capacitor is at most C U^2/2 + J w^2/2.
TEST(LimitRemarks, ABusThatIsPumpedUp) {
  Scenario s = maxon_scenario(Mode::current, -5.0);
  s.pwm.chopping = control::Chopping::complementary;
  s.initial.speed_rad_s = 600;
  s.duration_s = 20e-3;
  s.supply.resistance_ohm = 0.05;
  s.supply.capacitance_F = 1e-3;
  s.supply.sinks = false;
  s.compare = {{measure(study::MetricKind::maximum, study::Signal::bus_voltage), 0.0, ""}};
  const study::Outcome out = outcome_of(s);
  const double rose_V = number_behind(out.remarks, "the bus rose to ");
  const double J = out.motor.shaft.J_kg_m2, most_V = std::sqrt(24.0 * 24.0 + J * 600 * 600 / 1e-3);
  EXPECT_NEAR(rose_V, out.comparisons.at(0).measured, 0.2);
  EXPECT_GT(rose_V, 1.2 * 24);
  EXPECT_LT(rose_V, most_V);
  const auto silent = [](const Scenario& with) {
    EXPECT_THAT(outcome_of(with).remarks, Not(Contains(HasSubstr("the bus rose"))));
  };
  Scenario sinks = s, large = s, chopper = s;
  sinks.supply.sinks = true;
  silent(sinks);
  large.supply.capacitance_F = 0.1;
  silent(large);
  chopper.supply.brake_resistance_ohm = 5;
  chopper.supply.brake_on_V = 40;
  chopper.supply.brake_off_V = 38;
  silent(chopper);
}

/// A weight that is lowered charges any capacitor. The remark therefore proposes no capacitor, and ten times
/// the capacitance only prolongs the charging.
TEST(LimitRemarks, ALoadThatDrivesFillsAnyCapacitor) {
  Scenario s = maxon_scenario(Mode::speed, -200.0);
  s.initial.speed_rad_s = -200;
  s.load.torque_Nm = 0.1;
  s.pwm.chopping = control::Chopping::complementary;
  s.control.current.settle_s = 1e-3;
  s.control.speed.settle_s = 20e-3;
  s.supply.resistance_ohm = 0.05;
  s.supply.sinks = false;
  for (const double times : {1.0, 10.0}) {
    s.supply.capacitance_F = times * 1e-3;
    s.duration_s = times * 0.05;
    const auto remarks = outcome_of(s).remarks;
    EXPECT_THAT(remarks,
                Contains(AllOf(HasSubstr("the bus rose to "), HasSubstr("no capacitance is large enough"),
                               Not(HasSubstr("a larger supply.capacitance_F")))))
        << times;
  }
}

/// The same run with a warming motor and held current shows when its winding passes the limit.
TEST(LimitRemarks, AWindingThatWouldNotStandIt) {
  Scenario s = maxon_scenario(Mode::current, 20.0);
  s.sheet = curve_sheet();
  s.sheet.nominal_current_A->frame = "terminal";
  s.supply.voltage_V = 48;  // enough for 20 A also in a warm winding
  s.load.locked = true;
  s.duration_s = 2.0;
  const auto remarks = outcome_of(s).remarks;
  const double within_s = number_behind(remarks, "its limit of 125 degC at t = ");
  Scenario warm = s;
  warm.heat.motor = true;
  warm.duration_s = 1.03 * within_s;
  EXPECT_THAT(outcome_of(warm).remarks, Contains(HasSubstr("and the motor's sheet allows 125 degC")));
  warm.duration_s = 0.96 * within_s;
  EXPECT_THAT(outcome_of(warm).remarks, Not(Contains(HasSubstr("and the motor's sheet allows"))));
  s.reference.value = 2.33;
  EXPECT_THAT(outcome_of(s).remarks, Not(Contains(HasSubstr("copper loss"))));
  s.reference.value = 20.0;
  const auto no_books = study::run(s, {.keep_books = false});
  ASSERT_TRUE(no_books);
  EXPECT_THAT(no_books->remarks, Not(Contains(HasSubstr("copper loss"))));
}

}  // namespace SIXSTEP_TEST_FILE

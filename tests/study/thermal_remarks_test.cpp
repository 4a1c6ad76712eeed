// SPDX-License-Identifier: Apache-2.0
// Remarks say when a run's copper loss takes the winding to its limit, within the run or if the loss at its end goes on.
// The same run with temperatures passes the limit then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/design/sheet/thermal.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Mode;
using study::Scenario;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* told_word = "to the end the winding loses ";
constexpr const char* limit_word = "its limit of 125 degC at t = ";

/// A motor whose winding is not hot within tenths of a second.
design::Sheet slow_sheet() {
  design::Sheet s = curve_sheet();
  s.nominal_current_A->frame = "terminal";
  return s;
}

/// The sheet of a motor whose winding becomes warm within seconds.
design::Sheet quick_sheet() {
  design::Sheet s = curve_sheet();
  s.nominal_current_A->frame = "terminal";
  s.thermal_time_constant_winding_s->value = 0.6;
  s.thermal_time_constant_motor_s->value = 8;
  s.magnet_loss_percent_K = 0;  // else a load needs more current when the magnets are warm
  return s;
}

/// The number after a word in the remark on the kept current. Empty if there is no such remark.
std::optional<double> told(const Scenario& s, const std::string& word) {
  for (const std::string& text : outcome_of(s).remarks)
    if (text.find(told_word) != text.npos)
      if (const std::size_t at = text.find(word); at != text.npos)
        return std::stod(text.substr(at + word.size()));
  return {};
}

bool is_told(const Scenario& s) { return told(s, "as with ").has_value(); }

/// A speed cascade that holds a weight: 0.123 N m need 3.7 A for as long as it is held.
Scenario lift() {
  Scenario s = maxon_scenario(Mode::speed, 200.0);
  s.sheet = quick_sheet();
  s.duration_s = 0.3;
  s.pwm.period_s = 60e-6;
  s.pwm.chopping = control::Chopping::complementary;
  s.control.current.settle_s = 2e-3;
  s.control.speed.settle_s = 20e-3;
  s.control.speed.torque_limit_Nm = 0.1675;
  s.load.torque_Nm = 0.123;
  s.load.inertia_kg_m2 = 25e-6;
  return s;
}

Scenario with_current(double reference) {
  Scenario s = lift();
  s.control.mode = Mode::current;
  s.control.speed = {};
  s.control.speed.torque_limit_Nm.reset();
  s.reference.value = reference;
  return s;
}

/// Four drives: a weight, a fan that a current drives, a locked rotor, and a field-oriented drive.
std::vector<Scenario> drives_that_keep_a_current() {
  std::vector<Scenario> all{lift(), with_current(4.0), with_current(4.0), lift()};
  all[1].load.torque_Nm = 0.0;
  all[1].load.viscous_Nm_s = 4e-4;
  all[1].initial.speed_rad_s = 4 * 0.0335 / 4e-4;
  all[2].load = {};
  all[2].load.locked = true;
  all[3].control.drive = study::FirmwareKind::field;
  all[3].pwm.chopping = control::Chopping::soft;  // no choice of such a drive
  all[3].pwm.alignment = study::Alignment::centre;
  all[3].sheet.back_emf = design::BackEmfShape::sine;
  return all;
}

TEST(ThermalRemarks, ACurrentThatIsKeptPassesTheWindingsLimitWhenItIsTold) {
  for (Scenario s : drives_that_keep_a_current()) {
    const auto within_s = told(s, limit_word);
    ASSERT_TRUE(within_s);
    s.heat.motor = true;
    const auto passes = [&s](double duration_s) {
      s.duration_s = duration_s;
      const auto remarks = outcome_of(s).remarks;
      return std::any_of(remarks.begin(), remarks.end(), [](const std::string& text) {
        return text.find("the winding reached ") != text.npos;
      });
    };
    // In a warm winding, the ripple is smaller, and commutations reduce the speed less. The loss is therefore
    // lower by some per cent.
    EXPECT_TRUE(passes(1.12 * *within_s)) << *within_s;
    EXPECT_FALSE(passes(0.95 * *within_s)) << *within_s;
  }
}

/// The copper loss 2 R I^2 of the named current is the named loss. The torque of this current is equal to
/// load and friction.
TEST(ThermalRemarks, TheNamedCurrentCarriesTheLoad) {
  const double loss_W = *told(lift(), "loses a steady "), ampere = *told(lift(), "as with ");
  EXPECT_NEAR(1.03 * ampere * ampere, loss_W, 0.01 * loss_W);
  EXPECT_NEAR(ampere, (0.123 + 7.3e-6 * 200) / 0.0335, 0.05 * ampere) << "commutation and ripple add to it";
  EXPECT_NEAR(*told(lift(), "two phases, "), ampere / 2.33, 0.01);
}

TEST(ThermalRemarks, OnlyWhatIsKeptAndTooMuchIsTold) {
  const auto silent = [](const Scenario& s) { return !is_told(s); };
  Scenario light = lift(), short_run = lift(), accelerates = lift(), warm = lift();
  light.load.torque_Nm = 0.05;
  EXPECT_TRUE(silent(light)) << "1.5 A are less than the nominal current";
  short_run.duration_s = 0.055;
  short_run.load.torque_Nm = 0.05;
  short_run.load.inertia_kg_m2 = 50e-6;
  EXPECT_TRUE(silent(short_run)) << "it still accelerates, and then needs 1.5 A";
  accelerates.load.torque_Nm = 0.0;
  accelerates.load.inertia_kg_m2 = 1e-3;
  EXPECT_FALSE(silent(accelerates)) << "the winding is too hot before the run-up ends";
  accelerates.sheet = slow_sheet();
  EXPECT_TRUE(silent(accelerates)) << "5 A that end with the run-up";
  warm.heat.motor = true;
  EXPECT_FALSE(silent(warm)) << "0.3 s do not warm the winding";
  EXPECT_NEAR(*told(warm, limit_word), *told(lift(), limit_word), 0.1 * *told(lift(), limit_word))
      << "the loss counts at the sheet's temperature";
  const auto no_books = study::run(lift(), {.keep_books = false});
  ASSERT_TRUE(no_books);
  EXPECT_THAT(no_books->remarks, Not(Contains(HasSubstr(told_word))));
}

/// Without thermal values, the nominal current of the sheet is the bound.
TEST(ThermalRemarks, ANominalCurrentAloneIsABoundToo) {
  for (const double nominal_A : {2.33, 5.0}) {
    Scenario s = lift();
    s.sheet.thermal_time_constant_motor_s.reset();
    s.sheet.nominal_current_A->value = nominal_A;
    EXPECT_EQ(is_told(s), nominal_A < 3.7) << nominal_A;
  }
}

/// If no remark uses the given ambient temperature, a remark names it as unused. If a remark uses it, it
/// changes the number of this remark.
TEST(ThermalRemarks, AnAmbientTemperatureCountsWhereARemarkUsesIt) {
  const auto unused = [](Scenario s) {
    s.heat.ambient_degC = 60.0;
    const auto remarks = outcome_of(s).remarks;
    return std::any_of(remarks.begin(), remarks.end(),
                       [](const auto& text) { return text.find("heat.ambient_degC") != text.npos; });
  };
  Scenario light = lift();
  light.load.torque_Nm = 0.05;
  EXPECT_TRUE(unused(light));
  EXPECT_FALSE(unused(lift()));
  Scenario hot = lift();
  hot.heat.ambient_degC = 60.0;
  EXPECT_LT(*told(hot, limit_word), 0.8 * *told(lift(), limit_word));
}

/// Locked at `high_A` for `on_s`, then without current.
Scenario overload(double high_A, double on_s, double duration_s) {
  Scenario s = with_current(high_A);
  s.load = {};
  s.load.locked = true;
  s.duration_s = duration_s;
  s.reference = {.shape = study::Shape::steps};
  s.reference.times_s = {0.0, on_s};
  s.reference.values = {high_A, 0.0};
  return s;
}

/// Highest temperature, and the time at which it passes the limit, simulated with temperatures.
std::vector<double> simulated(Scenario s) {
  s.heat.motor = true;
  study::Measure passes = over(study::MetricKind::reach_time, study::Signal::winding_temperature, 0.0);
  passes.level = 125.0;
  passes.start = 25.0;
  passes.fraction = 1.0;
  s.compare = {{over(study::MetricKind::maximum, study::Signal::winding_temperature, 0.0), 0, "test"},
               {passes, 0, "test"}};
  return figures_of(s);
}

/// The mean loss would stay below the limit for ever, and at the end there is none.
TEST(ThermalRemarks, AnOverloadBeforeAPauseIsTold) {
  const Scenario s = overload(10.0, 0.15, 4.0);
  const auto remarks = outcome_of(s).remarks;
  const auto at = std::find_if(remarks.begin(), remarks.end(), [](const auto& text) {
    return text.find("the copper loss of the run heats the winding") != text.npos;
  });
  ASSERT_NE(at, remarks.end());
  const auto number = [&at](const std::string& word) {
    return std::stod(at->substr(at->find(word) + word.size()));
  };
  const auto truth = simulated(s);
  EXPECT_NEAR(number(" s and "), truth[0], 0.01 * truth[0]);
  EXPECT_NEAR(number(limit_word), truth[1], 0.01 * truth[1]);
  for (const std::string& text : outcome_of(overload(10.0, 0.05, 4.0)).remarks)
    EXPECT_EQ(text.find("heats the winding"), text.npos) << text;
}

/// With ranges, the worse ends count as if they were the sheet's values.
TEST(ThermalRemarks, TheWorseEndsCountAsValues) {
  Scenario s = overload(10.0, 0.1, 4.0), worse = s;
  base::Quantity& winding_s = *s.sheet.thermal_time_constant_winding_s;
  winding_s.range = base::Interval{0.4, 0.6};
  worse.sheet.thermal_time_constant_winding_s->value = 0.4;
  for (const std::string& text : outcome_of(s).remarks)
    if (const std::size_t at = text.find(limit_word); at != text.npos) {
      EXPECT_NEAR(std::stod(text.substr(at + std::string(limit_word).size())), simulated(worse)[1], 0.004);
      EXPECT_THAT(text, HasSubstr("by the worse ends of the thermal ranges"));
      EXPECT_THAT(text, Not(HasSubstr("by the sheet's thermal values;")));
      return;
    }
  ADD_FAILURE() << "not told";
}

/// A start that the scenario gives counts, and a remark counts from the run's beginning.
TEST(ThermalRemarks, AHotStartReachesTheLimitSooner) {
  Scenario s = with_current(5.0);
  s.load = {};
  s.load.locked = true;
  s.sheet.thermal_time_constant_winding_s->value = 2;
  s.heat = {.motor = true, .winding_degC = 100.0, .housing_degC = 90.0};
  s.duration_s = 0.06;
  const auto hot = told(s, limit_word);
  ASSERT_TRUE(hot);
  s.heat.winding_degC = s.heat.housing_degC = {};
  EXPECT_LT(*hot, 0.4 * *told(s, limit_word));
  s.heat.winding_degC = 100.0, s.heat.housing_degC = 90.0;
  s.duration_s = 1.2 * *hot;
  study::Measure passes = over(study::MetricKind::reach_time, study::Signal::winding_temperature, 0.0);
  passes.level = 125.0;
  passes.start = 100.0;
  passes.fraction = 1.0;
  s.compare = {{passes, 0, "test"}};
  EXPECT_NEAR(*hot, figures_of(s)[0], 0.03 * *hot);
}

/// Locked without current, and then with `last_A` from `on_s` until the end.
Scenario loaded_last(double last_A, double on_s, double duration_s) {
  Scenario s = overload(0.0, on_s, duration_s);
  s.sheet = slow_sheet();
  s.reference.values = {0.0, last_A};
  return s;
}

/// A current that begins late takes the winding to its limit in the time that the two-body model gives for its loss.
TEST(ThermalRemarks, ASteadyLossCountsHoweverLateItBegins) {
  const Scenario whole = loaded_last(8.0, 0.0, 1.0);
  const auto model = design::thermal_model(whole.sheet);
  ASSERT_TRUE(model);
  for (const double on_s : {0.6, 0.83, 0.86, 0.9, 0.92, 0.945}) {
    const auto limit_s = told(loaded_last(8.0, on_s, 1.0), limit_word);
    ASSERT_TRUE(limit_s) << on_s;
    const double ampere = *told(loaded_last(8.0, on_s, 1.0), "as with ");
    EXPECT_NEAR(ampere, 8.0, 0.05 * 8.0) << "the ripple adds to it, " << on_s;
    const auto truth_s = design::permissible_seconds(*model, {.copper_W = 1.03 * ampere * ampere});
    ASSERT_TRUE(truth_s);
    EXPECT_NEAR(*limit_s - on_s, *truth_s, 0.03 * *truth_s) << on_s;
    EXPECT_FALSE(is_told(loaded_last(1.0, on_s, 1.0))) << "1 A is less than the nominal current";
  }
}

/// A speed drive whose run ends in a run-up: its current ends with it.
TEST(ThermalRemarks, ALateRunUpIsNotKept) {
  Scenario s = lift();
  s.sheet = slow_sheet();
  s.load.torque_Nm = 0.0;
  s.load.inertia_kg_m2 = 1e-3;
  s.duration_s = 0.6;
  s.reference = {.shape = study::Shape::steps};
  s.reference.times_s = {0.0, 0.55};
  s.reference.values = {0.0, 200.0};
  EXPECT_FALSE(is_told(s));
  s.load.locked = true;
  s.reference.values = {0.0, 2000.0};
  EXPECT_TRUE(is_told(s)) << "the rotor does not turn, and the current stays";
}

/// The loss decides, whatever asks for the current: a weight on an arm that is too heavy, a weight that runs the motor
/// backwards, an alternating current.
TEST(ThermalRemarks, AnyLossThatGoesOnIsTold) {
  Scenario arm = lift(), dragged = lift(), sine = with_current(6.0);
  arm.sheet = dragged.sheet = sine.sheet = slow_sheet();
  arm.load.torque_Nm = 0.0;
  arm.load.gravity_Nm = 0.3;
  arm.control.speed.torque_limit_Nm = dragged.control.speed.torque_limit_Nm = 0.25;
  dragged.load.torque_Nm = 0.3;
  sine.load = {};
  sine.load.locked = true;
  sine.duration_s = 0.2;
  sine.reference = {.shape = study::Shape::sine};
  sine.reference.amplitude = 6.0;
  sine.reference.frequency_Hz = 50.0;
  for (const double reference : {8.0, 10.0, 20.0}) {
    arm.reference.value = reference;
    EXPECT_TRUE(is_told(arm)) << reference;
  }
  for (const Scenario& s : {dragged, sine}) {
    EXPECT_TRUE(told(s, limit_word));
  }
  study::Measure loss = over(study::MetricKind::mean, study::Signal::copper_loss, 0.16);
  sine.compare = {{loss, 0, "test"}};
  const double mean_W = figures_of(sine)[0], ampere = *told(sine, "as with ");
  EXPECT_NEAR(1.03 * ampere * ampere, mean_W, 0.1 * mean_W);
}

}  // namespace SIXSTEP_TEST_FILE

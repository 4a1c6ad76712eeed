// SPDX-License-Identifier: Apache-2.0
// At the end of a run, the drive keeps a current. A remark states for how long the winding withstands this
// current. If temperatures are simulated, the same run passes the winding's limit at that time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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

constexpr const char* told_word = "the winding loses a steady ";

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

/// A speed cascade that carries a weight. As long as the weight is carried, 0.123 N m need 3.7 A.
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
    const auto within_s = told(s, "withstands this current for ");
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
  const double loss_W = *told(lift(), told_word), ampere = *told(lift(), "as with ");
  EXPECT_NEAR(1.03 * ampere * ampere, loss_W, 0.01 * loss_W);
  EXPECT_NEAR(ampere, (0.123 + 7.3e-6 * 200) / 0.0335, 0.05 * ampere) << "commutation and ripple add to it";
  EXPECT_NEAR(*told(lift(), "two phases, "), ampere / 2.33, 0.01);
}

TEST(ThermalRemarks, OnlyWhatIsKeptAndTooMuchIsTold) {
  const auto silent = [](const Scenario& s) { return !told(s, told_word); };
  Scenario light = lift(), short_run = lift(), accelerates = lift(), warm = lift();
  light.load.torque_Nm = 0.05;
  EXPECT_TRUE(silent(light)) << "1.5 A are less than the nominal current";
  short_run.duration_s = 0.1;
  EXPECT_TRUE(silent(short_run)) << "it still accelerates";
  accelerates.load.torque_Nm = 0.0;
  accelerates.load.inertia_kg_m2 = 1e-3;
  EXPECT_TRUE(silent(accelerates)) << "5 A that end with the run-up";
  warm.heat.motor = true;
  EXPECT_FALSE(silent(warm)) << "0.3 s do not warm the winding";
  EXPECT_NEAR(*told(warm, "withstands this current for "), *told(lift(), "withstands this current for "),
              0.1 * *told(lift(), "withstands this current for "))
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
    EXPECT_EQ(told(s, told_word).has_value(), nominal_A < 3.7) << nominal_A;
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
  EXPECT_LT(*told(hot, "withstands this current for "), 0.8 * *told(lift(), "withstands this current for "));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Fixed point in a scenario: the bases exceed all values of the drive, or check() refuses the scenario.
#include "sixstep/study/compile/arithmetic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sixstep/control/fixed.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Arithmetic;
using study::Scenario;
using ::testing::HasSubstr;

template <class Scalar>
rig::Bases units(const Scenario& s) {
  const auto compiled = study::compile(s);
  const auto drive = study::drive_in<Scalar>(s, *compiled);
  return drive ? drive->bases : rig::Bases{.current_A = -1};
}

TEST(Arithmetic, FloatingPointComputesInSI) {
  const rig::Bases u = units<float>(current_square());
  for (const double unit : {u.current_A, u.voltage_V, u.speed_rad_s, u.position_deg, u.setpoint})
    EXPECT_EQ(unit, 1.0);
}

TEST(Arithmetic, TheProductsDriveIsTheOneThatIsExported) {
  // drive_in() returns the drive that `sixstep export header` writes. Its bases are the bases of the product
  // drive, which follow from the converters of the board.
  const Scenario s = product_scenario(control::Mode::speed, 100.0);
  const auto compiled = study::compile(s);
  const auto drive = study::drive_in<control::Q15>(s, *compiled);
  const auto product = study::product_in<control::Q15>(s, *compiled);
  ASSERT_TRUE(drive && product);
  EXPECT_EQ(drive->bases.current_A, product->bases.current_A);
  EXPECT_EQ(drive->bases.setpoint, product->bases.setpoint);
  EXPECT_EQ(drive->config.current.d1.mantissa, product->config.drive.current.d1.mantissa);
  EXPECT_EQ(drive->config.speed.K_i.right, product->config.drive.speed.K_i.right);
  EXPECT_GE(product->bases.current_A, 20.48) << "the converter's end";
}

TEST(Arithmetic, BasesHoldTwiceTheReferenceAgainstIt) {
  // The largest error is 15 A: a measured current of 10 A minus a reference of -5 A. The largest Q31 number
  // is one digit below the base, which is 1.
  const rig::Bases u = units<control::Q31>(current_square());
  EXPECT_NEAR(u.current_A, 15.0, 15.0 * 0x1p-30);
  EXPECT_NEAR(u.voltage_V, 24.0, 24.0 * 0x1p-30);
  EXPECT_EQ(u.setpoint, u.current_A);
  // Q30 represents numbers below 2. With half the base, it has the same range.
  EXPECT_NEAR((units<control::Q30>(current_square()).current_A), 7.5, 7.5 * 0x1p-30);
}

/// Each format can represent the over-speed threshold. The thresholds are above and below 716 rad/s, the
/// speed that the bus allows.
TEST(Arithmetic, AnyOverSpeedFits) {
  for (const double over : {400.0, 716.0, 717.0, 800.0, 900.0})
    for (const auto arithmetic : {study::Arithmetic::q14, study::Arithmetic::q15, study::Arithmetic::q31}) {
      Scenario s = product_scenario(control::Mode::current, 3.0);
      s.duration_s = 2e-3;
      s.control.arithmetic = arithmetic;
      s.protection.over_speed_rad_s = over;
      const auto run = study::run(s);
      EXPECT_TRUE(run) << over << ": " << to_string(run.problems()[0]);
    }
}

TEST(Arithmetic, SetpointHasTheUnitOfItsMode) {
  Scenario s = maxon_scenario(control::Mode::speed, 100.0);
  EXPECT_EQ(units<control::Q31>(s).setpoint, units<control::Q31>(s).speed_rad_s);
  s = maxon_scenario(control::Mode::position, 1000.0);
  EXPECT_EQ(units<control::Q31>(s).setpoint, units<control::Q31>(s).position_deg);
  s = maxon_scenario(control::Mode::duty, 0.5);
  EXPECT_EQ(units<control::Q31>(s).setpoint, 1.0);
}

TEST(Arithmetic, AGivenFullScaleIsWhatTheEndsStandFor) {
  Scenario s = current_square();
  s.control.full_scale.current_A = 32.0;
  EXPECT_EQ(units<control::Q15>(s).current_A, 32.0);
  EXPECT_EQ((units<control::Q14>(s).current_A), 16.0);
}

TEST(Arithmetic, WhatDoesNotFitIsAProblemBeforeTheRun) {
  Scenario s = current_square();
  s.control.arithmetic = Arithmetic::q15;
  s.control.full_scale.current_A = 8.0;  // an error of 15 A (10 A measured, -5 A reference) exceeds the base
  const auto run = study::run(s);
  ASSERT_FALSE(run);
  EXPECT_EQ(run.problems()[0].where, "control.arithmetic");
  EXPECT_EQ(run.problems()[0].value, "\"q15\"");
  EXPECT_THAT(run.problems()[0].limit, HasSubstr("above full scale"));
  EXPECT_THAT(run.problems()[0].cure, HasSubstr("control.full_scale"));
}

/// The message names a full scale. With this full scale, the scenario is accepted; with one hundredth less,
/// it is refused.
TEST(Arithmetic, AFullScaleThatIsTooSmallIsToldWithTheKeyThatFits) {
  for (const Arithmetic format : {Arithmetic::q15, Arithmetic::q14}) {
    Scenario s = current_square();
    s.control.arithmetic = format;
    s.control.full_scale.current_A = 1.0;
    const auto told = [&s]() -> std::string {
      const auto out = study::run(s);
      if (out) return "";
      std::string text;  // the message with the largest full scale
      double most = 0.0;
      const std::string word = "use control.full_scale.current_A of ";
      for (const base::Problem& p : out.problems())
        if (const std::size_t at = p.cure.find(word); at != std::string::npos)
          if (const double value = std::stod(p.cure.substr(at + word.size())); value > most) {
            most = value;
            text = std::to_string(value);
          }
      return text;
    };
    const std::string needed = told();
    ASSERT_NE(needed, "");
    for (const double beyond : {1.0, 0.99}) {
      s.control.full_scale.current_A = std::stod(needed) * beyond;
      EXPECT_EQ(told().empty(), beyond == 1) << needed;
    }
  }
}

TEST(Arithmetic, AnIntegralThatSeesNoDigitIsAProblem) {
  Scenario s = current_square();
  s.control.current = {};
  s.control.current.kp = 4.5;
  s.control.current.ki = 1e-5;  // per unit 6e-6, below 2^-13 of 16 bits
  s.control.arithmetic = Arithmetic::q15;
  const auto narrow = study::run(s);
  ASSERT_FALSE(narrow);
  EXPECT_THAT(narrow.problems()[0].limit, HasSubstr("current.K_i"));
  s.control.arithmetic = Arithmetic::q31;
  EXPECT_TRUE(study::run(s));
}

/// The message names a bound of the timer's frequency. A frequency at this bound is accepted, and a frequency
/// 1 % beyond it is refused.
TEST(Arithmetic, AnEdgeTimerBeyondTheSumIsToldWithTheNumbersThatFit) {
  const std::pair<study::FirmwareKind, Arithmetic> drives[] = {
      {study::FirmwareKind::product, Arithmetic::q15},
      {study::FirmwareKind::product, Arithmetic::q14},
      {study::FirmwareKind::lean, Arithmetic::q15},
      {study::FirmwareKind::lean, Arithmetic::q14}};
  for (const auto& [drive, format] : drives) {
    Scenario s = product_scenario(control::Mode::speed, 100.0);
    if (drive == study::FirmwareKind::lean) s.protection = {};
    s.control.drive = drive;
    s.control.arithmetic = format;
    s.sensors.capture_Hz = 400e6;
    s.sensors.speed_edges = 6;
    s.duration_s = 1e-4;
    const auto told = [&s]() -> std::string {
      const auto out = study::run(s);
      if (out) return "";
      for (const base::Problem& p : out.problems())
        if (to_string(p).find("times the range") != std::string::npos) return to_string(p);
      return "";
    };
    const std::string text = told();
    const auto number = [&text](const std::string& word) {
      const std::size_t at = text.find(word);
      EXPECT_NE(at, std::string::npos) << word << " in " << text;
      return at == std::string::npos ? 1.0 : std::stod(text.substr(at + word.size()));
    };
    const bool lean = drive == study::FirmwareKind::lean;
    const double times = number(lean ? "speed_edges is " : "number of edges is ");
    const double full_scale = number("control.full_scale.speed_rad_s of ");
    const double most_Hz = lean ? number("use a timer of ") : 400e6 / times;
    for (const double beyond : {0.999, 1.01}) {
      s.sensors.capture_Hz = most_Hz * beyond;
      EXPECT_EQ(told().empty(), beyond < 1) << text;
    }
    s.sensors.capture_Hz = 400e6;
    for (const double beyond : {1.0, 0.99}) {
      s.control.full_scale.speed_rad_s = full_scale * beyond;
      EXPECT_EQ(told().empty(), beyond == 1) << text;
    }
  }
}

TEST(Arithmetic, EveryModeRunsInEveryFormat) {
  for (const control::Mode mode : {control::Mode::off, control::Mode::duty, control::Mode::current,
                                   control::Mode::speed, control::Mode::position})
    for (const Arithmetic a : {Arithmetic::q15, Arithmetic::q14, Arithmetic::q31, Arithmetic::q30}) {
      Scenario s = maxon_scenario(mode, mode == control::Mode::duty ? 1.0 : 20.0);
      s.control.arithmetic = a;
      s.duration_s = 2e-3;
      ask(s, measure(study::MetricKind::final_value, study::Signal::speed));
      const auto out = study::run(s);
      ASSERT_TRUE(out) << to_string(out.problems()[0]);
      EXPECT_FALSE(out->fault);
      const double least = mode == control::Mode::off ? 0.0 : 1.0;
      EXPECT_GE(out->comparisons[0].measured, least);
    }
}

TEST(Arithmetic, FullDutyIsWholeWhereTheFormatHasIt) {
  // Q14 represents 1, so there is no off-time, and the trajectory is equal to the trajectory in double. The
  // largest Q15 number is one digit below 1, so each period has an off-time.
  Scenario s = maxon_scenario(control::Mode::duty, 1.0);
  const auto wide = study::run(s);
  s.control.arithmetic = Arithmetic::q14;
  EXPECT_EQ(study::run(s)->digest, wide->digest);
  s.control.arithmetic = Arithmetic::q15;
  EXPECT_NE(study::run(s)->digest, wide->digest);
}

}  // namespace SIXSTEP_TEST_FILE

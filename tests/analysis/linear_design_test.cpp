// SPDX-License-Identifier: Apache-2.0
// The design of a linear motor has the gains of the equivalent rotary motor in other units. Its texts are in
// linear units.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/analysis/verify/first_scenario.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/linear.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::analysis;
using namespace sixstep::testing;
using control::Mode;

constexpr double r = unrolled_at_m, mm_per_deg = 1e3 * base::pi / 180;

DesignStudy studied(const DesignOrder& order) {
  auto study = study_design(order);
  EXPECT_TRUE(study) << base::to_string(study.problems()[0]);
  return *study;
}

/// Designs of both motors for the same board, with equivalent torque limit, lowest speed and step.
std::pair<DesignStudy, DesignStudy> both(Mode mode) {
  DesignOrder turning{.subject = {"m", maxon_sheet(), {}}, .spec = design::on_a_board()};
  turning.spec.mode = mode;
  turning.spec.settle_s = mode == Mode::current ? 1e-3 : 40e-3;
  turning.spec.torque_limit_Nm = 0.5;
  turning.spec.lowest_speed_rad_s = 128;
  if (mode == Mode::position) turning.subject.step = 720;
  DesignOrder linear = turning;
  linear.subject.sheet = unrolled(turning.subject.sheet);
  linear.spec.torque_limit_Nm = 0.5 / r;
  linear.spec.lowest_speed_rad_s = 128 * r;
  if (mode == Mode::position) linear.subject.step = 720 * mm_per_deg * r;
  return {studied(turning), studied(linear)};
}

void expect_part(double a, double b, const std::string& what, double part = 1e-11) {
  EXPECT_NEAR(a, b, part * std::fabs(b)) << what;
}

TEST(LinearDesign, HasTheTurningOnesGains) {
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    const auto [turning, linear] = both(mode);
    for (std::size_t n = 0; n < turning.design.loops.size(); ++n) {
      const auto &a = turning.design.loops[n], &b = linear.design.loops[n];
      // The gain of the speed loop is in A per m/s instead of A per rad/s. The gain of the position loop is
      // 1/s, apart from degrees.
      const double factor = a.name == "speed" ? 1 / r : 1.0;
      expect_part(b.gains.d1, a.gains.d1 * factor, a.name, a.name == "position" ? 2e-3 : 1e-11);
      expect_part(b.gains.d0, a.gains.d0 * factor, a.name);
      EXPECT_EQ(b.figures.stable, a.figures.stable);
      ASSERT_EQ(a.steps.size(), b.steps.size());
    }
    ASSERT_EQ(turning.warnings.size(), linear.warnings.size());
    EXPECT_EQ(turning.usable(), linear.usable());
    expect_part(linear.design.headroom_end_rad_s, turning.design.headroom_end_rad_s * r, "headroom");
    ASSERT_EQ(turning.outcome.comparisons.size(), linear.outcome.comparisons.size());
  }
}

TEST(LinearDesign, RunsAsTheTurningOneDoes) {
  for (const Mode mode : {Mode::current, Mode::speed}) {
    const auto [turning, linear] = both(mode);
    for (std::size_t n = 0; n < turning.outcome.comparisons.size(); ++n) {
      const auto &a = turning.outcome.comparisons[n], &b = linear.outcome.comparisons[n];
      EXPECT_EQ(b.unit, base::in_linear(a.unit).linear);
      EXPECT_NEAR(b.measured, a.measured * (a.unit == "rad/s" ? r : 1.0),
                  1e-6 * std::fabs(a.measured) + 1e-12)
          << a.figure;
    }
  }
}

TEST(LinearDesign, IsToldInMetres) {
  const auto [turning, linear] = both(Mode::position);
  const auto& gain = linear.design.loop("position").steps.at(0);
  EXPECT_EQ(gain.unit, "m/s/mm");
  EXPECT_NEAR(gain.value, linear.design.loop("position").gains.d1 / mm_per_deg, 1e-15);
  for (const auto& step : linear.design.sensing) {
    EXPECT_THAT(turning_words(step.symbol + " " + step.formula + " " + step.unit), ::testing::IsEmpty());
    if (step.symbol == "v_low") {
      EXPECT_EQ(step.unit, "m/s");
    }
    if (step.symbol != "q") continue;
    EXPECT_EQ(step.unit, "mm");
    EXPECT_NEAR(step.value, linear.scenario.sheet.pole_pitch_mm->value / 3, 1e-12);
  }
  for (const auto& w : linear.warnings)
    EXPECT_THAT(turning_words(w.what + " " + w.cure), ::testing::IsEmpty());
  EXPECT_EQ(linear.scenario.reference.unit, "mm");
}

/// Sectors are 54 and 66 degrees instead of 60, which gives a speed error of a tenth of the lowest speed.
TEST(LinearDesign, ErrorsOfASpeedAreNamedAsTheSpeed) {
  DesignOrder order{.subject = {"m", unrolled(maxon_sheet()), {}}, .spec = design::on_a_board()};
  order.spec.mode = Mode::speed;
  order.spec.rotor.edges = 1;
  order.spec.lowest_speed_rad_s = 2.0;
  const DesignStudy s = studied(order);
  double error_m_s = 0.0;
  for (const auto& step : s.design.sensing) {
    EXPECT_EQ((step.symbol + " " + step.formula).find("w_low"), std::string::npos) << step.formula;
    EXPECT_FALSE(step.symbol.starts_with("dw") || step.symbol.starts_with("w_m")) << step.symbol;
    if (step.symbol == "dv_3") error_m_s = step.value;
  }
  EXPECT_NEAR(error_m_s, 0.2, 1e-12);
}

TEST(LinearDesign, TellsItsProblemsInItsOwnWords) {
  DesignOrder order{.subject = {"m", unrolled(maxon_sheet()), {}}, .spec = design::on_a_board()};
  order.spec.mode = Mode::speed;
  order.spec.torque_limit_Nm = -1;
  const auto study = study_design(order);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.problems()[0].where, "force_limit_N");
  EXPECT_EQ(study.problems()[0].cure, "give this value in N");
  order.subject.step = 0.0;
  EXPECT_EQ(study_design(order).problems()[0].cure, "give this value in A, m/s or mm according to the mode");
}

TEST(LinearDesign, AFirstScenarioRunsAndPasses) {
  for (const Mode mode : {Mode::duty, Mode::current, Mode::speed}) {
    FirstScenarioSpec spec;
    spec.mode = mode;
    spec.motor = "m";
    spec.sheet = unrolled(maxon_sheet());
    const auto s = first_scenario(spec);
    ASSERT_TRUE(s) << base::to_string(s.problems()[0]);
    EXPECT_TRUE(study::run(*s)->passed());
    EXPECT_THAT(turning_words(s->title), ::testing::IsEmpty());
  }
}

}  // namespace SIXSTEP_TEST_FILE

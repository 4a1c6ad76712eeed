// SPDX-License-Identifier: Apache-2.0
// When a design is usable, judged by its own figures, and which current loop is designed where nobody says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "tests/support/bench.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::analysis;
using control::Mode;

DesignOrder on_a_board(Mode mode) {
  DesignOrder order{.subject = {"maxon-251601", sixstep::testing::maxon_sheet(), {}},
                    .spec = design::on_a_board(),
                    .gain = {.quick = true},
                    .advises = false};
  order.spec.mode = mode;
  return order;
}

double swing_of(const DesignStudy& study) {
  for (const study::ComparisonResult& c : study.outcome.comparisons)
    if (c.figure == swing_at_target) return c.measured;
  return 0.0;
}

/// Of one pole pair a Hall step is 60 degrees, and the rotor swings over a few of them about its target.
TEST(UsableDesign, APositionOnHallProbesOfOnePolePairIsNone) {
  DesignOrder order = on_a_board(Mode::position);
  order.subject.sheet.pole_pairs = 1;
  const auto study = study_design(order);
  ASSERT_TRUE(study) << to_string(study.problems().front());
  EXPECT_GT(swing_of(*study), usual_move(study->design) / 10);
  EXPECT_FALSE(study->usable());
  EXPECT_NE(study->warnings.front().what.find("swings around its target"), std::string::npos)
      << study->warnings.front().what;
}

void holds_its_figures(const DesignStudy& study) {
  EXPECT_LE(swing_of(study), usual_move(study.design) / 10);
  if (!study.robustness) return;  // a position's gain that was found at once
  const std::vector<double>& levels = study.scenario.reference.values;
  const bool steps = levels.size() > 1;
  for (const RobustFigure& f : study.robustness->figures) {
    if (steps && f.figure == "overshoot") {
      EXPECT_LE(f.worst, std::fabs(levels[1] - levels[0]));
    }
    if (f.figure == settling_of_start) {
      EXPECT_TRUE(std::isfinite(f.worst));
    }
  }
}

/// It overshoots a step by less than that step, ends its start, and rests near its target.
TEST(UsableDesign, HoldsItsOwnFiguresOutOfToleranceToo) {
  int usable = 0;
  for (const Mode mode : {Mode::speed, Mode::position}) {
    for (const double inductance : {1.0, 0.6}) {
      DesignOrder order = on_a_board(mode);
      order.tolerances = sheet_tolerances(order.subject.sheet, mode);
      order.subject.sheet.inductance_mH->value *= inductance;
      const auto study = study_design(order);
      if (!study || !study->usable()) continue;
      ++usable;
      holds_its_figures(*study);
    }
  }
  EXPECT_GE(usable, 2);
}

/// Of a placed pair d1 is positive while 2 x 4.6/T_reg is above R/L.
TEST(UsualCurrentLoop, OfAnyWindingGainsPositively) {
  for (const double times : {1.0, 0.3, 0.1, 0.03}) {
    design::MotorModel motor = *design::motor_model(sixstep::testing::maxon_sheet());
    motor.machine.L_H *= times;
    const double time_constant = motor.machine.L_H / motor.machine.R_ohm;
    EXPECT_LE(design::usual_current_settle_s_of(motor),
              std::min(design::usual_current_settle_s, 2 * design::time_constants_to_settle * time_constant));
    const auto d = design::design_drive(motor, {.mode = Mode::current, .period_s = time_constant / 20});
    ASSERT_TRUE(d);
    EXPECT_GT(d->loop("current").gains.d1, 0.0) << times;
    EXPECT_TRUE(d->loop("current").figures.stable);
  }
}

}  // namespace

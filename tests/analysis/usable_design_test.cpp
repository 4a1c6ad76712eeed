// SPDX-License-Identifier: Apache-2.0
// Tests the conditions of a usable design, which are computed from its figures, and the default current loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/analysis/verify/design_study.hpp"
#include "sixstep/base/angle.hpp"
#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

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

/// With one pole pair, a Hall step is 60 degrees, so the rotor oscillates around its target by a few such
/// steps.
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
  if (!study.robustness) return;  // the position gain needed no search
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

/// At each end of the tolerances, three conditions are met: the overshoot is below the step, the start
/// settles, and the rotor rests near its target.
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

/// A move by the angle h with the torque T takes 2 sqrt(h J/T), with the inertia J. If the bus voltage ends
/// the acceleration at the speed `top`, the move takes h/top + top J/T.
TEST(DesignedMove, IsExpectedAsFastAsTorqueAndBusAllow) {
  for (const double bus_V : {6.0, 24.0, 200.0}) {
    DesignOrder order = on_a_board(Mode::position);
    order.spec.rotor.hall = false;
    const auto d = design::design_drive(*design::motor_model(order.subject.sheet),
                                        {.mode = Mode::position, .voltage_V = bus_V});
    ASSERT_TRUE(d);
    const study::Scenario s = design_scenario(*d, order.subject);
    const double h = 1000 * base::pi / 180, a = d->torque_limit_Nm / d->motor.shaft.J_kg_m2;
    const double top = bus_V / d->motor.K_t_Nm_A;
    double least = 0.0;  // integrated in steps of 1 us over the first half of the move, and doubled
    for (double x = 0.0, dt = 1e-6; x < h / 2; least += 2 * dt) x += std::min(a * least / 2, top) * dt;
    EXPECT_NEAR(s.compare.front().value, least, 2e-3 * least) << bus_V;
  }
}

/// A move of two turns accelerates the rotor to 167 rad/s. If the sheet limits the speed to 130 rad/s, the
/// loop keeps the speed below 130 rad/s.
TEST(DesignedMove, IsNoFasterThanTheSheetAllows) {
  for (const double most_rad_s : {0.0, 130.0}) {
    DesignOrder order = on_a_board(Mode::position);
    if (most_rad_s > 0.0)
      order.subject.sheet.max_speed_rpm = base::Quantity{.value = most_rad_s * base::rpm_per_rad_s};
    order.subject.step = 720;
    const auto study = study_design(order);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    double fastest = 0.0;
    for (const study::ComparisonResult& c : study->outcome.comparisons)
      if (c.figure == "peak speed") fastest = c.measured;
    if (most_rad_s > 0.0)
      EXPECT_LT(fastest, most_rad_s);
    else
      EXPECT_GT(fastest, 130.0);
  }
}

/// A position run is required to have no overshoot and to rest at the target. Without these requirements, the
/// export of the design is refused.
TEST(DesignedMove, IsRequiredToRest) {
  DesignOrder order = on_a_board(Mode::position);
  const auto d = design::design_drive(*design::motor_model(order.subject.sheet), order.spec);
  ASSERT_TRUE(d);
  const study::Scenario s = design_scenario(*d, order.subject);
  ASSERT_EQ(s.require.size(), 2u);
  EXPECT_EQ(s.require[1].measure.label, swing_at_target);
  EXPECT_DOUBLE_EQ(*s.require[1].max, 100.0);
}

TEST(DesignedSpeed, BeyondTheBusIsRefusedByName) {
  DesignOrder order = on_a_board(Mode::speed);
  const design::MotorModel motor = *design::motor_model(order.subject.sheet);
  order.spec.lowest_speed_rad_s = 1.01 * motor.nominal_voltage_V / motor.K_t_Nm_A;
  const auto study = study_design(order);
  ASSERT_FALSE(study);
  EXPECT_EQ(study.problems().front().where, "lowest_speed_rad_s");
}

/// At full torque T_max, a step of the speed by w takes J w/T_max. With a flywheel, the default settling time
/// and the run time are longer than this time.
TEST(DesignedSpeed, OfAFlywheelIsUsableAndHeldUpByItsTorque) {
  DesignOrder order = on_a_board(Mode::speed);
  order.spec.load_inertia_kg_m2 = 1e-3;
  const auto usual = study_design(order);
  ASSERT_TRUE(usual) << to_string(usual.problems().front());
  EXPECT_TRUE(usual->usable()) << usual->warnings.front().what;
  const double soonest = 1.0135e-3 * 35.5 / 0.195;
  EXPECT_GT(*usual->design.spec.settle_s, soonest);
  for (const design::Warning& w : usual->warnings) EXPECT_NE(w.of, design::Concern::settling) << w.what;
  // If the requested settling time is too short, the run is still long enough to show the actual settling
  // time. The advice is a slower loop.
  order.spec.settle_s = 0.037;
  order.advises = true;
  const auto hasty = study_design(order);
  ASSERT_TRUE(hasty) << to_string(hasty.problems().front());
  EXPECT_TRUE(hasty->usable()) << hasty->warnings.front().what;
  const auto late = std::find_if(hasty->warnings.begin(), hasty->warnings.end(),
                                 [](const auto& w) { return w.of == design::Concern::settling; });
  ASSERT_NE(late, hasty->warnings.end());
  EXPECT_EQ(late->what.rfind("in the simulation the loop settles in ", 0), 0u) << late->what;
  EXPECT_NE(late->cure.find("settle_s = 0.28"), std::string::npos) << late->cure;
}

/// In the test run, the speed falls exactly to the lowest speed, for any lowest speed below the top speed.
TEST(DesignedSpeed, IsTriedDownToTheLowestSpeedAndNoFurther) {
  for (const double lowest_rad_s : {71.0, 300.0, 420.0, 450.0}) {
    DesignOrder order = on_a_board(Mode::speed);
    order.spec.lowest_speed_rad_s = lowest_rad_s;
    const auto study = study_design(order);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    const std::vector<double>& levels = study->scenario.reference.values;
    EXPECT_DOUBLE_EQ(levels.back(), lowest_rad_s);
    EXPECT_GE(levels.front(), 1.2 * lowest_rad_s);
    EXPECT_LE(levels.front(), 0.9 * (24 - 1.03 * 2.33 / 2) / 0.0335 * (1 + 1e-12));
    EXPECT_TRUE(study->usable()) << study->warnings.front().what;
  }
}

/// The converter's range contains the step and its overshoot, for any size of the step.
TEST(DesignedCurrent, HasAConverterAsWideAsItsStep) {
  for (const double step_A : {1.0, 8.0, -8.0, 15.0}) {
    DesignOrder order = on_a_board(Mode::current);
    order.subject.step = step_A;
    const auto study = study_design(order);
    ASSERT_TRUE(study) << to_string(study.problems().front());
    double overshoot_A = 0;
    for (const study::ComparisonResult& c : study->outcome.comparisons)
      if (c.figure == "overshoot") overshoot_A = c.measured;
    EXPECT_GE(*study->scenario.sensors.current_range_A, std::fabs(step_A) + overshoot_A);
  }
}

TEST(Advice, OffersABusAboveTheSheetsOnlyWhereNothingElseHelps) {
  int slower = 0;
  for (const double times : {3.0, 4.0, 6.0}) {
    DesignOrder order = on_a_board(Mode::speed);
    order.advises = true;
    order.spec.rotor.hall = false;
    order.spec.chopping = control::Chopping::complementary;
    order.spec.settle_s = 5e-3;
    order.subject.sheet.inductance_mH->value *= times;
    const auto study = study_design(order);
    ASSERT_TRUE(study);
    const auto asks = std::find_if(study->warnings.begin(), study->warnings.end(),
                                   [](const design::Warning& w) { return w.of == design::Concern::voltage; });
    ASSERT_NE(asks, study->warnings.end()) << times;
    EXPECT_EQ(asks->cure.find("voltage_V"), std::string::npos) << asks->cure;
    slower += asks->cure.find("settle_s") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(slower, 1);
}

/// Pole placement gives a positive gain d1 if 2 x 4.6/T_reg exceeds R/L (settling time T_reg, resistance R,
/// inductance L).
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

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Two bounds allow for the time of commutation: the tolerances of a sheet's speeds, and the speed of a
// design's test. Both bounds are checked with the simulated motor.
#include <gtest/gtest.h>

#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/operating_limits.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using base::Quantity;
using design::RelationVerdict;
using design::Sheet;

/// The sheet of a 24 V motor. The tests compute its nominal point later from the curve.
Sheet motor(design::BackEmfShape shape, double L_mH, int pole_pairs, double idle_mA) {
  Sheet s;
  s.name = "simulated";
  s.back_emf = shape;
  s.pole_pairs = pole_pairs;
  s.nominal_voltage_V = {24, "", ""};
  s.resistance_ohm = {1.5, "terminal", ""};
  s.inductance_mH = {L_mH, "terminal", ""};
  s.torque_constant_mNm_A = {35, "terminal", ""};
  s.inertia_gcm2 = {24, "", ""};
  s.no_load_current_mA = {idle_mA, "", ""};
  s.nominal_torque_mNm = {62.5, "", ""};
  return s;
}

RelationVerdict verdict(const Sheet& sheet, const std::string& name) {
  const base::Result<design::SheetCheck> check = design::check_sheet(sheet);
  EXPECT_TRUE(check) << base::to_string(check.problems()[0]);
  for (const design::Relation& r : check->relations)
    if (r.name == name) return r.verdict;
  ADD_FAILURE() << name;
  return RelationVerdict::broken;
}

/// The same sheet with the points that the simulation of the cold motor gives.
Sheet with_its_points(Sheet s) {
  analysis::CurveRequest r{.sheet = s, .points = 2};
  r.bench.motor = *design::motor_model(s);
  r.bench.voltage_V = 24.0;
  const base::Result<analysis::CurvePlan> plan = analysis::plan_curve(r);
  EXPECT_TRUE(plan) << base::to_string(plan.problems()[0]);
  std::vector<analysis::OperatingPoint> points;
  for (const double w : plan->speeds_rad_s) points.push_back(*analysis::operating_point(r.bench, w));
  const base::Result<analysis::Curve> curve =
      analysis::curve_of(r, *plan, points, analysis::one_after_the_other);
  EXPECT_TRUE(curve) << base::to_string(curve.problems()[0]);
  const analysis::OperatingPoint &idle = curve->no_load.point, &nominal = *curve->nominal->at_torque;
  s.no_load_speed_rpm = Quantity{idle.speed_rad_s * base::rpm_per_rad_s, "", ""};
  s.no_load_current_mA = Quantity{1e3 * idle.winding_current_A, "", ""};
  s.nominal_speed_rpm = Quantity{nominal.speed_rad_s * base::rpm_per_rad_s, "", ""};
  return s;
}

TEST(SheetOfCurve, TheSimulatedMotorsPointsHold) {
  struct Case {
    double L_mH;
    int pole_pairs;
    double idle_mA;
  };
  for (const auto shape : {design::BackEmfShape::trapezoid, design::BackEmfShape::sine})
    for (const Case& c :
         {Case{0.5, 4, 300}, Case{2.1, 4, 300}, Case{2.1, 8, 100}, Case{2.1, 4, 800}, Case{8.4, 4, 300}}) {
      const Sheet s = with_its_points(motor(shape, c.L_mH, c.pole_pairs, c.idle_mA));
      EXPECT_EQ(verdict(s, "no-load speed"), RelationVerdict::holds) << c.L_mH << " " << c.idle_mA;
      EXPECT_EQ(verdict(s, "nominal speed"), RelationVerdict::holds) << c.L_mH << " " << c.idle_mA;
      Sheet silent = s;
      silent.no_load_speed_rpm.reset();
      EXPECT_EQ(verdict(silent, "nominal speed"), RelationVerdict::holds) << c.L_mH << " " << c.idle_mA;
      // Commutation only lowers the speed, so a no-load speed above the ideal line contradicts the data
      // sheet's other values.
      Sheet fast = s;
      fast.no_load_speed_rpm->value =
          1.05 * (24 - 1.5e-3 * s.no_load_current_mA->value) / 35e-3 * base::rpm_per_rad_s;
      EXPECT_EQ(verdict(fast, "no-load speed"), RelationVerdict::broken) << c.L_mH << " " << c.idle_mA;
    }
}

TEST(SheetOfCurve, TheMarginBelowTheLineIsThatOfTheCommutations) {
  Sheet s = with_its_points(motor(design::BackEmfShape::trapezoid, 2.1, 4, 300));
  s.no_load_speed_rpm->value *= 0.98;
  EXPECT_EQ(verdict(s, "no-load speed"), RelationVerdict::broken);
  s.nominal_speed_rpm->value *= 0.5;
  EXPECT_EQ(verdict(s, "nominal speed"), RelationVerdict::doubted);
}

/// At the top speed of a speed loop's test, enough torque remains for the test's load, even if the torque
/// constant is 8 % larger.
TEST(SheetOfCurve, TheTestSpeedIsReachedAgainstItsLoad) {
  for (const double L_mH : {0.5, 2.1, 8.4}) {
    Sheet s = motor(design::BackEmfShape::trapezoid, L_mH, 4, 300);
    s.nominal_current_A = {1.79, "terminal", ""};
    const design::MotorModel nominal = *design::motor_model(s);
    const design::TestSpeeds t = design::test_speeds(nominal, 24.0, 1.0);
    s.torque_constant_mNm_A->value *= 1.08;
    analysis::Bench b;
    b.motor = *design::motor_model(s);
    b.voltage_V = 24.0;
    const base::Result<analysis::OperatingPoint> top = analysis::operating_point(b, t.top_rad_s);
    ASSERT_TRUE(top) << base::to_string(top.problems()[0]);
    EXPECT_GT(top->shaft_torque_Nm, nominal.K_t_Nm_A * t.load_A) << L_mH;
    EXPECT_GT(t.top_rad_s, 1.2 * t.most_lowest_rad_s);
    EXPECT_GT(t.most_lowest_rad_s, 0.0);
  }
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Tests the points of a curve, the quantities at each point, and the winding's thermal limits.
#include "sixstep/analysis/curve/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bench.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Curve;
using analysis::CurvePlan;
using analysis::CurveRequest;

CurveRequest request(int points) {
  return {.sheet = curve_sheet(), .bench = maxon_bench(), .points = points};
}

Curve whole(const CurveRequest& r) {
  const base::Result<CurvePlan> plan = analysis::plan_curve(r);
  EXPECT_TRUE(plan) << base::to_string(plan.problems()[0]);
  std::vector<analysis::OperatingPoint> found;
  for (const double speed : plan->speeds_rad_s) found.push_back(*analysis::operating_point(r.bench, speed));
  const base::Result<Curve> curve = analysis::curve_of(r, *plan, found, analysis::one_after_the_other);
  EXPECT_TRUE(curve) << base::to_string(curve.problems()[0]);
  return *curve;
}

TEST(Curve, GoesFromStandstillToNoLoadInEqualSteps) {
  const Curve curve = whole(request(9));
  ASSERT_EQ(curve.points.size(), 9u);
  const double end = curve.no_load.point.speed_rad_s;
  for (std::size_t n = 0; n < 9; ++n)
    EXPECT_NEAR(curve.points[n].speed_rad_s, static_cast<double>(n) * end / 8, 4 * eps * end);
  for (std::size_t n = 1; n < 9; ++n)
    EXPECT_LT(curve.points[n].shaft_torque_Nm, curve.points[n - 1].shaft_torque_Nm);
  EXPECT_EQ(curve.limits.size(), 9u);
  EXPECT_EQ(curve.warming.size(), 9u);
}

TEST(Curve, ComparesTheNominalPointAtItsTorque) {
  const Curve curve = whole(request(3));
  ASSERT_TRUE(curve.nominal && curve.nominal->at_torque && curve.nominal->at_speed);
  EXPECT_NEAR(*curve.nominal->speed_rad_s, 5240 * base::pi / 30, 1e-12);
  EXPECT_NEAR(*curve.nominal->torque_Nm, 83.4e-3, 1e-17);
  EXPECT_EQ(*curve.nominal->current_A, 2.33);
  EXPECT_EQ(curve.nominal->at_speed->speed_rad_s, *curve.nominal->speed_rad_s);
  EXPECT_NEAR(curve.nominal->at_torque->shaft_torque_Nm, 83.4e-3, 1e-12);
  // Curve and sheet differ. At the nominal speed, the torque of the curve is 12 % lower. At the nominal
  // torque, the speed of the curve is 3.5 % lower.
  const double slower = curve.nominal->at_torque->speed_rad_s / *curve.nominal->speed_rad_s - 1;
  EXPECT_LT(curve.nominal->at_speed->shaft_torque_Nm, 0.89 * 83.4e-3);
  EXPECT_GT(slower, -0.04);
  EXPECT_LT(slower, 0.0);
  CurveRequest silent = request(3);
  silent.sheet.nominal_speed_rpm.reset();
  EXPECT_FALSE(whole(silent).nominal->at_speed);
  silent.sheet.nominal_torque_mNm.reset();
  EXPECT_FALSE(whole(silent).nominal);
  CurveRequest weak = request(3);
  weak.sheet.nominal_torque_mNm->value = 800;
  EXPECT_FALSE(whole(weak).nominal->at_torque) << "beyond stall";
}

TEST(Curve, TellsTheSheetsGradientFromItsTwoPoints) {
  CurveRequest r = request(3);
  r.sheet.no_load_speed_rpm = base::Quantity{6710, "", ""};
  r.sheet.speed_torque_gradient_rpm_mNm = base::Quantity{8.8, "", ""};
  const Curve curve = whole(r);
  const analysis::SpeedDrop d = analysis::speed_drop(r, curve);
  const double per_mNm = base::pi / 30 * 1e3;
  EXPECT_NEAR(d.ideal, 1.03 / (0.0335 * 0.0335), 1e-9);
  EXPECT_NEAR(*d.printed, 8.8 * per_mNm, 1e-9);
  EXPECT_NEAR(*d.sheet, (6710 - 5240) / 83.4 * per_mNm, 1e-9);
  // Commutation lowers the speed under load. Therefore the gradient of speed over torque exceeds twice the
  // ideal gradient, both in the sheet and in the simulation.
  EXPECT_GT(*d.curve, 2 * d.ideal);
  EXPECT_NEAR(*d.curve, *d.sheet, 0.15 * *d.sheet);
}

TEST(Curve, TheBestEfficiencyIsAMaximumWhateverPointsAreShown) {
  const CurveRequest r = request(3);
  const analysis::OperatingPoint best = *whole(r).marks.best_efficiency;
  EXPECT_EQ(best.speed_rad_s, whole(request(41)).marks.best_efficiency->speed_rad_s);
  for (const analysis::OperatingPoint& p : whole(request(41)).points)
    EXPECT_LE(p.efficiency.value_or(0.0), *best.efficiency);
  for (const double beside : {0.999, 1.001}) {
    const auto p = analysis::operating_point(r.bench, beside * best.speed_rad_s);
    EXPECT_LT(*p->efficiency, *best.efficiency);
    EXPECT_GT(*p->efficiency, *best.efficiency - 1e-4);
  }
}

TEST(Curve, ForEverBeginsWhereTheWindingComesToItsLimit) {
  const CurveRequest r = request(3);
  const Curve curve = whole(r);
  ASSERT_TRUE(curve.marks.for_ever);
  const analysis::OperatingPoint& from = *curve.marks.for_ever;
  EXPECT_NEAR(design::steady_temperatures(*curve.thermal, {from.copper_W, from.friction_W, 25})->winding_degC,
              125, 1e-5);
  EXPECT_EQ(from.speed_rad_s, whole(request(41)).marks.for_ever->speed_rad_s);
  CurveRequest hot = request(3);
  hot.ambient_degC = 120;
  EXPECT_FALSE(whole(hot).marks.for_ever) << "friction alone takes it beyond";
  CurveRequest cooled = request(3);
  cooled.sheet.thermal_resistance_housing_ambient_K_W->value = 1e-3;
  cooled.sheet.thermal_resistance_winding_housing_K_W->value = 1e-3;
  EXPECT_EQ(whole(cooled).marks.for_ever->speed_rad_s, 0.0);
}

TEST(Curve, MarksOfAChoppedOneLieWithinItsPrecision) {
  CurveRequest r = request(3);
  r.bench.duty = 0.6;
  r.bench.chopping = control::Chopping::complementary;
  const Curve curve = whole(r);
  ASSERT_TRUE(curve.marks.best_efficiency && curve.marks.nominal);
  const double whole_rad_s = curve.no_load.point.speed_rad_s;
  const analysis::OperatingPoint& nominal = *curve.marks.nominal;
  const double steepest = curve.points.front().shaft_torque_Nm / whole_rad_s * 2;
  EXPECT_NEAR(nominal.shaft_torque_Nm, 83.4e-3, nominal.half_width_Nm + steepest * 1e-4 * whole_rad_s);
  for (const double beside : {0.97, 1.03})
    EXPECT_LT(
        *analysis::operating_point(r.bench, beside * curve.marks.best_efficiency->speed_rad_s)->efficiency,
        *curve.marks.best_efficiency->efficiency);
}

/// Friction only consumes power, so efficiency and no-load speed are higher without friction.
TEST(Curve, WithoutFrictionSaysThatItsFiguresAreUpperBounds) {
  const CurveRequest with = request(3);
  CurveRequest without = request(3);
  without.bench.motor.shaft.B_Nm_s = without.bench.motor.shaft.coulomb_Nm = 0.0;
  EXPECT_EQ(analysis::without_friction(with), "");
  EXPECT_NE(analysis::without_friction(without).find("upper bounds"), std::string::npos);
  const Curve a = whole(with), b = whole(without);
  EXPECT_GT(*b.marks.best_efficiency->efficiency, *a.marks.best_efficiency->efficiency);
  EXPECT_GT(b.no_load.point.speed_rad_s, a.no_load.point.speed_rad_s);
}

TEST(Curve, WithoutThermalLinesSaysWhatIsMissing) {
  CurveRequest r = request(3);
  r.sheet.thermal_time_constant_motor_s.reset();
  const Curve curve = whole(r);
  EXPECT_FALSE(curve.thermal);
  EXPECT_TRUE(curve.limits.empty());
  ASSERT_EQ(curve.thermal_missing.size(), 1u);
  EXPECT_EQ(curve.thermal_missing[0].where, "thermal_time_constant_motor_s");
}

TEST(Curve, ContinuousTorqueWarmsTheWindingToItsLimit) {
  for (const double coulomb : {0.0, 2.46e-3}) {
    CurveRequest r = request(3);
    r.bench.motor.shaft.coulomb_Nm = coulomb;
    r.ambient_degC = 40;
    const design::ThermalModel model = *design::thermal_model(r.sheet);
    double before = 1e9;
    for (const double speed : {0.0, 300.0, 700.0}) {
      const analysis::ThermalLimits limits = analysis::thermal_limits(model, r, speed);
      const double friction = plant::friction_Nm(r.bench.motor.shaft, speed);
      const design::Heating heating{limits.continuous_A * limits.continuous_A * 1.03, friction * speed, 40};
      EXPECT_NEAR(design::steady_temperatures(model, heating)->winding_degC, 125, 1e-10) << speed;
      // K_t at the housing's temperature is lower by 0.12 % for each kelvin above 25 degC.
      const double housing = design::steady_temperatures(model, heating)->housing_degC;
      const double K_t = 0.0335 * (1 - 0.0012 * (housing - 25));
      EXPECT_NEAR(limits.continuous_Nm, K_t * limits.continuous_A - friction, 1e-14);
      EXPECT_LT(limits.continuous_Nm, before);
      for (std::size_t n = 0; n < analysis::short_times_s.size(); ++n) {
        const design::Heating brief{limits.short_A[n] * limits.short_A[n] * 1.03, friction * speed, 40};
        const double t = analysis::short_times_s[n];
        EXPECT_NEAR(design::temperatures_after(model, brief, {40, 40}, t).winding_degC, 125, 1e-10);
      }
      EXPECT_GT(limits.short_Nm[0], limits.short_Nm[1]);
      EXPECT_GT(limits.short_Nm[1], limits.continuous_Nm);
      before = limits.continuous_Nm;
    }
  }
}

/// The sheet states ranges, and the limits use the worse end of each range. The test computes the winding's
/// temperature for these worse values. The allowed current heats the winding exactly to its limit. The
/// current computed from the sheet's plain values heats it beyond the limit.
TEST(Curve, WhatTheWindingStandsIsToldOfBothEndsOfARange) {
  CurveRequest r = request(3);
  r.sheet.thermal_time_constant_winding_s->range = base::Interval{11.7, 17.7};
  r.sheet.thermal_resistance_winding_housing_K_W->range = base::Interval{4.5, 5.3};
  const Curve curve = whole(r);
  ASSERT_TRUE(curve.thermal && curve.by_values);
  const design::ThermalModel& worse = *curve.thermal;
  EXPECT_EQ(worse.winding_s, 11.7);
  EXPECT_EQ(worse.winding_housing_K_W, 5.3);
  EXPECT_EQ(worse.motor_s, curve.by_values->motor_s);
  const analysis::ThermalLimits by_values = analysis::thermal_limits(*curve.by_values, r, 0.0),
                                at_worst = analysis::thermal_limits(worse, r, 0.0);
  const auto winding = [&](double current, double seconds) {
    return design::temperatures_after(worse, {current * current * 1.03, 0.0, 25}, {25, 25}, seconds)
        .winding_degC;
  };
  for (std::size_t n = 0; n < analysis::short_times_s.size(); ++n) {
    EXPECT_NEAR(winding(at_worst.short_A[n], analysis::short_times_s[n]), 125, 1e-9);
    EXPECT_GT(winding(by_values.short_A[n], analysis::short_times_s[n]), 126);
  }
  EXPECT_LT(at_worst.continuous_A, by_values.continuous_A);
}

/// A second check: a file without ranges, whose values are the worse ends of the ranges, gives the same
/// limits, times and mark.
TEST(Curve, LimitsOfRangesAreThoseOfAFileWithTheirWorseEnds) {
  CurveRequest ranged = request(3), plain = request(3);
  ranged.sheet.thermal_time_constant_winding_s->range = base::Interval{11.7, 17.7};
  ranged.sheet.thermal_resistance_winding_housing_K_W->range = base::Interval{4.5, 5.3};
  plain.sheet.thermal_time_constant_winding_s->value = 11.7;
  plain.sheet.thermal_resistance_winding_housing_K_W->value = 5.3;
  const Curve a = whole(ranged), b = whole(plain);
  ASSERT_TRUE(a.marks.for_ever && b.marks.for_ever && a.by_values && !b.by_values);
  EXPECT_EQ(a.marks.for_ever->speed_rad_s, b.marks.for_ever->speed_rad_s);
  EXPECT_GT(a.marks.for_ever->speed_rad_s, whole(request(3)).marks.for_ever->speed_rad_s);
  for (std::size_t n = 0; n < a.points.size(); ++n) {
    EXPECT_EQ(a.limits[n].continuous_Nm, b.limits[n].continuous_Nm);
    EXPECT_EQ(a.limits[n].short_Nm, b.limits[n].short_Nm);
    EXPECT_EQ(a.warming[n].permissible_s, b.warming[n].permissible_s);
  }
}

/// No torque is allowed if ambient temperature or friction alone heats the winding beyond its limit.
TEST(Curve, InHotAirTheWindingStandsNothing) {
  CurveRequest r = request(3);
  r.ambient_degC = 130;
  const design::ThermalModel model = *design::thermal_model(r.sheet);
  const analysis::ThermalLimits still = analysis::thermal_limits(model, r, 0.0);
  EXPECT_TRUE(std::isnan(still.continuous_A) && std::isnan(still.short_Nm[0]));
  r.ambient_degC = 120;
  EXPECT_GT(analysis::thermal_limits(model, r, 0.0).continuous_Nm, 0.0);
  // The friction of 7.3e-6 N m s at 700 rad/s dissipates 3.6 W, which heats the motor by 15 K through 4.25
  // K/W.
  EXPECT_TRUE(std::isnan(analysis::thermal_limits(model, r, 700.0).continuous_Nm));
}

TEST(Curve, AWarmMotorTurnsFasterAndPullsLess) {
  const CurveRequest cold = request(3);
  CurveRequest warm = cold;
  warm.motor_degC = {.winding_degC = 125, .housing_degC = 75};
  warm.bench.motor = design::warmed(cold.bench.motor, cold.sheet, warm.motor_degC);
  const double on_R = 1.393, on_K = 0.94;
  EXPECT_NEAR(analysis::ideal_torque_Nm(warm.bench, 0),
              analysis::ideal_torque_Nm(cold.bench, 0) * on_K / on_R, 1e-15);
  const Curve here = whole(warm), there = whole(cold);
  EXPECT_NEAR(here.points.front().shaft_torque_Nm / there.points.front().shaft_torque_Nm, on_K / on_R, 1e-9);
  EXPECT_GT(here.no_load.point.speed_rad_s, there.no_load.point.speed_rad_s / on_K * 0.98);
  // The thermal limits are properties of the motor and do not depend on the curve's temperature.
  const analysis::ThermalLimits a = analysis::thermal_limits(*here.thermal, warm, 300),
                                b = analysis::thermal_limits(*there.thermal, cold, 300);
  EXPECT_NEAR(a.continuous_A, b.continuous_A, 1e-12);
  EXPECT_NEAR(a.continuous_Nm, b.continuous_Nm, 1e-14);
  EXPECT_NEAR(a.short_Nm[0], b.short_Nm[0], 1e-14);
  // The permissible time depends on the point's current, the resistance of the cold winding and the ambient
  // temperature.
  const analysis::OperatingPoint& p = here.points.front();
  const design::Heating heating{p.winding_current_A * p.winding_current_A * 1.03, 0, 25};
  EXPECT_NEAR(*here.warming.front().permissible_s, *design::permissible_seconds(*here.thermal, heating),
              1e-6);
}

TEST(Curve, APointHeldTooLongOverheats) {
  const Curve curve = whole(request(5));
  // At the stall current, 559 W heat the winding's 3.7 J/K to the limit within a second. At no load, the
  // winding never reaches the limit.
  ASSERT_TRUE(curve.warming.front().permissible_s);
  EXPECT_FALSE(curve.warming.front().winding_degC) << "copper runs away above 1/(a R)";
  EXPECT_LT(*curve.warming.front().permissible_s, 1.0);
  EXPECT_FALSE(curve.warming.back().permissible_s);
  EXPECT_GT(*curve.warming.back().winding_degC, 25);
  const analysis::OperatingPoint& p = curve.points[1];
  const design::Heating heating{p.copper_W, p.friction_W, 25};
  EXPECT_NEAR(design::temperatures_after(*curve.thermal, heating, {25, 25}, *curve.warming[1].permissible_s)
                  .winding_degC,
              125, 1e-9);
}

TEST(Curve, RefusesWhatMakesNone) {
  const auto refused = [](auto&& change, const char* text) {
    CurveRequest r = request(3);
    change(r);
    const base::Result<CurvePlan> plan = analysis::plan_curve(r);
    ASSERT_FALSE(plan);
    EXPECT_EQ(base::to_string(plan.problems()[0]).rfind(text, 0), 0u) << base::to_string(plan.problems()[0]);
  };
  refused([](CurveRequest& r) { r.points = 1; }, "points = 1 must be at least 2");
  refused([](CurveRequest& r) { r.bench.duty = -0.5; }, "duty = -0.5 must be in (0, 1]");
  refused([](CurveRequest& r) { r.ambient_degC = -300; }, "ambient_degC = -300");
  refused([](CurveRequest& r) { r.motor_degC.winding_degC = 600; }, "winding_degC = 600");
  const auto boil = [](CurveRequest& r) {
    r.sheet.magnet_loss_percent_K = 1;
    r.motor_degC.housing_degC = 120;
  };
  refused(boil, "housing_degC = 120 leaves the magnets");
  refused([](CurveRequest& r) { r.bench.voltage_V = 0; }, "voltage_V = 0 must be above 0");
  refused([](CurveRequest& r) { r.bench.motor.shaft.coulomb_Nm = 9; }, "duty = 1 gives less torque than");
}

TEST(IdealLine, EndsAtZeroWhereTheCurrentCannotTurnBack) {
  analysis::Bench b = maxon_bench();
  b.duty = 0.5;
  EXPECT_NEAR(analysis::ideal_no_load_rad_s(b), 12 / 0.0335, 1e-12);
  EXPECT_EQ(analysis::ideal_torque_Nm(b, 500), 0.0);
  b.chopping = control::Chopping::complementary;
  EXPECT_NEAR(analysis::ideal_torque_Nm(b, 500), 0.0335 * (12 - 0.0335 * 500) / 1.03, 1e-15);
  b.chopping = control::Chopping::hard;
  EXPECT_EQ(analysis::ideal_torque_Nm(b, 0), 0.0);
  b.duty = 0.75;
  EXPECT_NEAR(analysis::ideal_torque_Nm(b, 0), 0.0335 * 12 / 1.03, 1e-15);
}

}  // namespace SIXSTEP_TEST_FILE

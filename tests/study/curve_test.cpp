// SPDX-License-Identifier: Apache-2.0
// Where the curve's points lie, what belongs to them, and what the winding stands.
#include "sixstep/study/curve/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bench.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using study::Curve;
using study::CurvePlan;
using study::CurveRequest;

CurveRequest request(int points) {
  return {.sheet = curve_sheet(), .bench = maxon_bench(), .points = points};
}

Curve whole(const CurveRequest& r) {
  const base::Result<CurvePlan> plan = study::plan_curve(r);
  EXPECT_TRUE(plan) << base::to_string(plan.problems()[0]);
  std::vector<study::OperatingPoint> found;
  for (const double speed : plan->speeds_rad_s) found.push_back(*study::operating_point(r.bench, speed));
  return study::curve_of(r, *plan, found);
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

TEST(Curve, MarksTheSheetsNominalPoint) {
  const Curve curve = whole(request(3));
  ASSERT_TRUE(curve.nominal);
  EXPECT_NEAR(curve.nominal->speed_rad_s, 5240 * base::pi / 30, 1e-12);
  EXPECT_NEAR(*curve.nominal->torque_Nm, 83.4e-3, 1e-17);
  EXPECT_EQ(*curve.nominal->current_A, 2.33);
  EXPECT_EQ(curve.nominal->on_curve.speed_rad_s, curve.nominal->speed_rad_s);
  CurveRequest silent = request(3);
  silent.sheet.nominal_speed_rpm.reset();
  EXPECT_FALSE(whole(silent).nominal);
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
      const study::ThermalLimits limits = study::thermal_limits(model, r, speed);
      const double friction = study::friction_Nm(r.bench.motor.shaft, speed);
      const design::Heating heating{limits.continuous_A * limits.continuous_A * 1.03, friction * speed, 40};
      EXPECT_NEAR(design::steady_temperatures(model, heating)->winding_degC, 125, 1e-10) << speed;
      EXPECT_NEAR(limits.continuous_Nm, 0.0335 * limits.continuous_A - friction, 1e-15);
      EXPECT_LT(limits.continuous_Nm, before);
      for (std::size_t n = 0; n < study::short_times_s.size(); ++n) {
        const design::Heating brief{limits.short_A[n] * limits.short_A[n] * 1.03, friction * speed, 40};
        const double t = study::short_times_s[n];
        EXPECT_NEAR(design::temperatures_after(model, brief, {40, 40}, t).winding_degC, 125, 1e-10);
      }
      EXPECT_GT(limits.short_Nm[0], limits.short_Nm[1]);
      EXPECT_GT(limits.short_Nm[1], limits.continuous_Nm);
      before = limits.continuous_Nm;
    }
  }
}

TEST(Curve, APointHeldTooLongOverheats) {
  const Curve curve = whole(request(5));
  // Stall puts 559 W into 3.7 J/K: below a second. No load is cool for ever.
  ASSERT_TRUE(curve.warming.front().permissible_s);
  EXPECT_FALSE(curve.warming.front().winding_degC) << "copper runs away above 1/(a R)";
  EXPECT_LT(*curve.warming.front().permissible_s, 1.0);
  EXPECT_FALSE(curve.warming.back().permissible_s);
  EXPECT_GT(*curve.warming.back().winding_degC, 25);
  const study::OperatingPoint& p = curve.points[1];
  const design::Heating heating{p.copper_W, p.friction_W, 25};
  EXPECT_NEAR(design::temperatures_after(*curve.thermal, heating, {25, 25}, *curve.warming[1].permissible_s)
                  .winding_degC,
              125, 1e-9);
}

TEST(Curve, RefusesWhatMakesNone) {
  const auto refused = [](auto&& change, const char* text) {
    CurveRequest r = request(3);
    change(r);
    const base::Result<CurvePlan> plan = study::plan_curve(r);
    ASSERT_FALSE(plan);
    EXPECT_EQ(base::to_string(plan.problems()[0]).rfind(text, 0), 0u) << base::to_string(plan.problems()[0]);
  };
  refused([](CurveRequest& r) { r.points = 1; }, "points = 1 must be at least 2");
  refused([](CurveRequest& r) { r.bench.duty = -0.5; }, "duty = -0.5 must be in (0, 1]");
  refused([](CurveRequest& r) { r.ambient_degC = -300; }, "ambient_degC = -300");
  refused([](CurveRequest& r) { r.bench.voltage_V = 0; }, "voltage_V = 0 must be above 0");
  refused([](CurveRequest& r) { r.bench.motor.shaft.coulomb_Nm = 9; }, "duty = 1 gives no torque beyond");
}

TEST(IdealLine, EndsAtZeroWhereTheCurrentCannotTurnBack) {
  study::Bench b = maxon_bench();
  b.duty = 0.5;
  EXPECT_NEAR(study::ideal_no_load_rad_s(b), 12 / 0.0335, 1e-12);
  EXPECT_EQ(study::ideal_torque_Nm(b, 500), 0.0);
  b.chopping = control::Chopping::complementary;
  EXPECT_NEAR(study::ideal_torque_Nm(b, 500), 0.0335 * (12 - 0.0335 * 500) / 1.03, 1e-15);
  b.chopping = control::Chopping::hard;
  EXPECT_EQ(study::ideal_torque_Nm(b, 0), 0.0);
  b.duty = 0.75;
  EXPECT_NEAR(study::ideal_torque_Nm(b, 0), 0.0335 * 12 / 1.03, 1e-15);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// A linear motor's curve is equal to the curve of the equivalent rotary motor. Force is torque/r, and speed
// is r w, with the radius r and the angular speed w.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/analysis/curve/curve.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/linear.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::Curve;
using analysis::CurveRequest;
using analysis::OperatingPoint;

constexpr double r = unrolled_at_m;

CurveRequest request(design::Sheet sheet, double duty) {
  sheet.nominal_current_A->frame = "terminal";
  CurveRequest out{.sheet = std::move(sheet), .bench = maxon_bench(), .points = 5};
  out.bench.motor = *design::motor_model(out.sheet);
  out.bench.duty = duty;
  return out;
}

Curve whole(const CurveRequest& request) {
  const auto plan = analysis::plan_curve(request);
  EXPECT_TRUE(plan) << base::to_string(plan.problems()[0]);
  std::vector<OperatingPoint> found;
  for (const double speed : plan->speeds_rad_s)
    found.push_back(*analysis::operating_point(request.bench, speed));
  const auto curve = analysis::curve_of(request, *plan, found, analysis::one_after_the_other);
  EXPECT_TRUE(curve) << base::to_string(curve.problems()[0]);
  return *curve;
}

void expect_part(double a, double b, const char* what) {
  EXPECT_NEAR(a, b, 1e-11 * std::fabs(b) + 1e-13) << what;
}

void expect_unrolled(const OperatingPoint& moving, const OperatingPoint& turning) {
  expect_part(moving.speed_rad_s, turning.speed_rad_s * r, "speed");
  EXPECT_NEAR(moving.shaft_torque_Nm, turning.shaft_torque_Nm / r, 1e-11 / r);
  EXPECT_NEAR(moving.ripple_Nm, turning.ripple_Nm / r, 1e-11 / r);
  expect_part(moving.winding_current_A, turning.winding_current_A, "current");
  expect_part(moving.phase_rms_A, turning.phase_rms_A, "rms");
  expect_part(moving.supplied_W, turning.supplied_W, "supplied");
  expect_part(moving.copper_W, turning.copper_W, "copper");
  EXPECT_EQ(moving.efficiency.has_value(), turning.efficiency.has_value());
}

TEST(LinearCurve, IsTheTurningOnesUnrolled) {
  const CurveRequest turns = request(curve_sheet(), 1.0), moves = request(unrolled(curve_sheet()), 1.0);
  const Curve a = whole(turns), b = whole(moves);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t n = 0; n < a.points.size(); ++n) expect_unrolled(b.points[n], a.points[n]);
  ASSERT_TRUE(b.nominal && b.nominal->speed_rad_s);
  expect_part(*b.nominal->speed_rad_s, *a.nominal->speed_rad_s * r, "nominal speed");
  expect_part(*b.nominal->torque_Nm, *a.nominal->torque_Nm / r, "nominal force");
  ASSERT_TRUE(a.nominal->at_torque && b.nominal->at_torque);
  expect_unrolled(*b.nominal->at_torque, *a.nominal->at_torque);
  ASSERT_EQ(a.limits.size(), a.points.size());
  ASSERT_EQ(b.limits.size(), b.points.size());
  for (std::size_t n = 0; n < a.points.size(); ++n) {
    expect_part(b.limits[n].continuous_Nm, a.limits[n].continuous_Nm / r, "for ever");
    ASSERT_EQ(b.warming[n].winding_degC.has_value(), a.warming[n].winding_degC.has_value());
    if (a.warming[n].winding_degC)
      expect_part(*b.warming[n].winding_degC, *a.warming[n].winding_degC, "temperature");
  }
  EXPECT_TRUE(a.warming.back().winding_degC) << "without a load it comes to rest";
  expect_part(*analysis::speed_drop(moves, b).curve, *analysis::speed_drop(turns, a).curve * r * r, "drop");
}

/// A chopped point takes ten times as long to compute, so the test has only one chopped point.
TEST(LinearCurve, AChoppedPointIsTheTurningOnesUnrolled) {
  const CurveRequest turns = request(curve_sheet(), 0.5), moves = request(unrolled(curve_sheet()), 0.5);
  const double speed_rad_s = 0.2 * 0.5 * turns.bench.voltage_V / turns.bench.motor.K_t_Nm_A;
  expect_unrolled(*analysis::operating_point(moves.bench, speed_rad_s * r),
                  *analysis::operating_point(turns.bench, speed_rad_s));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// A table states the back-EMF. Its factors are compared with closed forms, with other shapes and with sums
// over the turn. Invalid tables are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/general/shape.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using namespace sixstep::testing;

struct Points {
  std::vector<double> angle, value;
};

/// The corners of a trapezoid whose top is centred at 60 degrees.
Points corners(double flat_deg) {
  Points p;
  for (const auto& [angle, value] : {std::pair{60 - flat_deg / 2, 1.0},
                                     {60 + flat_deg / 2, 1.0},
                                     {240 - flat_deg / 2, -1.0},
                                     {240 + flat_deg / 2, -1.0}}) {
    p.angle.push_back(angle);
    p.value.push_back(value);
  }
  if (p.angle[0] < 0) {  // the turn starts on the top
    std::rotate(p.angle.begin(), p.angle.begin() + 1, p.angle.end());
    std::rotate(p.value.begin(), p.value.begin() + 1, p.value.end());
    p.angle.back() += 360;
  }
  return p;
}

template <class F>
Points sampled(int count, F&& f) {
  Points p;
  for (int n = 0; n < count; ++n) {
    p.angle.push_back(360.0 * n / count);
    p.value.push_back(f(p.angle.back() / 180.0 * base::pi));
  }
  return p;
}

/// A shape whose half waves all differ.
Points crooked() { return {{10, 80, 150, 200, 260, 330}, {0.5, 1.3, 0.2, -1.0, -0.4, -0.6}}; }

/// Subtracts the mean, because the flux linkage of a winding is the same after a turn.
Points closed(Points p) {
  double mean = 0;
  for (std::size_t n = 0; n < p.angle.size(); ++n) {
    const std::size_t next = (n + 1) % p.angle.size();
    const double width = p.angle[next] - p.angle[n] + (next == 0 ? 360 : 0);
    mean += (p.value[n] + p.value[next]) / 2 * width / 360;
  }
  for (double& v : p.value) v -= mean;
  return p;
}

Sheet sheet_of(const Points& p) {
  Sheet s = printed_251601();
  s.back_emf = BackEmfShape::table;
  s.back_emf_angle_deg = p.angle;
  s.back_emf_shape = p.value;
  return s;
}

TEST(ShapeTable, OfTheTrapezoidsCornersHasTheTrapezoidsFactors) {
  for (const double flat : {30.0, 90.0, 120.0, 150.0}) {
    const Points p = corners(flat);
    const ShapeFactors table = table_factors(p.angle, p.value),
                       closed = shape_factors(BackEmfShape::trapezoid, flat);
    EXPECT_NEAR(table.sector_mean, closed.sector_mean, 1e-14) << flat;
    EXPECT_NEAR(table.line_peak, closed.line_peak, 1e-14) << flat;
    EXPECT_NEAR(table.line_rms, closed.line_rms, 1e-14) << flat;
    EXPECT_NEAR(table.phase_rms, closed.phase_rms, 1e-14) << flat;
    EXPECT_NEAR(table.fundamental, closed.fundamental, 1e-14) << flat;
    EXPECT_EQ(table.phase_peak, 1.0);
  }
}

TEST(ShapeTable, OfManySamplesApproachesWhatWasSampled) {
  // A chord differs from the curve by at most h^2/8 times the second derivative (step h). This derivative is
  // at most 1 + 25 0.1. The factors are means over the curve.
  const int count = 720;
  const double h = 2 * base::pi / count, bound = 3.5 * h * h;
  const auto f = [](double x) {
    return base::cos(x - base::pi / 3) + 0.1 * base::cos(5 * (x - base::pi / 3));
  };
  const Points p = sampled(count, f);
  const std::vector<double> orders{5}, sizes{0.1};
  const ShapeFactors table = table_factors(p.angle, p.value), closed = harmonic_factors(orders, sizes);
  EXPECT_NEAR(table.sector_mean, closed.sector_mean, bound);
  EXPECT_NEAR(table.line_peak, closed.line_peak, bound);
  EXPECT_NEAR(table.line_rms, closed.line_rms, bound);
  EXPECT_NEAR(table.phase_rms, closed.phase_rms, bound);
  EXPECT_NEAR(table.fundamental, closed.fundamental, bound);
  EXPECT_NEAR(table.phase_peak, closed.phase_peak, bound);
}

TEST(ShapeTable, WithoutSymmetryHasTheMeansOfAllSectorsAsTheKernelDoes) {
  const Points p = closed(crooked());
  const ShapeFactors f = table_factors(p.angle, p.value);
  plant::general::Machine m{.K_e_V_s = {1, 1, 1}};
  for (std::size_t n = 0; n < p.angle.size(); ++n) m.shape.table.push_back({p.angle[n], p.value[n]});
  EXPECT_NEAR(f.sector_mean, plant::general::sector_mean(m), 1e-14);
  // Midpoint sums over the turn. The error at a corner is at most the change of slope times the square of the
  // step.
  constexpr int n = 36000;
  double mean = 0, cos = 0, sin = 0, square = 0;
  const int source[] = {0, 0, 1, 1, 2, 2}, sink[] = {1, 2, 2, 0, 0, 1};
  for (int k = 0; k < n; ++k) {
    const double deg = 360.0 * (k + 0.5) / n;
    const auto at = [&](double x) { return plant::general::detail::line_at(m.shape.table, x).value; };
    const int s = static_cast<int>(deg / 60);
    mean += (at(deg - 120 * source[s]) - at(deg - 120 * sink[s])) / n;
    cos += 2 * at(deg) * base::cos(deg / 180 * base::pi) / n;
    sin += 2 * at(deg) * base::sin(deg / 180 * base::pi) / n;
    square += at(deg) * at(deg) / n;
  }
  EXPECT_NEAR(f.sector_mean, mean, 1e-7);
  EXPECT_NEAR(f.fundamental, std::sqrt(cos * cos + sin * sin), 1e-7);
  EXPECT_NEAR(f.phase_rms, std::sqrt(square), 1e-7);
}

TEST(ShapeTable, TheTorqueConstantFixesWhatTheTableIsMultipliedWith) {
  Points p = corners(120);
  for (double& v : p.value) v *= 2.5;  // volts at an unknown speed: the values are not normalised
  const auto m = motor_model(sheet_of(p));
  ASSERT_TRUE(m) << told(sheet_of(p));
  EXPECT_NEAR(m->K_e_V_s, 33.5e-3 / 5.0, 1e-17);
  EXPECT_TRUE(m->shape_is_table);
  EXPECT_EQ(m->machine.back_emf, plant::BackEmf::sine);
  EXPECT_NEAR(m->machine.K_e_V_s, 33.5e-3 / (3 * std::sqrt(3.0) / base::pi), 1e-17);
  EXPECT_EQ(m->left_to_a_run, "the back-EMF as a table");
  Sheet peak = sheet_of(p);
  peak.torque_constant_mNm_A.reset();
  peak.speed_constant_rpm_V.reset();
  peak.back_emf_constant_V_krpm = base::Quantity{2.5 * 1000 * base::pi / 30, "phase-peak", ""};
  EXPECT_NEAR(sheet_constants(peak).K_e_V_s->value, 1.0, 1e-15);
}

TEST(ShapeTable, WhatIsNoTableIsTold) {
  const auto first = [](const Sheet& s) { return told(s).substr(0, told(s).find('\n')); };
  Sheet s = sheet_of(corners(120));
  s.back_emf_shape.pop_back();
  EXPECT_NE(first(s).find("back_emf_shape = 3 values needs one value for each of the 4"), std::string::npos)
      << first(s);
  s = sheet_of({{0, 120, 120.001, 300}, {1, 1, -1, -1}});
  EXPECT_NE(first(s).find("at least 0.01 deg before the next angle"), std::string::npos) << first(s);
  s = sheet_of({{0, 120, 180, 360}, {1, 1, -1, -1}});
  EXPECT_NE(first(s).find("must lie in [0, 360)"), std::string::npos) << first(s);
  s = sheet_of({{0, 180}, {2, 2}});
  EXPECT_NE(first(s).find("has the same value at all angles"), std::string::npos) << first(s);
  s = sheet_of(corners(120));
  for (double& v : s.back_emf_shape) v += 0.1;
  EXPECT_NE(first(s).find("subtract 0.1 from every value"), std::string::npos) << first(s);
  for (double& v : s.back_emf_shape) v -= 0.0985;  // 0.75e-3 of its peak to peak: a measurement error
  EXPECT_EQ(first(s), "");
  s = sheet_of(corners(120));
  for (double& v : s.back_emf_shape) v = -v;
  EXPECT_NE(first(s).find("lies at 60 degrees"), std::string::npos) << first(s);
  s = sheet_of({});
  EXPECT_NE(first(s).find("back_emf = \"table\" has no table"), std::string::npos) << first(s);
  s.back_emf_file = "shape.csv";
  EXPECT_NE(first(s).find("has not been read"), std::string::npos) << first(s);
  s = sheet_of(corners(120));
  s.back_emf = BackEmfShape::sine;
  EXPECT_NE(first(s).find("applies to back_emf = \"table\" only"), std::string::npos) << first(s);
}

}  // namespace SIXSTEP_TEST_FILE

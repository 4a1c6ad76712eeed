// SPDX-License-Identifier: Apache-2.0
// The factors of a back-EMF are compared with the plant's shape.
#include "sixstep/design/sheet/shape_factors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/design/thesis/thesis_models.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;

constexpr double eps = 0x1p-52;

TEST(ShapeFactors, OfASineAreThoseOfTheTableOfConstants) {
  const ShapeFactors f = shape_factors(BackEmfShape::sine, 120.0);
  EXPECT_NEAR(f.sector_mean, 3.0 * std::sqrt(3.0) / base::pi, 2 * eps);
  EXPECT_EQ(f.line_peak, std::sqrt(3.0));
  EXPECT_EQ(f.line_rms, std::sqrt(1.5));
  EXPECT_EQ(f.phase_rms, std::sqrt(0.5));
  EXPECT_EQ(f.fundamental, 1.0);
}

TEST(ShapeFactors, OfTheIdealTrapezoidHaveClosedForms) {
  // The difference f_a - f_b is 2 for 60 of 180 degrees. On both sides it falls to 0 within 60 degrees. Its
  // mean square is (60 4 + 120 4/3)/180 = 20/9. The mean square of a phase is (120 + 60/3)/180 = 7/9. The
  // fundamental is 24/pi^2 sin(30 degrees).
  const ShapeFactors f = shape_factors(BackEmfShape::trapezoid, 120.0);
  EXPECT_EQ(f.sector_mean, 2.0);
  EXPECT_EQ(f.line_peak, 2.0);
  EXPECT_NEAR(f.line_rms, std::sqrt(20.0) / 3.0, 4 * eps);
  EXPECT_NEAR(f.phase_rms, std::sqrt(7.0) / 3.0, 4 * eps);
  EXPECT_NEAR(f.fundamental, 12.0 / (base::pi * base::pi), 4 * eps);
}

TEST(ShapeFactors, OfEveryWidthAreThoseOfThePlantsShape) {
  // The midpoint rule over one turn has n points. Its error at a corner is at most (slope h)^2 with h = 2
  // pi/n. For the widths in this test, the slope is below 1/(pi/360). The error of 12 corners is therefore
  // below 12 (720/pi 2 pi/n)^2/n.
  constexpr int n = 360000;
  const double slope_h = 720.0 / base::pi * 2.0 * base::pi / n, bound = 12.0 * slope_h * slope_h;
  for (const double flat : {1.0, 30.0, 59.0, 60.0, 61.0, 100.0, 120.0, 140.0, 179.0}) {
    plant::Machine m;
    m.K_e_V_s = 1.0;
    m.back_emf = plant::BackEmf::trapezoid;
    m.flat_deg = flat;
    double line = 0.0, phase = 0.0, first = 0.0, peak = 0.0;
    for (int k = 0; k < n; ++k) {
      const double theta = 2.0 * base::pi * (k + 0.5) / n;
      const base::Abc<double> f = back_emf_shape(m, {theta});
      line += (f.a - f.b) * (f.a - f.b) / n;
      phase += f.a * f.a / n;
      first += 2.0 / n * f.a * base::cos(theta - base::pi / 3.0);
      peak = std::max(peak, f.a - f.b);
    }
    const ShapeFactors f = shape_factors(BackEmfShape::trapezoid, flat);
    EXPECT_NEAR(f.line_rms * f.line_rms, line, bound) << flat;
    EXPECT_NEAR(f.phase_rms * f.phase_rms, phase, bound) << flat;
    EXPECT_NEAR(f.fundamental, first, bound) << flat;
    EXPECT_NEAR(f.line_peak, peak, slope_h) << flat;
  }
}

}  // namespace SIXSTEP_TEST_FILE

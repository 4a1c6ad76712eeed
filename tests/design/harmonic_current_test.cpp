// SPDX-License-Identifier: Apache-2.0
// The drive's shape vector is compared with closed forms for a trapezoid, for harmonics, for a table and for
// a delta connection.
#include "sixstep/design/loops/harmonic_current.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
namespace general = plant::general;

constexpr double pi = std::numbers::pi;

general::Machine machine_of(general::Shape shape, double K_e = 0.02) {
  return {.R_ohm = {0.5, 0.5, 0.5},
          .K_e_V_s = {K_e, K_e, K_e},
          .L_H = 1e-3,
          .pole_pairs = 8,
          .shape = std::move(shape)};
}

/// The end of the trapezoid's shape vector moves along a hexagon. In the middle of a sector, the vector is
/// along q, with the length of the inscribed circle's radius, 2/sqrt 3. At the end of the sector, it points
/// to a corner, with the length 4/3. At d rad from the middle, its end has moved by 4/pi d along the side.
TEST(HarmonicShape, OfTheTrapezoidIsAHexagon) {
  const double f1 = 4 / pi * 0.5 / (pi / 6);
  const auto c = harmonic_shape(machine_of({.flat_deg = 120}), 0.02 * f1);
  EXPECT_TRUE(c.on);
  EXPECT_NEAR(c.least, 2 / std::numbers::sqrt3 / f1, 1e-12);
  for (int n = 0; n < control::shape_points; ++n) {
    const double d = n <= 16 ? n * pi / 96 : (n - 32) * pi / 96;
    const double inradius = 2 / std::numbers::sqrt3, along = 4 / pi * d;
    // The q axis has turned by d, so the part along the side points d behind the d axis.
    EXPECT_NEAR(c.shape[n].q * f1, inradius * std::cos(d) + along * std::sin(d), 1e-12) << n;
    EXPECT_NEAR(c.shape[n].d * f1, inradius * std::sin(d) - along * std::cos(d), 1e-12) << n;
  }
  const HarmonicFigures f = harmonic_figures(c);
  EXPECT_NEAR(f.swing, (4.0 / 3 - 2 / std::numbers::sqrt3) / f1, 2e-4);
  EXPECT_NEAR(f.copper, f1 * f1 * std::numbers::sqrt3 * pi / 8, 2e-4);
}

/// The fundamental cos(theta - 60 degrees) gives the constant vector (0, 1). In the magnet's frame, a fifth
/// harmonic of amplitude c rotates six times per turn, backwards. A seventh harmonic rotates six times per
/// turn, forwards. A third harmonic has no effect.
TEST(HarmonicShape, OfHarmonicsIsTheirSequence) {
  const auto sine = harmonic_shape(machine_of({.harmonics = {{1, 1.0}, {3, 0.3}}}), 0.02);
  EXPECT_TRUE(is_sine(sine));
  for (const auto& g : sine.shape) {
    EXPECT_NEAR(g.d, 0.0, 1e-14);
    EXPECT_NEAR(g.q, 1.0, 1e-14);
  }
  const auto both = harmonic_shape(machine_of({.harmonics = {{1, 1.0}, {5, 0.1}, {7, 0.04}}}), 0.02);
  EXPECT_FALSE(is_sine(both));
  for (int n = 0; n < control::shape_points; ++n) {
    // The shape of phase a is a cosine of the angle, which is a quarter turn ahead of the magnet.
    const double x = n * pi / 96 + pi / 2, magnet = x - pi / 2;
    const double alpha = std::cos(x) + 0.1 * std::cos(5 * x) + 0.04 * std::cos(7 * x);
    const double beta = std::sin(x) - 0.1 * std::sin(5 * x) + 0.04 * std::sin(7 * x);
    EXPECT_NEAR(both.shape[n].d, alpha * std::cos(magnet) + beta * std::sin(magnet), 1e-13);
    EXPECT_NEAR(both.shape[n].q, beta * std::cos(magnet) - alpha * std::sin(magnet), 1e-13);
  }
}

/// A table with the corners of the trapezoid gives the trapezoid's vector. If two phases deviate from the
/// trapezoid in opposite directions, the vector is the vector of their mean.
TEST(HarmonicShape, OfATableAndOfPhasesThatStrayIsTheirMean) {
  const auto trapezoid = harmonic_shape(machine_of({.flat_deg = 120}), 0.02);
  const auto table =
      harmonic_shape(machine_of({.table = {{0, 1.0}, {120, 1.0}, {180, -1.0}, {300, -1.0}}}), 0.02);
  general::Machine stray = machine_of({.flat_deg = 120});
  stray.K_e_V_s = {0.0206, 0.02, 0.0194};
  const auto mean = harmonic_shape(stray, 0.02);
  for (int n = 0; n < control::shape_points; ++n) {
    EXPECT_NEAR(table.shape[n].d, trapezoid.shape[n].d, 1e-12);
    EXPECT_NEAR(table.shape[n].q, trapezoid.shape[n].q, 1e-12);
    EXPECT_NEAR(mean.shape[n].d, trapezoid.shape[n].d, 1e-12);
    EXPECT_NEAR(mean.shape[n].q, trapezoid.shape[n].q, 1e-12);
  }
}

/// Sine voltages in the three branches of a delta give the vector of the equivalent star. The voltages of the
/// star are smaller by the factor sqrt 3.
TEST(HarmonicShape, OfADeltaIsThatOfItsStar) {
  general::Machine m = machine_of({.harmonics = {{1, 1.0}}});
  m.winding = general::Winding::delta;
  for (const auto& g : harmonic_shape(m, 0.02).shape) {
    EXPECT_NEAR(g.d, 0.0, 1e-14);
    EXPECT_NEAR(g.q, 1 / std::numbers::sqrt3, 1e-14);
  }
}

}  // namespace SIXSTEP_TEST_FILE

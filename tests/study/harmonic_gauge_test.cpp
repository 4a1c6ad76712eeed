// SPDX-License-Identifier: Apache-2.0
// The distortion is compared with closed-form Fourier series.
#include "sixstep/study/measure/harmonic_gauge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

constexpr double eps = 0x1p-52;

/// The rotor coasts at constant speed. There is no friction, all gates are off, and the speed is too low for
/// the diodes to conduct.
Scenario coasting(design::BackEmfShape shape, double flat_deg, double speed) {
  Scenario s = maxon_scenario(Mode::off, 0.0);
  s.sheet.back_emf = shape;
  s.sheet.flat_deg = flat_deg;
  s.sheet.viscous_friction_Nm_s->value = 0.0;
  s.initial.speed_rad_s = speed;
  return s;
}

/// A trapezoid with the peak 1 and flat tops of width w. Half the width of a ramp is a. The fundamental is
/// 4/pi sin(a)/a, and the mean square is (w + 2 a/3)/pi.
double trapezoid_thd(double flat_deg) {
  const double w = flat_deg * base::pi / 180, a = (base::pi - w) / 2;
  const double fundamental = 4 / base::pi * std::sin(a) / a, square = (w + 2 * a / 3) / base::pi;
  return std::sqrt(square / (fundamental * fundamental / 2) - 1);
}

/// A fit of n rows has an error of a few roundings per row (Higham, 19.3). A run of 20 ms has fewer rows than
/// this number.
constexpr double rows = 8 * 700;

TEST(Distortion, OfASineIsNone) {
  for (const double speed : {300.0, -300.0}) {
    Scenario s = coasting(design::BackEmfShape::sine, 120.0, speed);
    for (const Signal signal : {Signal::emf_a, Signal::emf_b, Signal::line_ab, Signal::line_ca})
      ask(s, measure(MetricKind::thd, signal));
    Measure m = measure(MetricKind::thd, Signal::emf_c);
    m.frequency_Hz = 300.0 * 8 / (2 * base::pi);
    ask(s, m);
    m.frequency_Hz = *m.frequency_Hz / 3;  // at a third of the frequency, the whole signal is distortion
    ask(s, m);
    const std::vector<double> thd = figures_of(s);
    for (std::size_t n = 0; n < 5; ++n) EXPECT_LE(thd[n], rows * eps) << n << " at " << speed;
    EXPECT_GT(thd[5], 1e6);
  }
}

TEST(Distortion, OfATrapezoidIsItsSeries) {
  for (const double flat : {120.0, 90.0, 150.0}) {
    Scenario s = coasting(design::BackEmfShape::trapezoid, flat, 250.0);
    Measure m = over(MetricKind::thd, Signal::emf_b, 1.234e-3, 19e-3);
    ask(s, m);
    m.frequency_Hz = 250.0 * 8 / (2 * base::pi);
    ask(s, m);
    const std::vector<double> thd = figures_of(s);
    EXPECT_NEAR(thd[0], trapezoid_thd(flat), rows * eps) << flat;
    EXPECT_NEAR(thd[1], trapezoid_thd(flat), rows * eps) << flat;
  }
  // The third harmonics of two trapezoids of 120 degrees cancel. The line voltage has steps of 60 degrees at
  // 1, 2, 1, -1, -2, -1, with ramps between them. Its closed form is the same sum without the harmonics 3, 9,
  // 15 ...
  Scenario s = coasting(design::BackEmfShape::trapezoid, 120.0, 250.0);
  ask(s, measure(MetricKind::thd, Signal::line_ab));
  double square = 0.0;  // harmonic n of the trapezoid divided by the fundamental: sin(n a)/(sin(a) n^2), a =
                        // 30 deg
  for (int n = 5; n < 200000; n += 2)
    if (n % 3 != 0) square += std::pow(std::sin(n * base::pi / 6) / (std::sin(base::pi / 6) * n * n), 2);
  EXPECT_NEAR(figures_of(s)[0], std::sqrt(square), rows * eps);
}

TEST(Distortion, WantsAWholeTurnThatGoesOneWay) {
  Scenario s = coasting(design::BackEmfShape::sine, 120.0, 250.0);
  const double turn_s = 2 * base::pi / (250.0 * 8);
  ask(s, over(MetricKind::thd, Signal::emf_a, 1e-3, 1e-3 + 0.99 * turn_s));
  ask(s, over(MetricKind::thd, Signal::emf_a, 1e-3, 1e-3 + turn_s));
  std::vector<double> thd = figures_of(s);
  EXPECT_TRUE(std::isnan(thd[0]));
  EXPECT_LE(thd[1], rows * eps) << "lacks a rounding of a whole turn";
  s = maxon_scenario(Mode::duty, -1.0);
  s.initial.speed_rad_s = 300.0;
  s.duration_s = 60e-3;
  ask(s, measure(MetricKind::thd, Signal::phase_a));
  ask(s, over(MetricKind::thd, Signal::phase_a, 40e-3, 60e-3));
  thd = figures_of(s);
  EXPECT_TRUE(std::isnan(thd[0])) << "it turns round";
  EXPECT_GT(thd[1], 0.1) << "it has turned round";
}

}  // namespace SIXSTEP_TEST_FILE

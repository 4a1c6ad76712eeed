// SPDX-License-Identifier: Apache-2.0
// The delay of a speed from Hall edges is compared with the sensor, simulated in small time steps.
#include "sixstep/design/loops/rotor_sensing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/loop_figures.hpp"

namespace sixstep::design {
namespace SIXSTEP_TEST_FILE {

/// The sensor by its definition: at each edge, it outputs the mean over the last k sectors, and keeps this
/// output until the next edge. The edges are one sector apart. The input is a speed of 1 + sin v t. Returns
/// the component of the output at the frequency v, over whole beats of both frequencies.
std::complex<double> measured_response(int k, double sector_s, double v) {
  const int per_sector = 64, sectors = 6000;
  const double step = sector_s / per_sector;
  std::complex<double> sum{};
  for (int n = 10; n < sectors; ++n) {
    const double edge = n * sector_s, from = edge - k * sector_s;
    const double mean = (std::cos(v * from) - std::cos(v * edge)) / (v * k * sector_s);  // mean of sin v t
    for (int m = 0; m < per_sector; ++m) {
      const double t = edge + (m + 0.5) * step;
      sum += mean * std::polar(1.0, -v * t);
    }
  }
  return sum * std::complex<double>{0.0, 2.0} / static_cast<double>((sectors - 10) * per_sector);
}

TEST(SpeedLag, IsTheSensorsResponseWhereverInTheSectorATickFalls) {
  const double pole_pairs = 8, speed = 100.0, T = base::pi / 3 / (pole_pairs * speed);
  for (const int k : {1, 2, 6}) {
    const SpeedLag lag = speed_lag({.hall = true, .edges = k}, pole_pairs, speed, 0.0);
    EXPECT_NEAR(lag.delay_s(), (k + 1) / 2.0 * T, 1e-15);
    for (const double part : {0.013, 0.047, 0.11}) {  // fraction of the edges' frequency
      const double v = part * 2 * base::pi / T;
      const Complex H = lag.at(v);
      const std::complex<double> found = measured_response(k, T, v);
      // The beats are not complete, which causes an error of 1/(number of sectors).
      EXPECT_NEAR(H.re, found.real(), 2e-3) << k << " " << part;
      EXPECT_NEAR(H.im, found.imag(), 2e-3) << k << " " << part;
    }
  }
}

TEST(SpeedLag, OfAnIdealSensorIsNone) {
  const SpeedLag lag = speed_lag({.hall = false}, 8, 100.0, 500.0);
  EXPECT_EQ(lag.delay_s(), 0.0);
  EXPECT_EQ(lag.at(1e4).re, 1.0);
  EXPECT_EQ(lag.at(1e4).im, 0.0);
}

TEST(SpeedLag, OfAdaptiveEdgesIsNowhereLongerThanItSays) {
  const double pole_pairs = 8, crossover = 300.0;
  const RotorSensing adaptive{.hall = true, .edges = 0};
  const double window = hall_window_s(crossover);
  for (double low = 5.0; low < 3000.0; low *= 1.3) {
    const double said = speed_lag(adaptive, pole_pairs, low, crossover).delay_s();
    double longest = 0.0;
    for (double speed = low; speed < 20000.0; speed *= 1.001) {
      const double T = base::pi / 3 / (pole_pairs * speed);
      longest = std::fmax(longest, 6 * T <= window ? 3.5 * T : T);
    }
    EXPECT_LE(longest, said * (1 + 1e-9)) << low;
    EXPECT_GE(longest, said * 0.998) << low;
  }
  // Six edges are used up to a phase lag of pi/8 at the crossover.
  EXPECT_NEAR(3.5 / 6 * window * crossover, base::pi / 8, 1e-12);
  EXPECT_EQ(hall_window_s(0.0), 0.0);
}

TEST(SensedFigures, AreTheLoopsLessThePhaseOfTheDelay) {
  // The loop is an integrator w_c/s, sampled at a thousand times its crossover w_c. The phase margin is 90
  // degrees minus the effect of the hold.
  const double period = 1e-6, crossover = 1000.0;
  const Transfer loop{{crossover * period}, {0.0, 1.0}};
  const SpeedLag lag{0.3e-3, 0.1e-3};
  const LoopFigures bare = loop_figures(loop, period), sensed = sensed_figures({loop, lag, {}}, period);
  EXPECT_NEAR(*sensed.crossover_rad_s, crossover, 0.01 * crossover);
  EXPECT_NEAR(*bare.phase_rad - *sensed.phase_rad, *sensed.crossover_rad_s * 0.2e-3, 0.005);
  EXPECT_TRUE(sensed.stable);
  // A mean over 2 D changes the phase by v D at the frequency v and reduces the gain by sinc(v D). With this
  // mean H, the phase margin is used up at v D = pi/2 with |L H| = 1. Then v = w_c 2/pi and D = (pi/2)^2/w_c.
  // Multiples of this D must not count as stable either.
  const double D = base::pi / 2 * base::pi / 2 / crossover;
  for (const double times : {1.05, 6.0, 25.0})
    EXPECT_FALSE(sensed_figures({loop, {0.0, 2 * times * D}, {}}, period).stable) << times;
  EXPECT_TRUE(sensed_figures({loop, {0.0, 2 * 0.95 * D}, {}}, period).stable);
}

TEST(SensedFigures, OfALoopAroundASensedOneWithoutLagAreItsOwn) {
  const double period = 1e-4;
  const Transfer inner{{0.1}, {0.0, 1.0}}, outer{{0.001}, {0.0, 0.1, 1.0}};
  const LoopFigures a = loop_figures(outer, period), b = sensed_figures({outer, {}, inner}, period);
  EXPECT_NEAR(*a.phase_rad, *b.phase_rad, 1e-9);
  EXPECT_NEAR(*a.crossover_rad_s, *b.crossover_rad_s, 1e-9 * *a.crossover_rad_s);
}

TEST(SensedStep, IsTheStepOfTheLoopWithItsDelayedMean) {
  // An integrator with the gain g, whose feedback is the mean of two samples, computed by hand: y' = g (1 -
  // (y + y_before)/2).
  const double period = 1.0, g = 0.2;
  const StepResponse r = sensed_step({Transfer{{g}, {0.0, 1.0}}, {2 * period, 0.0}, {}}, period, 50.0);
  double y = 0.0, before = 0.0;
  for (std::size_t n = 0; n < 50; ++n) {
    EXPECT_NEAR(r.samples[n], y, 1e-12) << n;
    const double next = y + g * (1 - (y + before) / 2);
    before = y;
    y = next;
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::design

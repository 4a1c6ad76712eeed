// SPDX-License-Identifier: Apache-2.0
// The interpolator computes speed, position and sector from the angle between Hall edges. These values are
// compared with the closed-form motion of rotor and probes.
#include "sixstep/rig/hall_interpolator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using rig::HallAngleFrom;

constexpr double p = 8, capture_Hz = 1e6, T = 30e-6;
constexpr double own_deg[6] = {0, 3, -2, 1, -4, 2};

rig::SensorsConfig reading(HallAngleFrom from, int edges) {
  rig::SensorsConfig config;
  config.rotor_from_hall = true;
  config.hall_angle = from;
  config.edges = static_cast<std::uint8_t>(edges);
  config.commutates_by_angle = true;
  config.capture_Hz = capture_Hz;
  return config;
}

/// Whether the probes have mounting errors, the hysteresis of the probes, and the delay of their lines.
struct Probes {
  bool stray = true;
  double hysteresis_deg = 0, delay_s = 0;

  double edge_deg(int n, int direction) const {
    return 60.0 * n + (stray ? own_deg[((n % 6) + 6) % 6] : 0.0) + direction * hysteresis_deg / 2;
  }
};

struct Errors {
  double position_deg = 0, speed_rad_s = 0;  ///< largest error of mechanical angle and speed
  int samples = 0, wrong_sectors = 0;
};

/// A bench whose rotor moves by a given function theta(t), in electrical degrees, monotonic in `direction`.
/// The samples from `from_s` on are compared.
struct Bench {
  std::function<double(double)> theta_deg, w_rad_s;
  Probes probes{};
  int direction = 1;

  /// The time, in s, at which the rotor passes an angle. Bisection finds this time.
  double passes_s(double angle_deg, double end_s) const {
    double low = 0, high = end_s;
    for (int n = 0; n < 60; ++n) {
      const double middle = (low + high) / 2;
      (direction * (theta_deg(middle) - angle_deg) < 0 ? low : high) = middle;
    }
    return high;
  }

  Errors drive(rig::HallInterpolator<double>& drive, double from_s, double end_s) const {
    Errors errors;
    int n = static_cast<int>(std::floor(theta_deg(0) / 60)) + (direction > 0 ? 1 : 0);
    const auto seen_s = [&] { return passes_s(probes.edge_deg(n, direction), end_s) + probes.delay_s; };
    double next_s = seen_s();
    for (double t = T; t < end_s - probes.delay_s; t += T) {
      for (; next_s <= t; next_s = seen_s()) {
        const int sector = direction > 0 ? n : n - 1;
        drive.edge({static_cast<std::uint8_t>(((sector % 6) + 6) % 6), static_cast<std::int8_t>(direction)},
                   static_cast<std::uint32_t>(next_s * capture_Hz));
        n += direction;
      }
      control::Measurement<double> m{};
      drive.measure(m, static_cast<std::uint32_t>(t * capture_Hz));
      if (t < from_s) continue;
      ++errors.samples;
      errors.position_deg = std::max(errors.position_deg, std::fabs(m.position_deg - theta_deg(t) / p));
      errors.speed_rad_s = std::max(errors.speed_rad_s, std::fabs(m.speed_rad_s - w_rad_s(t)));
      const auto sector = static_cast<int>(std::floor(theta_deg(t) / 60));
      errors.wrong_sectors += control::sector_of_hall(m.hall) != ((sector % 6) + 6) % 6;
    }
    return errors;
  }
};

Bench steady(double w, const Probes& probes = {}) {
  const double deg_s = p * w * 180 / base::pi;
  return {[=](double t) { return 30 + deg_s * t; }, [=](double) { return w; }, probes, w > 0 ? 1 : -1};
}

rig::HallInterpolator<double> interpolator(const rig::SensorsConfig& config) {
  return {config, {}, {.pole_pairs = p, .sector = 0}};
}

/// Electrical degrees by which the rotor turns in one count of the timer.
double tick_deg(double w) { return p * std::fabs(w) * 180 / base::pi / capture_Hz; }

// The errors are counts of the timer. The angle of an edge has an error of one count at either end of the
// turn in which it was learned. The time since an edge has an error of one count. The speed is measured over
// a sector, and each end of the sector has an error of one count of time and two counts of angle.
TEST(HallInterpolator, LearnsWhereTheEdgesAreAndThenSeesTheTrueAngle) {
  for (const double w : {100.0, -100.0, 300.0}) {
    rig::SensorsConfig config = reading(HallAngleFrom::learned_edges, 6);
    auto learning = interpolator(config);
    const Errors learned = steady(w).drive(learning, 0.1, 0.2);
    ASSERT_TRUE(learning.learned());
    const double ticks = 2 + 1 + 2 * (1 + 2);
    EXPECT_LT(learned.position_deg, ticks * tick_deg(w) / p) << w;
    EXPECT_LT(learned.speed_rad_s, std::fabs(w) * 2 * (1 + 2) * tick_deg(w) / 55) << w;
    EXPECT_LE(learned.wrong_sectors, learned.samples * ticks * tick_deg(w) / 60) << w;

    // This interpolator assumes evenly spaced edges. Its angle therefore has the mounting errors of the
    // probes, and its speed is 60/55 or 60/66 of the true speed.
    auto trusting = interpolator(reading(HallAngleFrom::angle, 1));
    const Errors trusted = steady(w).drive(trusting, 0.1, 0.2);
    EXPECT_GT(trusted.position_deg, 3.9 / p);
    EXPECT_GT(trusted.speed_rad_s, 0.089 * std::fabs(w));
  }
}

// Six edges are one electrical turn. Over a turn, the mounting errors cancel.
TEST(HallInterpolator, SpeedOverSixEdgesNeedsNoPlaces) {
  auto six = interpolator(reading(HallAngleFrom::angle, 6));
  EXPECT_LT(steady(100).drive(six, 0.1, 0.2).speed_rad_s, 100 * 2 * tick_deg(100) / 360 + 100 * 0.1);
}

// Hysteresis and delay make the lines late. The interpolator adds the angle for the values of the data sheet,
// so its angle is ahead of the lines.
TEST(HallInterpolator, TakesOffHysteresisAndDelay) {
  for (const double w : {200.0, -200.0}) {
    rig::SensorsConfig config = reading(HallAngleFrom::angle, 1);
    config.hall_delay_s = 100e-6;
    config.hall_hysteresis_deg = 8;
    auto drive = interpolator(config);
    const Errors errors = steady(w, {false, 8, 100e-6}).drive(drive, 0.05, 0.15);
    EXPECT_LT(errors.position_deg, 5 * tick_deg(w) / p) << w;
    EXPECT_LE(errors.wrong_sectors, errors.samples * 5 * tick_deg(w) / 60) << w;
  }
}

// While the speed rises by 5 % per turn, the interpolator does not learn the edges. At constant speed, it
// learns them from the next eight turns.
TEST(HallInterpolator, LearnsNothingOfARotorThatSpeedsUp) {
  const double a = 400, until = 0.25, top = 20 + a * until;
  Bench bench;
  bench.theta_deg = [=](double t) {
    const double up = std::min(t, until);
    return 30 + p * 180 / base::pi * (20 * up + a * up * up / 2 + (t > until ? top * (t - until) : 0.0));
  };
  bench.w_rad_s = [=](double t) { return 20 + a * std::min(t, until); };
  rig::SensorsConfig config = reading(HallAngleFrom::learned_edges, 6);
  config.calibration_turns = 16;
  auto young = interpolator(config), old = interpolator(config);
  bench.drive(young, 0, until);
  EXPECT_FALSE(young.learned());
  bench.drive(old, 0, until + 18 * 2 * base::pi / p / top);
  EXPECT_TRUE(old.learned());
}

TEST(HallInterpolator, WithoutASpeedTheProbesCommutate) {
  auto drive = interpolator(reading(HallAngleFrom::angle, 1));
  control::Measurement<double> m{};
  m.hall = control::hall_of_sector(3);
  drive.measure(m, 5);
  EXPECT_EQ(m.hall, control::hall_of_sector(3));
  EXPECT_EQ(m.speed_rad_s, 0);
  EXPECT_NEAR(m.position_deg, 30 / p, 1e-6) << "the sector's middle";
}

}  // namespace SIXSTEP_TEST_FILE

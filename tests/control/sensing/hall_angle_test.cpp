// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/hall_angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <type_traits>
#include <vector>

#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"
#include "tests/control/sensing/hall_rotor.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<HallAngleState>);

constexpr double pole_pairs = 4;
const HallProbes misplaced{{0, 3, -2, 1, -4, 2}, 5, 2, 120e-6};

HallEdges edges_of(const HallProbes& probes) {
  HallEdges edges;
  for (int n = 0; n < 6; ++n) edges.at[n] = binary_degrees(probes.at(n));
  edges.half_hysteresis = binary_degrees(probes.half_hysteresis_deg);
  return edges;
}

template <class S>
HallAngleConfig<S> config(const HallProbes& probes, std::uint8_t span, double base = 1.0) {
  return {.edges = edges_of(probes),
          .turn_rad_s_ticks = static_cast<TickRatio<S>>(2 * std::numbers::pi / pole_pairs * timer_Hz / base),
          .timeout_ticks = 500000,
          .delay_ticks = static_cast<std::uint32_t>(probes.delay_s * timer_Hz),
          .span = span};
}

double off_deg(BinaryAngle angle, double degrees) {
  return std::remainder(angle * (360 / 4294967296.0) - degrees, 360.0);
}

/// A rotor turns at the constant speed `deg_per_s`, starting at 0, and is read four times per sector. The
/// function `look` receives the results.
template <class S, class Look>
void turning(const HallAngleConfig<S>& c, const HallProbes& probes, double deg_per_s, Look look) {
  HallAngleState state;
  const int direction = deg_per_s > 0 ? 1 : -1;
  hall_angle_edge(c, state, direction > 0 ? 0 : 5, 0, ticks_at(0));
  double t = 0;
  const double every = 15 / std::fabs(deg_per_s);
  for (int n = 1; n < 50; ++n) {
    const int m = direction * n;
    const double passed = switches(probes, m, direction) / deg_per_s, is_seen = passed + probes.delay_s;
    for (; t < is_seen; t += every)
      look(n, hall_angle(c, state, ticks_at(t)), std::floor(t * timer_Hz) / timer_Hz * deg_per_s);
    const SeenEdge e = seen(probes, m, direction, passed);
    hall_angle_edge(c, state, e.sector, e.direction, e.time);
    // A reading directly after the capture.
    look(n, hall_angle(c, state, e.time), std::floor(is_seen * timer_Hz) / timer_Hz * deg_per_s);
  }
}

template <class Scalar>
class HallAngleIn : public ::testing::Test {};
TYPED_TEST_SUITE(HallAngleIn, SensingScalars);

/// If misplacement, hysteresis and delay of the probes are known, angle and speed are accurate to ticks of
/// the timer.
TYPED_TEST(HallAngleIn, IsRightToTicksAtConstantSpeed) {
  using S = TypeParam;
  const double base = is_fixed<S> ? 1000.0 : 1.0;
  double worst = 0;
  for (const double sign : {1.0, -1.0})
    for (const double w : {5.0, 60.0, 900.0})
      for (const std::uint8_t span : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{5}, std::uint8_t{6}}) {
        const double deg_per_s = sign * w * pole_pairs * 180 / std::numbers::pi;
        const double deg_per_tick = std::fabs(deg_per_s) / timer_Hz;
        const HallAngleConfig<S> c = config<S>(misplaced, span, base);
        turning(c, misplaced, deg_per_s, [&](int n, const HallAngle<S>& found, double truth) {
          if (n <= 2) return;
          // The time of an edge is truncated to a tick. Two errors act over at most a sector of 66 degrees
          // and the delay: one more tick in k sectors of at least 55 degrees, and half a tick per turn. The
          // widths of sectors are rounded to units.
          const int k = std::min(n - 2, int{span});
          const double ticks = 55 * k / deg_per_tick, half_tick = 0.5 / (360 / deg_per_tick);
          const double drawn_out = 66 + misplaced.delay_s * std::fabs(deg_per_s);
          const double bound = deg_per_tick + drawn_out * (1 / (ticks - 1) + half_tick) + 4e-7;
          ASSERT_LE(std::fabs(off_deg(found.angle, truth)), bound) << w << ' ' << k << ' ' << n;
          worst = std::max(worst, std::fabs(off_deg(found.angle, truth)) / bound);
          const double ratio = is_fixed<S>
                                   ? 0.5 * digit<S>() * base / (2 * std::numbers::pi / pole_pairs * timer_Hz)
                                   : digit<S>();
          ASSERT_NEAR(
              static_cast<double>(found.speed) * base, sign * w,
              w * (1 / (ticks - 1) + half_tick + 3 * ratio) + (is_fixed<S> ? digit<S>() * base / 2 : 0.0))
              << int{span} << ' ' << n;
        });
      }
  std::printf("largest error %.2f of the bound\n", worst);
  EXPECT_GT(worst, 0.5);
}

/// If the decoder assumes evenly spaced probes but the probes are misplaced, angles are wrong and the speed
/// has a ripple.
TEST(HallAngle, WhatIsNotCalibratedIsWrong) {
  const double w = 60, deg_per_s = w * pole_pairs * 180 / std::numbers::pi;
  HallAngleConfig<double> plain = config<double>(misplaced, 1);
  plain.edges = {};
  plain.delay_ticks = 0;
  double worst_deg = 0, worst_speed = 0;
  turning(plain, misplaced, deg_per_s, [&](int n, const HallAngle<double>& found, double truth) {
    if (n <= 2) return;
    worst_deg = std::max(worst_deg, std::fabs(off_deg(found.angle, truth)));
    worst_speed = std::max(worst_speed, std::fabs(found.speed / w - 1));
  });
  // Just after edge 1, the error of the angle is the sum of four angles: the offset of 5 degrees, the
  // hysteresis of 2 degrees, the probe's misplacement of 3 degrees, and 1.65 degrees of delay.
  EXPECT_GT(worst_deg, 5 + 2 + 3 + 120e-6 * deg_per_s - 0.1);
  EXPECT_NEAR(worst_speed, 60 / 55.0 - 1, 0.001) << "the narrowest sector, of 55 degrees";
}

/// For any edge times, the estimate is equal to its definition, computed in double. It never exceeds the next
/// edge plus the margin.
TEST(HallAngle, IsItsDefinitionForAnyTimes) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Drawn drawn{seed};
    const auto span = static_cast<std::uint8_t>(1 + drawn.below(6));
    HallAngleConfig<double> c = config<double>(misplaced, span);
    const double margin = drawn.below(3) * 2.0;
    c.margin = binary_degrees(margin);
    HallAngleState state;
    const int direction = seed % 2 ? 1 : -1;
    std::vector<std::uint32_t> times;
    std::uint32_t now = drawn.word();
    for (int n = 0; n < 300; ++n) {
      const int m = direction * n;
      const SeenEdge e = seen(misplaced, m, direction, 0);
      hall_angle_edge(c, state, e.sector, static_cast<std::int8_t>(n == 0 ? 0 : direction), now);
      if (n > 0) times.push_back(now);
      const int known = std::min(int{span}, static_cast<int>(times.size()) - 1);
      const std::uint32_t next = 200 + drawn.below(20000);
      for (std::uint32_t since = 0; since < next; since += 1 + drawn.below(1000)) {
        const HallAngle<double> found = hall_angle(c, state, now + since);
        if (known < 1) {
          ASSERT_EQ(found.speed, 0.0);
          // The middle of the sector between its two true edges.
          const int low = direction > 0 ? m : m - 1;
          ASSERT_LE(std::fabs(off_deg(found.angle, (misplaced.at(low) + misplaced.at(low + 1)) / 2)), 1e-6);
          continue;
        }
        const double width = std::fabs(misplaced.at(m) - misplaced.at(m - direction * known));
        const double ticks = times.back() - times[times.size() - 1 - static_cast<std::size_t>(known)];
        const double to_next = std::fabs(misplaced.at(m + direction) - misplaced.at(m));
        const double way = std::min(width * since / ticks, to_next + margin) + width * 120 / ticks;
        const double expected = switches(misplaced, m, direction) + direction * way;
        // The decoder rounds the ticks of a turn to a whole number. This is an error of half a tick per turn,
        // which acts over the angle `way`.
        const double turn_ticks = ticks * 360 / width;
        ASSERT_LE(std::fabs(off_deg(found.angle, expected)), 0.5 / (turn_ticks - 0.5) * way + 1e-6)
            << "seed " << seed;
        const double since_younger = std::max(since, 1u) - 1.0;
        const double longest = std::max(turn_ticks, since_younger * 360 / to_next);
        ASSERT_NEAR(found.speed, direction * 2 * std::numbers::pi / pole_pairs * timer_Hz / longest,
                    std::fabs(found.speed) * (0.6 / turn_ticks + 1e-12))
            << "seed " << seed;
      }
      now += next;
    }
  }
}

/// The decoder is called through hall_step(), as in firmware. A reversal, an impossible code and a time-out
/// discard the history. The angle is then the middle of the sector, which is within 30 degrees of any angle
/// in the sector.
TEST(HallAngle, ReversalFaultAndTimeOutBeginAnew) {
  const HallProbes even;
  const HallAngleConfig<double> c = config<double>(even, 6);
  HallAngleState state;
  HallState pins;
  std::uint32_t now = 0;
  const auto pass = [&](std::uint8_t code) {
    const HallReading r = hall_step(HallConfig{}, pins, code);
    hall_angle_edge(c, state, r.sector, r.moved, now += 1000);
    return hall_angle(c, state, now);
  };
  EXPECT_EQ(hall_angle(c, state, now).speed, 0.0) << "before the first code";
  for (std::uint8_t s = 0; s < 3; ++s) pass(hall_of_sector(s));
  EXPECT_NEAR(pass(hall_of_sector(3)).speed, std::numbers::pi / 3 / pole_pairs * 1e3, 0.5);
  EXPECT_LE(std::fabs(off_deg(pass(hall_of_sector(2)).angle, 150)), 1e-6) << "turned back";
  EXPECT_EQ(hall_angle(c, state, now).speed, 0.0);
  EXPECT_LE(std::fabs(off_deg(pass(hall_of_sector(1)).angle, 120)), 1e-6) << "the second edge backward";
  EXPECT_LT(hall_angle(c, state, now).speed, 0.0);
  EXPECT_EQ(pass(0b111).speed, 0.0) << "an impossible code";
  EXPECT_EQ(hall_angle(c, state, now).angle, 0u);
  EXPECT_LE(std::fabs(off_deg(pass(hall_of_sector(4)).angle, 270)), 1e-6);
  pass(hall_of_sector(5));
  pass(hall_of_sector(0));
  EXPECT_LE(std::fabs(off_deg(hall_angle(c, state, now + 500000).angle, 60)), 1e-6)
      << "waits at the next edge";
  EXPECT_GT(hall_angle(c, state, now + 500000).speed, 0.0);
  EXPECT_LE(std::fabs(off_deg(hall_angle(c, state, now + 500001).angle, 30)), 1e-6) << "stands";
  EXPECT_EQ(hall_angle(c, state, now + 500001).speed, 0.0);
  EXPECT_EQ(hall_angle(c, state, now + 3).speed, 0.0) << "for good";
  now += 600000;
  EXPECT_EQ(pass(hall_of_sector(1)).speed, 0.0) << "one edge alone says nothing about speed";
}

}  // namespace SIXSTEP_TEST_FILE

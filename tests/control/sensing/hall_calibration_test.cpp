// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/hall_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <type_traits>

#include "tests/control/sensing/drawn.hpp"
#include "tests/control/sensing/hall_rotor.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<HallCalibrationState>);

const HallProbes planted{{0, 3, -2, 1, -4, 2}, 7, 2, 100e-6};
constexpr double hz = 50;  // electrical frequency

/// A run that passes each angle (degrees) at the time when(angle), in s. The times have a jitter that
/// corresponds to `jitter_deg` at the mean speed.
HallCalibrationState run(const HallCalibrationConfig& config, const HallProbes& probes, int direction,
                         int first, const std::function<double(double)>& when, double jitter_deg,
                         Drawn& drawn) {
  HallCalibrationState state;
  for (int n = 0; n < 6 * config.turns + 10; ++n) {
    const int m = direction * (n + first);
    const double turned = direction * switches(probes, m, direction);
    const SeenEdge e =
        seen(probes, m, direction,
             when(turned) + (jitter_deg > 0 ? jitter_deg * drawn.normal() / 360 / hz : 0) + 0.1);
    if (hall_calibrate(config, state, e.edge, e.direction, e.time) != HallCalibration::running) break;
  }
  return state;
}
double steadily(double degrees) { return degrees / 360 / hz; }

/// The misplacements are found within 0.1 degrees. The error of an edge is the mean of n jittered times,
/// minus the common part of all six edges: sigma sqrt(5/6/n), with the standard deviation sigma of the
/// jitter.
TEST(HallCalibration, FindsWhatWasPlanted) {
  const HallCalibrationConfig config{.turns = 256, .steady = 32};
  const double sigma = 0.2;
  double squares = 0, worst = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Drawn drawn{seed};
    const int direction = seed % 2 ? 1 : -1;
    const HallCalibrationState state =
        run(config, planted, direction, static_cast<int>(drawn.below(6)), steadily, sigma, drawn);
    ASSERT_EQ(state.result, HallCalibration::done) << "seed " << seed;
    const HallDeviations found = hall_deviations(state);
    for (int n = 0; n < 6; ++n) {
      // the misplacements own_deg sum to 0, and so do the deviations
      const double off = degrees_of(found.at[n]) - planted.own_deg[n];
      EXPECT_LT(std::fabs(off), 0.1) << n << " of seed " << seed;
      worst = std::max(worst, std::fabs(off));
      squares += off * off;
      ++count;
    }
  }
  const double rms = std::sqrt(squares / count), law = sigma * std::sqrt(5.0 / 6 / config.turns);
  std::printf("largest %.4f degrees, rms %.4f, by the law %.4f\n", worst, rms, law);
  // The tolerance is five times the standard error of an rms over 250 independent values, 4.5 %.
  EXPECT_NEAR(rms, law, 0.23 * law);
}

/// Without jitter, the error is one tick of the timer.
TEST(HallCalibration, IsRightToATick) {
  const double tick_deg = 360 * hz / timer_Hz;
  Drawn drawn{1};
  for (const std::uint16_t turns : {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{32}})
    for (const int direction : {1, -1})
      for (int first = 0; first < 6; ++first) {
        const HallDeviations found =
            hall_deviations(run({.turns = turns}, planted, direction, first, steadily, 0, drawn));
        for (int n = 0; n < 6; ++n)
          EXPECT_NEAR(degrees_of(found.at[n]), planted.own_deg[n], 1.5 * tick_deg) << first;
      }
}

/// The times of the edges do not show the offset that all edges have in common, so the test supplies the
/// offset. Runs in both directions separate the offset from the hysteresis.
TEST(HallCalibration, OffsetAndHysteresisPartWhereBothDirectionsAreGiven) {
  Drawn drawn{2};
  const HallCalibrationConfig config;
  const HallDeviations forward = hall_deviations(run(config, planted, 1, 0, steadily, 0, drawn));
  const HallDeviations backward = hall_deviations(run(config, planted, -1, 0, steadily, 0, drawn));
  const double late_deg = 2 + 360 * hz * planted.delay_s;  // h + w t_d
  const auto seen_forward = static_cast<std::int32_t>(binary_degrees(7 + late_deg));
  const auto seen_backward = static_cast<std::int32_t>(binary_degrees(7 - late_deg));
  const HallEdges edges = hall_edges(forward, backward, seen_forward, seen_backward);
  const double near = 1.5 * 360 * hz / timer_Hz;
  for (int n = 0; n < 6; ++n)
    EXPECT_NEAR(degrees_of(way_between(binary_degrees(planted.at(n)), edges.at[n])), 0, near) << n;
  EXPECT_NEAR(degrees_of(static_cast<std::int32_t>(edges.half_hysteresis)), late_deg, 1e-6);
  // After a run in one direction only, the hysteresis of the data sheet is used.
  const HallEdges one = hall_edges(forward, static_cast<std::int32_t>(binary_degrees(7)), binary_degrees(2));
  for (int n = 0; n < 6; ++n)
    EXPECT_NEAR(degrees_of(way_between(binary_degrees(planted.at(n)), one.at[n])), 0, near) << n;
  EXPECT_EQ(one.half_hysteresis, binary_degrees(2));
}

/// The hysteresis of each edge is different. It cancels in the mean of both directions.
TEST(HallCalibration, HysteresesThatDifferCancelInTheMeanOfBothDirections) {
  HallProbes forward = planted, backward = planted;
  const double more[6] = {0.5, -0.3, 0.2, -0.6, 0.1, 0.1};
  for (int n = 0; n < 6; ++n) {
    forward.own_deg[n] += more[n];
    backward.own_deg[n] -= more[n];
  }
  Drawn drawn{3};
  const HallEdges edges = hall_edges(hall_deviations(run({}, forward, 1, 0, steadily, 0, drawn)),
                                     hall_deviations(run({}, backward, -1, 0, steadily, 0, drawn)), 0, 0);
  for (int n = 0; n < 6; ++n)
    EXPECT_NEAR(degrees_of(way_between(binary_degrees(60 * n + planted.own_deg[n]), edges.at[n])), 0,
                1.5 * 360 * hz / timer_Hz);
}

/// The time of a turn drifts by the fraction d over n turns. This drift shifts angles by at most d/(8 n)
/// turns, and the test reaches this bound.
TEST(HallCalibration, DriftBendsByItsLaw) {
  Drawn drawn{4};
  const HallProbes even;
  const HallCalibrationConfig config{.turns = 32, .steady = 64};
  const double d = 0.9 / 64, n = config.turns;
  // x turns take the time t = x T (1 + d x/(2 n)) (T: time of a turn), so each turn takes d/n of T longer
  // than the previous turn.
  const auto drifting = [&](double degrees) {
    const double x = degrees / 360;
    return x / hz * (1 + d * x / (2 * n));
  };
  const HallCalibrationState state = run(config, even, 1, 0, drifting, 0, drawn);
  ASSERT_EQ(state.result, HallCalibration::done);
  const HallDeviations found = hall_deviations(state);
  const auto [low, high] = std::minmax_element(found.at, found.at + 6);
  const double bound_deg = d / (8 * n) * 360, tick_deg = 360 * hz / timer_Hz;
  EXPECT_LE(degrees_of(*high) - degrees_of(*low), bound_deg + 2 * tick_deg);
  EXPECT_GE(degrees_of(*high) - degrees_of(*low), bound_deg - 2 * tick_deg);
}

TEST(HallCalibration, RefusesARotorThatIsNotSteady) {
  Drawn drawn{5};
  const HallCalibrationConfig config{.turns = 32, .steady = 64};
  for (const double d : {1.2 / 64, -1.2 / 64, 0.5, -0.5}) {
    const auto drifting = [&](double degrees) {
      const double x = degrees / 360;
      return x / hz * (1 + d * x / 64);
    };
    const HallCalibrationState state = run(config, planted, 1, 0, drifting, 0, drawn);
    EXPECT_EQ(state.result, HallCalibration::unsteady) << d;
    for (const std::int32_t at : hall_deviations(state).at) EXPECT_EQ(at, 0);
  }
}

TEST(HallCalibration, RefusesAReversalAndAMissedEdge) {
  for (const bool back : {true, false}) {
    HallCalibrationState state;
    for (std::uint8_t e = 0; e < 4; ++e)
      EXPECT_EQ(hall_calibrate({}, state, e, 1, e * 100u), HallCalibration::running);
    const std::uint8_t edge = back ? 3 : 5;
    EXPECT_EQ(hall_calibrate({}, state, edge, back ? -1 : 1, 400), HallCalibration::disturbed);
    EXPECT_EQ(hall_calibrate({}, state, 4, 1, 500), HallCalibration::disturbed) << "for good";
  }
}

/// The run lasts some days, so the sums have more than 32 bits.
TEST(HallCalibration, LongRunsDoNotOverflow) {
  HallCalibrationState state;
  const HallCalibrationConfig config{.turns = 65535};
  std::uint32_t t = 0;
  const std::uint32_t sector = 100000000;  // a turn of 6e8 ticks, 3.9e13 in total
  for (std::uint32_t n = 0; state.result == HallCalibration::running && n < 400000; ++n, t += sector)
    hall_calibrate(config, state, static_cast<std::uint8_t>(n % 6), 1, t + (n % 6 == 3 ? sector / 10 : 0));
  ASSERT_EQ(state.result, HallCalibration::done);
  const HallDeviations found = hall_deviations(state);
  // One edge is 6 degrees off. The mean of the six edges, 1 degree, is subtracted, so the results are 5 and
  // -1 degrees. Sums have a resolution of 2^-32 turns and are rounded down.
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(degrees_of(found.at[n]), n == 3 ? 5 : -1, 4 * 360 / 4294967296.0);
}

}  // namespace SIXSTEP_TEST_FILE

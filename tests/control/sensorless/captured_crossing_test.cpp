// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/captured_crossing.hpp"

#include <gtest/gtest.h>

#include "tests/control/sensorless/terminals.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using namespace sixstep::testing;

constexpr ZeroCrossingConfig crossing{NeutralSeen::on_time, 96, 20, 20, 0};
constexpr std::uint32_t tick = 480, sector_ticks = 16 * tick;

/// One sector. look() samples its terminals at given ticks, and capture_lines() gives the edges of the
/// floating leg.
struct Sector {
  std::uint8_t sector = 0;
  double emf = 400.0;
  CapturedCrossingConfig config{.follows = true};
  ZeroCrossingState state{};
  CapturedLines captured{};
  std::uint32_t on_ticks = tick / 2;

  std::uint8_t before() const { return sector % 2 == 0 ? 7 : 0; }
  std::uint8_t after() const { return static_cast<std::uint8_t>(before() ^ (4u >> floating_leg(sector))); }
  void begin(std::uint32_t at) { zero_crossing_begin(state, sector, 0, at); }
  CrossingReading look(std::uint32_t since) {
    const double deg = 60.0 * sector + 60.0 * since / sector_ticks;
    return captured_crossing_step(config, crossing, state, captured, driven_sample(sector, deg, emf, since),
                                  true, on_ticks);
  }
};

TEST(CapturedCrossing, IsWhereTheEdgeWasWhicheverWayTheBackEmfGoes) {
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    Sector s{.sector = sector};
    capture_lines(s.captured, s.before(), 0xfffff000u);
    s.begin(0);
    constexpr std::uint32_t edge = 8 * tick + 137;
    for (std::uint32_t t = tick; t < edge; t += tick) ASSERT_EQ(s.look(t).crossing, Crossing::none) << t;
    capture_lines(s.captured, s.after(), edge);
    const CrossingReading seen = s.look(9 * tick);
    EXPECT_EQ(seen.crossing, Crossing::seen) << int(sector);
    EXPECT_EQ(seen.at, edge);
    EXPECT_EQ(s.look(10 * tick).crossing, Crossing::none) << "once a sector";
  }
}

/// Edges during freewheeling are ignored. The first edge after freewheeling is used, even if no sample has
/// shown the line's level before it.
TEST(CapturedCrossing, TheFreewheelsEdgesAreNotTheBackEmfs) {
  Sector s;
  capture_lines(s.captured, s.before(), 0xfffff000u);
  s.begin(0);
  capture_lines(s.captured, s.after(), 30);  // the diode holds the terminal low
  const auto freewheel = [&](std::uint32_t t) {
    TerminalSample sample = driven_sample(0, 60.0 * t / sector_ticks, 400, t);
    sample.u[floating_leg(0)] = 0;
    return captured_crossing_step(s.config, crossing, s.state, s.captured, sample, true, s.on_ticks);
  };
  EXPECT_EQ(freewheel(tick).crossing, Crossing::none);
  EXPECT_EQ(freewheel(2 * tick).crossing, Crossing::none);
  EXPECT_EQ(s.look(3 * tick).crossing, Crossing::none)
      << "free, and the line still low: what the filter remembers";
  capture_lines(s.captured, s.before(), 3 * tick + 100);
  capture_lines(s.captured, s.after(), 8 * tick + 50);
  const CrossingReading seen = s.look(9 * tick);
  EXPECT_EQ(seen.crossing, Crossing::seen);
  EXPECT_EQ(seen.at, 8 * tick + 50);
}

/// A line whose level has not changed since freewheeling gives no edge. The crossing then comes from the
/// samples, with the same delay as an edge.
TEST(CapturedCrossing, WhileTheLineHasNotComeBackTheSamplesTell) {
  Sector s;
  s.config.lag_ticks = 200;
  capture_lines(s.captured, s.after(), 0xfffff000u);
  s.begin(0);
  for (std::uint32_t t = tick; t < 8 * tick; t += tick) ASSERT_EQ(s.look(t).crossing, Crossing::none) << t;
  ASSERT_EQ(s.look(8 * tick).crossing, Crossing::seen);
  Sector passed;
  capture_lines(passed.captured, passed.after(), 0xfffff000u);
  passed.begin(0);
  EXPECT_EQ(passed.look(12 * tick).crossing, Crossing::passed_before);
}

TEST(CapturedCrossing, ASampleIsToldAsLateAsAnEdge) {
  const auto at = [](std::uint32_t lag_ticks) {
    Sector s;
    s.config.lag_ticks = lag_ticks;
    capture_lines(s.captured, s.after(), 0xfffff000u);
    s.begin(0);
    CrossingReading reading;
    for (std::uint32_t t = tick / 2; reading.crossing == Crossing::none && t < sector_ticks; t += tick)
      reading = s.look(t);
    EXPECT_EQ(reading.crossing, Crossing::seen);
    return reading.at;
  };
  EXPECT_EQ(at(200), at(0) + 200);
}

/// The comparators' reference is half the bus voltage. An edge within the pulse is a crossing of the
/// back-EMF. An edge within the pause is caused by the pulse itself, so the middle of the pause is used as
/// the time of the crossing.
TEST(CapturedCrossing, AgainstHalfTheBusThePausesMiddleStandsForItsEdges) {
  const auto at = [](std::uint32_t edge, std::uint32_t on_ticks) {
    Sector s;
    s.on_ticks = on_ticks;
    s.config.period_ticks = tick;
    s.config.settle_ticks = 20;
    capture_lines(s.captured, s.before(), 0xfffff000u);
    s.begin(0);
    for (std::uint32_t t = tick; t < 9 * tick; t += tick) EXPECT_EQ(s.look(t).crossing, Crossing::none);
    capture_lines(s.captured, s.after(), edge);
    const CrossingReading seen = s.look(9 * tick);
    EXPECT_EQ(seen.crossing, Crossing::seen);
    return seen.at;
  };
  constexpr std::uint32_t now = 9 * tick, on = 200;
  EXPECT_EQ(at(now - 50, on), now - 50) << "settled, in the pulse";
  EXPECT_EQ(at(now - 90, on), now - tick / 2) << "the filter still shows the pause";
  EXPECT_EQ(at(now - 300, on), now - tick / 2) << "in the pause";
  EXPECT_EQ(at(now - tick + 60, on), now - tick + 60) << "in the pulse before, behind its sample";
  EXPECT_EQ(at(now - 300, tick), now - 300) << "there is no pause";
}

/// An edge before the earliest possible crossing is not reported at once. It is reported from the earliest
/// time on, and the time of the crossing is this earliest time.
TEST(CapturedCrossing, AnEdgeTooEarlyCountsWhenItMay) {
  Sector s;
  capture_lines(s.captured, s.before(), 0xfffff000u);
  zero_crossing_begin(s.state, 0, 6 * tick, 0);
  EXPECT_EQ(s.look(tick).crossing, Crossing::none);
  capture_lines(s.captured, s.after(), 2 * tick);
  EXPECT_EQ(s.look(3 * tick).crossing, Crossing::none);
  const CrossingReading seen = s.look(6 * tick);
  EXPECT_EQ(seen.crossing, Crossing::seen);
  EXPECT_EQ(seen.at, 6 * tick);
}

TEST(CapturedCrossing, OnlyLinesThatChangeAreStamped) {
  CapturedLines lines;
  capture_lines(lines, 0b101, 100);
  capture_lines(lines, 0b001, 200);
  EXPECT_EQ(lines.lines, 1);
  EXPECT_EQ(lines.at[0], 200u);
  EXPECT_EQ(lines.at[1], 0u);
  EXPECT_EQ(lines.at[2], 100u);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/hall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <type_traits>

#include "sixstep/control/advance.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/plant/hall.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<HallState> && std::is_trivially_copyable_v<HallSpeedState> &&
              std::is_trivially_copyable_v<HallPositionState>);

/// Codes of three probes by their definition. Each probe is high over half a turn, and the next probe lags by
/// `apart` sectors.
std::uint8_t pins(int sector, int apart) {
  const auto high = [&](int lag) { return (sector - lag + 18 + 1) % 6 < 3; };  // H1 over sectors 5, 0, 1
  return static_cast<std::uint8_t>(high(0) << 2 | high(apart) << 1 | int{high(2 * apart)});
}

constexpr HallConfig arrangement(int apart) {
  return {apart == 2 ? HallArrangement::degrees_120 : HallArrangement::degrees_60, 1};
}

TEST(Hall, BothArrangementsAreDecodedByTheirDefinition) {
  for (const int apart : {2, 1})
    for (int s = 0; s < 6; ++s) {
      EXPECT_TRUE(apart != 2 || pins(s, 2) == sixstep::plant::hall_code(s)) << "the model's definition";
      HallState state;
      EXPECT_EQ(hall_step(arrangement(apart), state, pins(s, apart)).sector, s) << apart;
    }
}

TEST(Hall, EachArrangementHasTwoImpossibleCodes) {
  for (const int apart : {2, 1})
    for (int code = 0; code < 256; ++code) {
      bool possible = false;
      for (int s = 0; s < 6; ++s) possible = possible || pins(s, apart) == code;
      HallState state;
      const HallReading r = hall_step(arrangement(apart), state, static_cast<std::uint8_t>(code));
      EXPECT_EQ(r.fault == HallFault::none, possible) << apart << ' ' << code;
      EXPECT_EQ(r.sector == no_sector, !possible) << apart << ' ' << code;
    }
}

TEST(Hall, EveryChangeIsAMoveOrAFault) {
  for (int from = 0; from < 6; ++from)
    for (int to = 0; to < 6; ++to) {
      HallState state;
      hall_step(HallConfig{}, state, pins(from, 2));
      const HallReading r = hall_step(HallConfig{}, state, pins(to, 2));
      const int passed = (to - from + 6) % 6;
      EXPECT_EQ(r.moved, passed == 1 ? 1 : passed == 5 ? -1 : 0);
      EXPECT_EQ(r.fault, passed >= 2 && passed <= 4 ? HallFault::jump : HallFault::none);
      EXPECT_EQ(hall_step(HallConfig{}, state, pins(to, 2)).fault, HallFault::none) << "told once";
    }
}

TEST(Hall, GlitchesShorterThanTheFilterDoNotCount) {
  const HallConfig config{.stable_samples = 3};
  HallState state;
  for (int n = 0; n < 2; ++n)
    EXPECT_EQ(hall_step(config, state, pins(0, 2)).sector, no_sector) << "not yet settled";
  EXPECT_EQ(hall_step(config, state, pins(0, 2)).sector, 0);
  for (const int level : {0b000, 0b111, 0b001, 0b110}) {
    const auto glitch = static_cast<std::uint8_t>(level);
    hall_step(config, state, glitch);
    EXPECT_EQ(hall_step(config, state, glitch).sector, 0);
    const HallReading back = hall_step(config, state, pins(0, 2));
    EXPECT_EQ(back.sector, 0);
    EXPECT_EQ(back.fault, HallFault::none);
  }
  for (int n = 0; n < 2; ++n) EXPECT_EQ(hall_step(config, state, pins(1, 2)).moved, 0);
  EXPECT_EQ(hall_step(config, state, pins(1, 2)).moved, 1) << "third sample in a row";
  EXPECT_EQ(hall_step(config, state, pins(1, 2)).moved, 0) << "counted once";
}

/// A line breaks within a sector of a steadily turning rotor, which is read 20 times per sector. The
/// impossible code occurs within a turn, and the decoder names the broken line.
TEST(Hall, ABrokenLineIsNamed) {
  int named = 0, untold = 0;
  for (const int apart : {2, 1})
    for (const int direction : {1, -1})
      for (int line = 1; line <= 3; ++line)
        for (const int level : {0, 1})
          for (int breaks_at = 0; breaks_at < 120; ++breaks_at) {
            const HallConfig config = arrangement(apart);
            HallState state;
            HallSpeedState times;
            HallReading fault;
            for (int t = 0; t < 600 && fault.fault == HallFault::none; ++t) {
              const int place = direction > 0 ? t : 6000 - 1 - t;
              std::uint8_t code = pins(place / 20 % 6, apart);
              const unsigned bit = 0b1000u >> line;
              if (t >= 240 + breaks_at)
                code = static_cast<std::uint8_t>(level ? (code | bit) : (code & ~bit));
              const auto now = static_cast<std::uint32_t>(t);
              fault = hall_step(config, state, code, sector_time(times, 1, now));
              hall_speed_edge(times, now, fault.moved);
            }
            ASSERT_NE(fault.fault, HallFault::none);
            // A break at the edge of another line may appear as a jump. The decoder names no line for a jump.
            if (breaks_at % 20 == 0 && fault.fault == HallFault::jump) continue;
            ASSERT_EQ(fault.fault, HallFault::impossible_code);
            ++(fault.line == 0 ? untold : named);
            ASSERT_TRUE(fault.line == line || fault.line == 0)
                << apart << ' ' << direction << ' ' << line << ' ' << level << ' ' << breaks_at;
          }
  // A false edge between 3/4 and 8/9 of a sector is as early as an edge of a rotor whose speed changes by a
  // quarter, so the decoder names no line. The next sectors also differ, so they do not help. One in six
  // breaks causes an early false edge.
  std::printf("named %d, not told %d\n", named, untold);
  EXPECT_LE(untold, named / 30);
}

/// A rotor with the initial speed `w`, in sectors/s, has the constant acceleration `a`, in sectors/s^2. A
/// decelerating rotor reverses at standstill. The rotor is read 1000 times per second, and a line breaks at
/// `at_s`. Returns the named line, or 0.
std::uint8_t named(double w, double a, double at_s, int line, int level) {
  HallState state;
  HallSpeedState times;
  for (int t = 0; t < 4000; ++t) {
    const double s = t * 1e-3, place = 60.5 + w * s + a * s * s / 2;
    std::uint8_t code = pins(static_cast<int>(std::floor(place)) % 6, 2);
    const unsigned bit = 0b1000u >> line;
    if (s >= at_s) code = static_cast<std::uint8_t>(level ? (code | bit) : (code & ~bit));
    const auto now = static_cast<std::uint32_t>(t);
    const HallReading r = hall_step(HallConfig{}, state, code, sector_time(times, 1, now));
    hall_speed_edge(times, now, r.moved);
    if (r.fault == HallFault::impossible_code) return r.line;
    if (place < 10) return 0;
  }
  return 0;
}

/// If the rotor slows down, reverses or starts, the times of edges do not determine the broken line. The
/// decoder then names no line; it never names a wrong line.
TEST(Hall, NoOtherLineIsNamedWhereTheRotorTurnsBack) {
  int right = 0, wrong = 0, untold = 0;
  for (const double w : {0.0, 3.0, 8.0, 15.0, 30.0})
    for (const double a : {-60.0, -20.0, -8.0, -3.0, 0.0, 3.0, 8.0, 20.0})
      for (int line = 1; line <= 3; ++line)
        for (const int level : {0, 1})
          for (double at_s = 0.05; at_s < 2.5; at_s += 0.0137) {
            const std::uint8_t found = named(w, a, at_s, line, level);
            ++(found == 0 ? untold : found == line ? right : wrong);
          }
  std::printf("named %d, wrong %d, not told %d\n", right, wrong, untold);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(right, untold / 4) << "and it is told where it can be";
}

TEST(Hall, FromRestNoEdgeComesSoonerThanARotorBringsIt) {
  HallSpeedState times;
  std::uint32_t now = 0;
  // At a constant torque, the intervals between edges are proportional to sqrt(n + 1) - sqrt(n).
  for (const std::uint32_t after : {1000u, 414u, 318u, 268u, 236u, 213u, 196u}) {
    EXPECT_NE(sector_time(times, 1, now + after), SectorTime::soon) << after;
    hall_speed_edge(times, now += after, 1);
  }
  EXPECT_EQ(sector_time(times, 1, now + 140), SectorTime::soon);
  EXPECT_EQ(sector_time(times, 1, now + 182), SectorTime::within);
  EXPECT_EQ(sector_time(times, 1, now + 182 + 170), SectorTime::twice);
}

template <class Scalar>
class HallMotion : public ::testing::Test {};
TYPED_TEST_SUITE(HallMotion, Scalars);

/// The rotor has eight pole pairs, and the timer runs at 1 MHz. Speeds are in units of 1000 rad/s, so that
/// every scalar can represent them.
constexpr double sector_rad_s_ticks = 3.14159265358979323846 / 3 / 8 * 1e6 / 1000;

template <class Scalar>
HallSpeedConfig<Scalar> speed_config(std::uint8_t edges) {
  return {TickRatio<Scalar>(sector_rad_s_ticks), 200000, edges};
}

TYPED_TEST(HallMotion, SteadySpeedIsOneOverTheSectorTimeThroughTheWrap) {
  using S = TypeParam;
  for (const std::uint8_t edges : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{6}})
    for (const std::uint32_t ticks : {131u, 1000u, 54321u})
      for (const std::int8_t direction : {std::int8_t{1}, std::int8_t{-1}}) {
        HallSpeedState state;
        std::uint32_t now = 0xffffffffu - 3 * ticks;  // wraps between the third and the fourth edge
        const auto config = speed_config<S>(edges);
        EXPECT_EQ(static_cast<double>(hall_speed(config, state, now)), 0.0);
        hall_speed_edge(state, now, direction);
        EXPECT_EQ(static_cast<double>(hall_speed(config, state, now)), 0.0) << "one edge says nothing";
        for (int n = 0; n < 20; ++n) {
          hall_speed_edge(state, now += ticks, direction);
          const double w = static_cast<double>(hall_speed(config, state, now + ticks / 3));
          // The error is one rounding of the ratio and one rounding of the quotient.
          EXPECT_NEAR(w, direction * sector_rad_s_ticks / ticks,
                      1.5 * digit<S>() * std::fmax(1, std::fabs(w)));
        }
      }
}

TYPED_TEST(HallMotion, MisplacedProbesCancelOverOneTurn) {
  using S = TypeParam;
  const std::uint32_t sector[6] = {900, 1100, 1010, 990, 1050, 950};  // the sum is 6000
  HallSpeedState six, one_edge;
  std::uint32_t now = 77;
  double worst = 0;
  for (int n = 0; n < 60; ++n) {
    now += sector[n % 6];
    hall_speed_edge(six, now, 1);
    hall_speed_edge(one_edge, now, 1);
    if (n < 7) continue;
    EXPECT_NEAR(static_cast<double>(hall_speed(speed_config<S>(6), six, now)), sector_rad_s_ticks / 1000,
                1.5 * digit<S>());
    const double w = static_cast<double>(hall_speed(speed_config<S>(1), one_edge, now));
    worst = std::fmax(worst, std::fabs(w - sector_rad_s_ticks / 1000));
  }
  EXPECT_NEAR(worst, sector_rad_s_ticks * (1.0 / 900 - 1.0 / 1000), 2 * digit<S>())
      << "and without the mean they do not";
}

TYPED_TEST(HallMotion, TheEstimateFallsWithTheSilenceAndEndsAtTheTimeOut) {
  using S = TypeParam;
  HallSpeedState state;
  const auto config = speed_config<S>(1);
  hall_speed_edge(state, 1000, 1);
  hall_speed_edge(state, 2000, 1);
  double last = 1;
  for (std::uint32_t since = 0; since <= 200000; since += 100) {
    const double w = static_cast<double>(hall_speed(config, state, 2000 + since));
    EXPECT_LE(w, last);
    const double bound = sector_rad_s_ticks / (since > 1000 ? since : 1000);
    EXPECT_NEAR(w, bound, 1.5 * digit<S>());
    last = w;
  }
  EXPECT_GT(static_cast<double>(hall_speed(config, state, 2000 + 200000)), 0.0);
  EXPECT_EQ(static_cast<double>(hall_speed(config, state, 2000 + 200001)), 0.0);
  hall_speed_edge(state, 2000 + 300000, 1);
  EXPECT_EQ(static_cast<double>(hall_speed(config, state, 2000 + 300000)), 0.0)
      << "the first edge after standstill has no predecessor";
}

TYPED_TEST(HallMotion, AReversalStartsAnew) {
  using S = TypeParam;
  HallSpeedState state;
  const auto config = speed_config<S>(6);
  for (std::uint32_t t = 0; t < 10000; t += 1000) hall_speed_edge(state, t, 1);
  hall_speed_edge(state, 10000, -1);
  EXPECT_EQ(static_cast<double>(hall_speed(config, state, 10000)), 0.0);
  hall_speed_edge(state, 12000, -1);
  EXPECT_NEAR(static_cast<double>(hall_speed(config, state, 12000)), -sector_rad_s_ticks / 2000,
              1.5 * digit<S>());
}

TYPED_TEST(HallMotion, PositionRunsOnThroughSectorsAndBackToWhereItWas) {
  using S = TypeParam;
  const double sector = 7.5 / 1024;  // degrees, in units of 1024
  HallSpeedState speed;
  HallPositionState count;
  const auto config = speed_config<S>(1);
  const HallPositionConfig<S> position{per_count<S>(sector), Gain<S>(sector)};
  std::uint32_t now = 5000;
  const auto edge = [&](std::int8_t direction) {
    hall_speed_edge(speed, now, direction);
    hall_position_edge(count, direction);
  };
  const auto at = [&](std::uint32_t since) {
    const S fraction = sector_fraction(config, speed, now + since);
    return static_cast<double>(hall_position(position, count, speed.direction, fraction)) / sector;
  };
  // A 16-bit gain has a relative error of 2^-15, which acts over 30 sectors in this test. The roundings of
  // sum and fraction are added.
  const double near = 3 * digit<S>() / sector + 30 * digit<S>();
  EXPECT_NEAR(at(0), 0.5, near) << "nothing known: the middle of the sector";
  for (int n = 1; n <= 30; ++n) {
    now += 1000;
    edge(1);
    if (n == 1) continue;
    EXPECT_NEAR(at(0), n, near);
    EXPECT_NEAR(at(250), n + 0.25, near);
    EXPECT_NEAR(at(5000), n + 1, near) << "waits at the next edge";
  }
  for (int n = 30; n > 0; --n) {
    now += 1000;
    edge(-1);
    if (n == 30) continue;
    EXPECT_NEAR(at(0), n, near) << "the same edge, from the other side";
    EXPECT_NEAR(at(250), n - 0.25, near);
  }
  EXPECT_EQ(count.sectors, 0);
}

TYPED_TEST(HallMotion, AdvanceMovesTheEdgeForwardInTheDirectionOfTurning) {
  using S = TypeParam;
  const AdvanceConfig<S> config{S(0.1), Gain<S>(0.5), S(0.4)};
  EXPECT_NEAR(static_cast<double>(advance_angle(config, S(-0.2))), 0.2, 2 * digit<S>());
  EXPECT_EQ(advance_angle(config, S(1.5)), S(0.4)) << "limited";
  for (std::uint8_t s = 0; s < 6; ++s) {
    EXPECT_EQ(advanced_sector(config, s, std::int8_t{1}, S(0.79), S(0.2)), s);
    EXPECT_EQ(advanced_sector(config, s, std::int8_t{1}, S(0.81), S(0.2)), (s + 1) % 6);
    EXPECT_EQ(advanced_sector(config, s, std::int8_t{-1}, S(0.81), S(-0.2)), (s + 5) % 6);
    EXPECT_EQ(advanced_sector(config, s, std::int8_t{0}, S(0.99), S(0.0)), s);
    EXPECT_EQ(advanced_sector(AdvanceConfig<S>{}, s, std::int8_t{1}, one<S>, S(1.0)), s) << "default: none";
  }
  EXPECT_EQ(advanced_sector(config, no_sector, std::int8_t{1}, S(0.99), S(0.2)), no_sector);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/quadrature.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <type_traits>

#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<QuadratureState>);

/// The encoder by its definition (model.md 10), as a function of its position in counts. A is high over the
/// first half of a line. B is high a quarter of a line later. Z is high over the first line of a turn.
struct Lines {
  bool a, b, z;
};
Lines lines_at(std::int64_t place, std::int64_t counts) {
  const std::int64_t in_turn = ((place % counts) + counts) % counts, in_line = in_turn % 4;
  return {in_line < 2, in_line == 1 || in_line == 2, in_turn < 4};
}
std::int8_t step(const QuadratureConfig& config, QuadratureState& state, std::int64_t place) {
  const Lines l = lines_at(place, config.counts);
  return quadrature_step(config, state, l.a, l.b, l.z);
}
std::int64_t counted(const QuadratureConfig& config, const QuadratureState& state) {
  return static_cast<std::int64_t>(state.turns) * config.counts + state.in_turn;
}

TEST(Quadrature, FollowsARandomWalkExactly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Drawn drawn{seed};
    const QuadratureConfig config = quadrature_of_lines(2 + drawn.below(40));
    QuadratureState state;
    const std::int64_t began = drawn.below(1000);
    std::int64_t place = began, moved = 0;
    bool index_passed = false;
    step(config, state, place);
    for (int n = 0; n < 50000; ++n) {
      const double ahead = n / 5000 % 2 ? 0.55 : 0.4;  // reversals over many turns
      const double u = drawn.unit();
      place += u < ahead ? 1 : u < 0.9 ? -1 : 0;
      moved += step(config, state, place);
      ASSERT_EQ(moved, place - began) << "seed " << seed;
      const std::int64_t in_turn = ((place % config.counts) + config.counts) % config.counts;
      index_passed = index_passed || (in_turn == 2 && n > 0 && moved != 0);
      if (state.referenced) {
        ASSERT_TRUE(index_passed) << "seed " << seed;
        ASSERT_EQ(state.in_turn, in_turn) << "seed " << seed;
      } else {
        ASSERT_EQ(counted(config, state), place - began) << "seed " << seed;
      }
    }
    EXPECT_TRUE(state.referenced) << "seed " << seed;
    EXPECT_EQ(state.illegal, 0u);
    EXPECT_EQ(state.corrections, 0u) << "nothing was missed, and no index says so";
  }
}

TEST(Quadrature, BothLinesAtOnceAreIllegalAndCountTwoOn) {
  const QuadratureConfig config = quadrature_of_lines(100);
  for (const int direction : {1, -1}) {
    QuadratureState state;
    std::int64_t place = 200;
    step(config, state, place);
    for (int n = 0; n < 3; ++n) step(config, state, place += direction);
    EXPECT_EQ(step(config, state, place += 2 * direction), 2 * direction) << "one reading was missed";
    EXPECT_EQ(state.illegal, 1u);
    EXPECT_EQ(counted(config, state), 5 * direction);
    EXPECT_EQ(step(config, state, place), 0) << "told once";
    EXPECT_EQ(state.illegal, 1u);
  }
}

/// A disturbance makes the count wrong by n. The next index, in either direction, reports n. After this
/// index, the angle is correct.
TEST(Quadrature, AnIndexReportsAndMendsMissedCounts) {
  const QuadratureConfig config = quadrature_of_lines(16);
  for (const int direction : {1, -1})
    for (int lost = -31; lost <= 31; ++lost) {
      QuadratureState state;
      std::int64_t place = 30;
      const auto turn = [&] {
        for (int n = 0; n < 64; ++n) step(config, state, place += direction);
      };
      step(config, state, place);
      turn();
      ASSERT_TRUE(state.referenced);
      const std::int32_t turns = state.turns;
      quadrature_moved(config, state, -lost);  // then as many counts too few
      while (state.corrections == 0 && place != 30 + 128 * direction) step(config, state, place += direction);
      EXPECT_EQ(state.direction, direction) << "of the rotor, not of the mending";
      while (place != 30 + 128 * direction) step(config, state, place += direction);
      EXPECT_EQ(state.missed, lost) << direction;
      EXPECT_EQ(state.corrections, lost != 0 ? 1u : 0u);
      EXPECT_EQ(state.in_turn, 30u);
      EXPECT_EQ(state.turns, turns + direction) << "also where the mended count passes the turn's end";
      turn();
      EXPECT_EQ(state.missed, 0) << "mended";
      EXPECT_EQ(state.corrections, lost != 0 ? 1u : 0u);
    }
}

/// The index is evaluated at the right count even if its edges are less than two counts early or late.
TEST(Quadrature, AnIndexMayBeLessThanTwoCountsOff) {
  const QuadratureConfig config = quadrature_of_lines(16);
  for (const int direction : {1, -1})
    for (const int rises : {-3, -2, -1, 0, 1, 2, 3})
      for (const int falls : {-2, -1, 0, 1, 2, 3}) {
        QuadratureState state;
        for (int n = 0; n < 400; ++n) {
          const int in_turn = ((direction * n) % 64 + 64) % 64;
          const int signed_place = in_turn > 32 ? in_turn - 64 : in_turn;
          const Lines l = lines_at(in_turn, 64);
          quadrature_step(config, state, l.a, l.b, signed_place >= rises && signed_place < 4 + falls);
        }
        // The index is evaluated only at the third count. Z must be high at this count, and low both four
        // counts before it and four counts after it.
        const bool sound = rises > -2 && rises <= 2 && falls > -2 && falls <= 2;
        const auto place = static_cast<std::uint32_t>((direction * 399 % 64 + 64) % 64);
        EXPECT_EQ(state.referenced && state.corrections == 0 && state.in_turn == place, sound)
            << rises << ' ' << falls;
      }
}

TEST(Quadrature, ATimersCountIsTheSame) {
  for (std::uint64_t seed = 30; seed < 40; ++seed) {
    Drawn drawn{seed};
    const QuadratureConfig config = quadrature_of_lines(1 + drawn.below(5000));
    QuadratureState state;
    std::int64_t truth = 0;
    for (int n = 0; n < 10000; ++n) {
      const auto most = static_cast<std::int32_t>(config.counts) - 1;
      const std::int32_t moved =
          static_cast<std::int32_t>(drawn.below(static_cast<std::uint32_t>(2 * most + 1))) - most;
      quadrature_moved(config, state, moved);
      truth += moved;
      ASSERT_EQ(counted(config, state), truth) << "seed " << seed;
      ASSERT_LT(state.in_turn, config.counts) << "seed " << seed;
    }
  }
}

TEST(Quadrature, TheAngleIsThatOfTheCountToTwoUnits) {
  for (const std::uint32_t lines : {1u, 3u, 512u, 2500u, 10000u, 1048576u}) {
    const QuadratureConfig config = quadrature_of_lines(lines);
    QuadratureState state;
    for (std::uint32_t n = 0; n < config.counts; n += 1 + config.counts / 1009) {
      state.in_turn = n;
      const double exact = static_cast<double>(n) / config.counts * 4294967296.0;
      EXPECT_NEAR(quadrature_angle(config, state), exact, 2.5) << lines;
    }
  }
}

TEST(Quadrature, TheDefaultCountsNothing) {
  QuadratureState state;
  for (int place = 0; place < 100; ++place) {
    const Lines l = lines_at(place, 64);
    quadrature_step(QuadratureConfig{}, state, l.a, l.b, l.z);
  }
  EXPECT_EQ(state.in_turn, 0u);
  EXPECT_EQ(state.turns, 0);
  EXPECT_FALSE(state.referenced);
}

}  // namespace SIXSTEP_TEST_FILE

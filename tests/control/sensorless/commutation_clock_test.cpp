// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/commutation_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

TEST(CommutationClock, ThirtyDegreesLessTheAdvanceAndTheLead) {
  const unsigned seed = 7;
  std::mt19937 draw(seed);
  for (int n = 0; n < 10000; ++n) {
    const auto T = static_cast<std::uint32_t>(draw()) >> (2 + n % 20);
    const std::uint16_t advance = static_cast<std::uint16_t>(draw() % 32769);
    const std::uint32_t lead = T / 8;
    const double exact = T * (0.5 - advance / 65536.0) - lead;
    const double delay = delay_ticks({2, advance, lead}, T);
    EXPECT_NEAR(delay, exact < 0 ? 0 : exact, 2.0) << "seed " << seed << " T " << T;
  }
  EXPECT_EQ(delay_ticks({2, 32768, 5}, 1000), 0u) << "never before the crossing";
}

TEST(CommutationClock, MeansOverAsManyAsAskedAcrossTheCountersWrap) {
  CommutationClockState state;
  std::uint32_t at = 0xffffff00u;
  EXPECT_EQ(sector_ticks({2}, state), 0u);
  for (const std::uint32_t interval : {0u, 100u, 104u, 96u, 108u, 92u})
    commutation_clock_crossing(state, at += interval, 1);
  EXPECT_EQ(last_interval(state), 92u);
  EXPECT_EQ(sector_ticks({1}, state), 92u);
  EXPECT_EQ(sector_ticks({2}, state), 100u);
  EXPECT_EQ(sector_ticks({6}, state), 100u);
  commutation_clock_crossing(state, at += 60, 1);
  EXPECT_EQ(sector_ticks({2}, state), 76u);
  EXPECT_EQ(sector_ticks({6}, state), 60u) << "nothing like the mean: the last one alone";
  commutation_clock_crossing(state, at += 60, -1);
  EXPECT_EQ(sector_ticks({2}, state), 0u) << "a reversal begins anew";
}

TEST(CommutationClock, AGuessTakesItsPlaceFromItsNeighbours) {
  CommutationClockState state;
  for (const std::uint32_t at : {0u, 100u, 200u}) commutation_clock_crossing(state, at, 1);
  commutation_clock_guess(state, 100, 1, 320);
  EXPECT_EQ(state.crossings.times[0], 300u);
  commutation_clock_crossing(state, 360, 1);
  EXPECT_EQ(state.crossings.times[1], 280u) << "halfway between 200 and 360";
  commutation_clock_guess(state, 80, 1, 400);
  EXPECT_EQ(state.crossings.times[0], 400u) << "not in the future";
}

TEST(CommutationClock, BeforeIsByLessThanHalfTheCounter) {
  EXPECT_TRUE(comes_before(0xfffffff0u, 5u));
  EXPECT_FALSE(comes_before(5u, 0xfffffff0u));
  EXPECT_FALSE(comes_before(5u, 5u));
}

}  // namespace SIXSTEP_TEST_FILE

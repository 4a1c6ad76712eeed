// SPDX-License-Identifier: Apache-2.0
#include "sixstep/sim/instant.hpp"

#include <gtest/gtest.h>

#include <random>

namespace SIXSTEP_TEST_FILE {

using sixstep::sim::Instant;
using sixstep::sim::seconds_between;
using sixstep::sim::to_instant;

constexpr double eps = 0x1p-52;

TEST(Instant, OffsetStaysWithinTheTick) {
  std::mt19937_64 random{3};
  std::uniform_real_distribution<double> count(0.0, 5.0);
  Instant t;
  for (int n = 0; n < 100000; ++n) {
    const Instant next = t.plus_ticks(count(random));
    ASSERT_GE(next.offset, 0.0);
    ASSERT_LT(next.offset, 1.0);
    ASSERT_TRUE(t <= next);
    t = next;
  }
}

TEST(Instant, OffsetThatRoundsUpToOneIsTheNextTick) {
  const Instant t{5, 1.0 - eps / 2};
  EXPECT_EQ(t.plus_ticks(eps / 2), (Instant{6, 0.0}));
  const Instant just_below = Instant{5, 0.0}.plus_ticks(-1e-20);
  EXPECT_EQ(just_below, (Instant{5, 0.0})) << "sum - floor(sum) rounds to 1 there";
}

TEST(Instant, OrderIsThatOfTime) {
  EXPECT_LT((Instant{1, 0.9}), (Instant{2, 0.0}));
  EXPECT_LT((Instant{2, 0.0}), (Instant{2, 0.1}));
  EXPECT_EQ((Instant{2, 0.1}), (Instant{2, 0.1}));
  EXPECT_LT((Instant{std::int64_t{1} << 62, 0.0}), Instant::never());
}

TEST(Instant, TenMillionPeriodsDriftByNothing) {
  Instant t;
  for (int n = 0; n < 10'000'000; ++n) t = t.plus_seconds(30e-6);
  EXPECT_EQ(t, to_instant(300.0));
}

TEST(Instant, FractionsOfATickAddUp) {
  Instant eighths;
  for (int n = 0; n < 8'000'000; ++n) eighths = eighths.plus_ticks(0.125);
  EXPECT_EQ(eighths, (Instant{1'000'000, 0.0})) << "binary fractions are exact";
  Instant thirds;
  constexpr int count = 3'000'000;
  for (int n = 0; n < count; ++n) thirds = thirds.plus_ticks(1.0 / 3.0);
  // Each sum below 2 is rounded by at most eps/2. The literal 1/3 has an error of eps/8.
  EXPECT_NEAR(seconds_between({1'000'000, 0.0}, thirds) * 1e12, 0.0, count * eps);
}

TEST(Instant, DifferencesAreExactFarFromTheStart) {
  const Instant day{86'400'000'000'000'000, 0.25};
  EXPECT_EQ(seconds_between(day, day.plus_ticks(0.5)), 0.5e-12);
  EXPECT_EQ(seconds_between(day, {day.ticks + 30'000'000, 0.25}), 30e-6);
}

TEST(Instant, FilesNameTheNearestTick) {
  EXPECT_EQ(to_instant(15e-3), (Instant{15'000'000'000, 0.0}));
  EXPECT_EQ(to_instant(0.1e-12), (Instant{0, 0.0}));
  EXPECT_EQ(to_instant(30e-6 * 3), (Instant{90'000'000, 0.0}));
  EXPECT_EQ(to_instant(1e6).seconds(), 1e6);
}

}  // namespace SIXSTEP_TEST_FILE

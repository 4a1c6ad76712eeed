// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/lock.hpp"

#include <gtest/gtest.h>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr LockConfig config{
    .shortest_ticks = 40, .longest_ticks = 5000, .most_flux = 300 * 1000, .threshold = 12};

TEST(Lock, HoldsWhileCrossingsComeInTime) {
  LockState state;
  state.losses = 2;
  for (int n = 0; n <= config.sectors_to_forget; ++n)
    EXPECT_EQ(lock_crossing(config, state, Crossing::seen, 1000, 1000, false), LockLoss::none);
  EXPECT_EQ(state.losses, 0) << "forgotten";
}

TEST(Lock, NamesWhatHappensTwoSectorsInARow) {
  const auto twice = [](Crossing crossing, std::uint32_t interval, bool hidden) {
    LockState state;
    EXPECT_EQ(lock_crossing(config, state, crossing, interval, 1000, hidden), LockLoss::none);
    return lock_crossing(config, state, crossing, interval, 1000, hidden);
  };
  EXPECT_EQ(twice(Crossing::passed_before, 1000, true), LockLoss::long_demagnetisation);
  EXPECT_EQ(twice(Crossing::passed_before, 1000, false), LockLoss::wrong_sector);
  EXPECT_EQ(twice(Crossing::seen, 30, false), LockLoss::wrong_sector) << "faster than it can turn";
  EXPECT_EQ(twice(Crossing::seen, 600, false), LockLoss::wrong_sector) << "a jump";
  EXPECT_EQ(twice(Crossing::seen, 1700, false), LockLoss::wrong_sector) << "a jump";
  EXPECT_EQ(twice(Crossing::seen, 650, false), LockLoss::none);
  EXPECT_EQ(twice(Crossing::seen, 1550, false), LockLoss::none);
}

TEST(Lock, OneGoodSectorBetweenClearsIt) {
  LockState state;
  for (int n = 0; n < 50; ++n) {
    EXPECT_EQ(lock_crossing(config, state, Crossing::passed_before, 1000, 1000, n % 4 == 0), LockLoss::none);
    EXPECT_EQ(lock_crossing(config, state, Crossing::seen, 1000, 1000, false), LockLoss::none);
  }
}

TEST(Lock, WaitsForTwoSectorsAndNoLongerThanTheLongest) {
  EXPECT_EQ(lock_waiting(config, 2000, 1000, false, 0), LockLoss::none);
  EXPECT_EQ(lock_waiting(config, 2001, 1000, false, 0), LockLoss::masked_crossing);
  EXPECT_EQ(lock_waiting(config, 2001, 1000, true, 0), LockLoss::long_demagnetisation);
  EXPECT_EQ(lock_waiting(config, 5000, 4000, false, 0), LockLoss::none);
  EXPECT_EQ(lock_waiting(config, 5001, 4000, false, 0), LockLoss::masked_crossing);
  EXPECT_EQ(lock_waiting(config, 0, 1000, false, 4), LockLoss::terminals);
}

TEST(Lock, ABackEmfThatComesBackOrIsTooLargeIsAnotherSectors) {
  const auto after = [](std::int32_t y, bool crossed, int samples) {
    LockState state;
    LockLoss loss = LockLoss::none;
    for (int n = 0; n < samples; ++n) loss = lock_sample(config, state, y, crossed, 1000);
    return loss;
  };
  EXPECT_EQ(after(250, false, 20), LockLoss::none);
  EXPECT_EQ(after(310, false, 3), LockLoss::none);
  EXPECT_EQ(after(310, false, 4), LockLoss::wrong_sector);
  EXPECT_EQ(after(-310, true, 4), LockLoss::wrong_sector);
  EXPECT_EQ(after(13, true, 4), LockLoss::wrong_sector);
  EXPECT_EQ(after(12, true, 20), LockLoss::none);
}

TEST(Lock, GivesUpAfterTheRetries) {
  LockState state;
  for (int n = 0; n < config.retries; ++n) EXPECT_FALSE(lock_lost(config, state, LockLoss::start));
  EXPECT_TRUE(lock_lost(config, state, LockLoss::masked_crossing));
  EXPECT_EQ(state.last, LockLoss::masked_crossing);
}

}  // namespace SIXSTEP_TEST_FILE

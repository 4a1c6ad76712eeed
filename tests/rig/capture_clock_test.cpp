// SPDX-License-Identifier: Apache-2.0
// The counter that captures Hall edges is compared with floor(ticks f/1e12), computed in integers (f:
// frequency in Hz).
#include <gtest/gtest.h>

#include <random>

#include "sixstep/rig/registers.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using rig::CaptureClock;
using sim::Instant;

/// Count n begins at the time n 1e12/f, in ticks of a picosecond (f: frequency in Hz). If this time is a
/// whole number of ticks, the count begins exactly at this tick, not one tick before.
TEST(CaptureClock, ReachesACountAtItsVeryTick) {
  for (const std::int64_t Hz : {1'000'000, 500'000, 8'000'000, 50'000'000, 1'000'000'000}) {
    const CaptureClock clock{static_cast<double>(Hz)};
    const std::int64_t ticks_per_count = 1'000'000'000'000 / Hz;
    for (std::int64_t n = 1; n < 100'000; n += 7) {
      ASSERT_EQ(clock.counts({n * ticks_per_count, 0.0}), static_cast<std::uint32_t>(n)) << Hz;
      ASSERT_EQ(clock.counts({n * ticks_per_count - 1, 0.999}), static_cast<std::uint32_t>(n - 1)) << Hz;
    }
  }
}

/// At 48 MHz, three counts are 62500 ticks. At one in twelve of these times, the floating-point product t f
/// is one count too low.
TEST(CaptureClock, IsNotOneCountLowWhereFloatingPointIs) {
  const CaptureClock clock{48e6};
  int low = 0;
  for (std::int64_t n = 1; n < 30'000; ++n) {
    const Instant t{n * 62'500, 0.0};
    ASSERT_EQ(clock.counts(t), static_cast<std::uint32_t>(3 * n));
    low += std::floor(t.seconds() * 48e6) < static_cast<double>(3 * n);
  }
  EXPECT_GT(low, 1000) << "else this test shows nothing";
}

TEST(CaptureClock, CountsAtAnyFrequencyOverDays) {
  __extension__ typedef __int128 Wide;
  constexpr std::uint32_t seed = 5;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> decade(0, 9);
  for (int n = 0; n < 20'000; ++n) {
    const bool whole = n % 2 == 0;
    // In sixteenths of a hertz, the frequency is an integer, so integer arithmetic is exact.
    const auto sixteenths = static_cast<std::int64_t>(std::pow(10.0, decade(random)) * (whole ? 1 : 16));
    const double Hz = static_cast<double>(sixteenths) / (whole ? 1 : 16);
    const auto ticks = static_cast<std::int64_t>(random() >> 1);
    const Wide count = static_cast<Wide>(ticks) * sixteenths / (whole ? 1 : 16) / 1'000'000'000'000;
    ASSERT_EQ(CaptureClock{Hz}.counts({ticks, 0.0}), static_cast<std::uint32_t>(count)) << seed << " " << Hz;
  }
}

/// At 3 Hz, the first count begins a third of a tick after the tick 333 333 333 333.
TEST(CaptureClock, ACountMayComeWithinATick) {
  const CaptureClock clock{3.0};
  EXPECT_EQ(clock.counts({333'333'333'333, 0.0}), 0u);
  EXPECT_EQ(clock.counts({333'333'333'333, 0.33}), 0u);
  EXPECT_EQ(clock.counts({333'333'333'333, 0.34}), 1u);
  EXPECT_EQ(clock.counts({333'333'333'334, 0.0}), 1u);
}

TEST(CaptureClock, IsWhatTheRegistersCount) {
  const rig::Registers registers{rig::SensorsConfig{.capture_Hz = 500'000}};
  for (std::uint32_t n = 0; n < 10'000; ++n)
    ASSERT_EQ(registers.counter({static_cast<std::int64_t>(n) * 2'000'000, 0.0}), n);
}

}  // namespace SIXSTEP_TEST_FILE

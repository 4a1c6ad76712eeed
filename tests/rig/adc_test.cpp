// SPDX-License-Identifier: Apache-2.0
// An analogue path with its converter is compared with its equation.
#include "sixstep/rig/adc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/adc.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using rig::AdcPath;
using rig::converted;

constexpr base::RandomPlace first{1, 2, 3};

TEST(Adc, CountsAreRoundedAroundTheMiddle) {
  const AdcPath path{.bits = 12, .range = 20.48};  // 10 mA per count
  EXPECT_EQ(converted(path, 0.0, first), 2048);
  EXPECT_EQ(converted(path, 0.0049, first), 2048);
  EXPECT_EQ(converted(path, 0.0051, first), 2049);
  EXPECT_EQ(converted(path, -1.0, first), 1948);
}

TEST(Adc, EndsHold) {
  const AdcPath path{.bits = 10, .range = 5.0};
  EXPECT_EQ(converted(path, 1e6, first), 1023);
  EXPECT_EQ(converted(path, -1e6, first), 0);
}

TEST(Adc, OneSignUsesAllCounts) {
  const AdcPath path{.bits = 12, .range = 40.96, .both_signs = false};
  EXPECT_EQ(converted(path, 0.0, first), 0);
  EXPECT_EQ(converted(path, 24.0, first), 2400);
}

TEST(Adc, OffsetAndGainErrorAddUp) {
  const AdcPath path{.bits = 12, .range = 20.48, .offset = 0.1, .gain_error = 0.02};
  EXPECT_EQ(converted(path, 10.0, first), 2048 + 1030);
}

TEST(Adc, NoiseHasItsRootMeanSquareAndIsDrawnByPlace) {
  const AdcPath path{.bits = 16, .range = 32.768, .noise = 0.1};  // 100 counts of 1 mA
  double sum = 0.0, squares = 0.0;
  constexpr int n = 10000;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double x = converted(path, 0.0, {7, 0, k}) - 32768.0;
    sum += x;
    squares += x * x;
  }
  // The bounds are five standard deviations. The standard deviation of the mean is rms/sqrt(n), and the
  // standard deviation of the rms is rms/sqrt(2 n).
  EXPECT_NEAR(sum / n, 0.0, 5 * 100.0 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 100.0, 5 * 100.0 / std::sqrt(2.0 * n));
  EXPECT_EQ(converted(path, 0.0, first), converted(path, 0.0, first));
  EXPECT_NE(converted(path, 0.0, {1, 2, 3}), converted(path, 0.0, {1, 2, 4}));
}

TEST(Adc, FirmwareReadsBackWhatWentIn) {
  const AdcPath path{.bits = 12, .range = 20.48};
  const control::AdcConfig<double> decoding{.per_eighth = path.lsb() / 8, .offset_counts = path.zero()};
  for (const double x : {-20.0, -3.333, 0.0, 0.5, 19.9})
    EXPECT_NEAR(control::adc_value(decoding, {}, converted(path, x, first)), x,
                path.lsb() / 2 * (1 + 0x1p-40));
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/pi.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "sixstep/control/hysteresis.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

TEST(Pi, VelocityFormByHand) {
  constexpr PiConfig<double> c{.d1 = 4.5, .d0 = -4.0, .limit = 24.0};
  PiState<double> s;
  EXPECT_EQ(pi_step(c, s, 2.0), 9.0);               // 4.5 * 2
  EXPECT_EQ(pi_step(c, s, 1.0), 9.0 + 4.5 - 8.0);   // 5.5
  EXPECT_EQ(pi_step(c, s, -1.0), 5.5 - 4.5 - 4.0);  // -3
  EXPECT_EQ(pi_step(c, s, 0.0), -3.0 + 4.0);        // 1
  EXPECT_EQ(pi_step(c, s, 0.0), 1.0) << "no error: the integral stands";
}

TEST(Pi, GainAndIntegralAreThoseOfTheThesis) {
  // With a constant error, the first output is K e. Each further sample adds d1 + d0 = K_i.
  constexpr PiConfig<double> c{.d1 = 0.5, .d0 = -0.375, .limit = 100.0};
  PiState<double> s;
  for (int n = 0; n < 50; ++n) EXPECT_EQ(pi_step(c, s, 1.0), 0.5 + 0.125 * n);
}

TEST(Pi, ClampedOutputIsTheStateSoNothingWindsUp) {
  constexpr PiConfig<double> c{.d1 = 1.0, .d0 = 0.0, .limit = 3.0};
  PiState<double> s;
  for (int n = 0; n < 1000; ++n) EXPECT_LE(pi_step(c, s, 1.0), 3.0);
  EXPECT_EQ(s.u, 3.0);
  EXPECT_EQ(pi_step(c, s, -1.0), 2.0) << "leaves the limit with the first sample of the other sign";
  for (int n = 0; n < 1000; ++n) pi_step(c, s, -1.0);
  EXPECT_EQ(s.u, -3.0);
  EXPECT_EQ(pi_step(c, s, 1.0), -2.0);
}

TEST(Pi, DefaultGivesNothing) {
  PiState<float> s;
  EXPECT_EQ(pi_step(PiConfig<float>{}, s, 1000.0f), 0.0f);
}

constexpr float third_output() {
  constexpr PiConfig<float> c{.d1 = 2.0f, .d0 = -1.0f, .limit = 10.0f};
  PiState<float> s;
  pi_step(c, s, 1.0f);
  pi_step(c, s, 1.0f);
  return pi_step(c, s, 1.0f);
}
static_assert(third_output() == 4.0f);
static_assert(clamped(5.0, 2.0) == 2.0 && clamped(-5.0, 2.0) == -2.0 && clamped(1.5, 2.0) == 1.5);
static_assert(std::is_trivially_copyable_v<PiState<float>> &&
              std::is_trivially_copyable_v<HysteresisState<double>>);

TEST(Hysteresis, StartsOnSwitchesOutsideAndKeepsBetween) {
  constexpr HysteresisConfig<double> c{.band_A = 0.2};
  HysteresisState<double> s;
  EXPECT_TRUE(hysteresis_step(c, s, 5.0, 5.0)) << "starts on, inside the band";
  EXPECT_TRUE(hysteresis_step(c, s, 5.2, 5.0)) << "at the limit is not above it";
  EXPECT_FALSE(hysteresis_step(c, s, 5.21, 5.0));
  EXPECT_FALSE(hysteresis_step(c, s, 5.0, 5.0));
  EXPECT_FALSE(hysteresis_step(c, s, 4.8, 5.0)) << "at the limit is not below it";
  EXPECT_TRUE(hysteresis_step(c, s, 4.79, 5.0));
  EXPECT_TRUE(hysteresis_step(c, s, 5.1, 5.0));
}

}  // namespace SIXSTEP_TEST_FILE

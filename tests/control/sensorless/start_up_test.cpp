// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/start_up.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

/// The control ticks at which the ramp advances the field.
std::vector<double> field_steps(const StartUpConfig<double>& config, int count) {
  StartUpState state;
  ramp_begin(config, state, 0);
  std::vector<double> at;
  for (int n = 1; static_cast<int>(at.size()) < count; ++n)
    if (ramp_step(config, state, {}, false, false)) {
      at.push_back(n);
      const std::uint32_t angle = state.angle;
      ramp_commutated(state);
      state.angle = angle;  // keeps the part of the angle that exceeds the sector's end
    }
  return at;
}

TEST(StartUp, TheFieldTurnsByTheLawOfT) {
  StartUpConfig<double> config{.acceleration = 40000, .last_speed = 0xffffffff};
  const double a = 40000 / 4294967296.0;
  const std::vector<double> at = field_steps(config, 30);
  for (int n = 1; n <= 30; ++n)
    EXPECT_NEAR(at[static_cast<std::size_t>(n - 1)], std::sqrt(2 * n / a), 2.0) << n;
}

TEST(StartUp, AndByTheLawOfTSquared) {
  StartUpConfig<double> config{.acceleration = 0, .jerk = 300000, .last_speed = 0xffffffff};
  const double j = 300000 / 65536.0 / 4294967296.0;
  const std::vector<double> at = field_steps(config, 30);
  for (int n = 1; n <= 30; ++n)
    EXPECT_NEAR(at[static_cast<std::size_t>(n - 1)], std::cbrt(6 * n / j), 3.0) << n;
}

TEST(StartUp, TheRampEndsAtItsSpeed) {
  const StartUpConfig<double> config{
      .first_speed = 1u << 20, .acceleration = 1u << 20, .last_speed = 1u << 26};
  const std::vector<double> at = field_steps(config, 20);
  EXPECT_EQ(at[19] - at[18], 64) << "2^32/2^26 ticks a sector";
}

TEST(StartUp, WaitsASectorForACrossingToComeAndGoesOnAtOnceForTwoThatHadPassed) {
  const StartUpConfig<double> config{.first_speed = 1u << 26, .last_speed = 1u << 26};
  StartUpState state;
  ramp_begin(config, state, 0);
  int n = 1;
  while (!ramp_step(config, state, {}, true, false)) ++n;
  EXPECT_EQ(n, 128);
  ramp_commutated(state);
  const CrossingReading passed{.crossing = Crossing::passed_before};
  EXPECT_FALSE(ramp_step(config, state, passed, false, false));
  EXPECT_TRUE(ramp_step(config, state, passed, false, false));
}

TEST(StartUp, CountsCrossingsThatFollowEachOther) {
  const StartUpConfig<double> config{.first_speed = 1u << 26, .last_speed = 1u << 27};
  StartUpState state;
  ramp_begin(config, state, 0);
  const CrossingReading seen{.crossing = Crossing::seen};
  for (std::uint8_t n = 1; n < 6; ++n) {
    EXPECT_FALSE(ramp_step(config, state, seen, false, true));
    EXPECT_EQ(state.trusted, n);
    ramp_commutated(state);
  }
  for (int n = 0; n < 200; ++n) ramp_step(config, state, {}, false, false);
  EXPECT_EQ(state.trusted, 0) << "the field had to go on by itself";
}

/// An oscillation without friction. The current is low while the speed increases, and full while the speed
/// decreases.
TEST(StartUp, TheSwingsSpeedIsToldToGrowOrToShrink) {
  const StartUpConfig<double> config{.swing_shift = 4, .swing_threshold = 20};
  StartUpState state;
  int right = 0, wrong = 0;
  for (int n = 0; n < 4000; ++n) {
    const double phase = 2 * 3.14159265358979 * n / 800;
    align_swing(config, state, {.visible = true, .y = static_cast<std::int32_t>(600 * std::sin(phase))});
    if (std::fabs(std::sin(phase)) < 0.1 || std::fabs(std::cos(phase)) < 0.2) continue;  // near a reversal
    const bool grows = std::sin(phase) * std::cos(phase) > 0;
    (state.falls == grows ? right : wrong)++;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(right, 2500);
}

TEST(StartUp, AlignsInTwoSteps) {
  const StartUpConfig<double> config{.align_ticks = 1000};
  StartUpState state;
  align_begin(state, 0xffffff00u);
  EXPECT_FALSE(align_step_ends(config, state, 0xffffff00u + 999));
  EXPECT_TRUE(align_step_ends(config, state, 0xffffff00u + 1000));
  EXPECT_EQ(state.step, 1);
  EXPECT_FALSE(align_step_ends(config, state, 0xffffff00u + 1999));
  EXPECT_TRUE(align_step_ends(config, state, 0xffffff00u + 2000));
  EXPECT_EQ(state.step, 2);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/control/profile.hpp"
#include "sixstep/control/slew.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<SlewState<Q15>> &&
              std::is_trivially_copyable_v<ProfileState<Q31>>);

template <class Scalar>
class SetpointShaping : public ::testing::Test {};
TYPED_TEST_SUITE(SetpointShaping, Scalars);

TYPED_TEST(SetpointShaping, SlewGoesInEvenStepsAndStopsExactly) {
  using S = TypeParam;
  const SlewConfig<S> config{Accumulator<S>(0.03125)};
  SlewState<S> state;
  for (int n = 1; n <= 24; ++n) EXPECT_EQ(slew_step(config, state, S(0.76)), S(0.03125 * n));
  EXPECT_EQ(slew_step(config, state, S(0.76)), S(0.76));
  EXPECT_EQ(slew_step(config, state, S(0.76)), S(0.76));
  for (int n = 1; n <= 48; ++n) slew_step(config, state, S(-0.76));
  EXPECT_GT(state.y, Accumulator<S>(-0.76));
  EXPECT_EQ(slew_step(config, state, S(-0.76)), S(-0.76));
  EXPECT_EQ(slew_step(SlewConfig<S>{}, state, S(1.0)), S(-0.76)) << "the default never moves";
}

TYPED_TEST(SetpointShaping, SlewKeepsStepsBelowTheLastBit) {
  using S = TypeParam;
  if constexpr (is_fixed<S>) {
    const SlewConfig<S> config{Accumulator<S>(digit<S>() / 16)};
    SlewState<S> state;
    for (int n = 0; n < 16 * 20; ++n) slew_step(config, state, S(1.0));
    EXPECT_EQ(slew_step(config, state, S(1.0)).raw, 20);
  }
}

/// A profile in whole digits, computed by hand. The acceleration is a = 1, the speed limit 3, the distance
/// 12.
TYPED_TEST(SetpointShaping, ProfileIsTheFastestThatCanStop) {
  using S = TypeParam;
  const double unit = is_fixed<S> ? digit<S>() : 1.0;
  const ProfileConfig<S> config{S(3 * unit), S(unit)};
  ProfileState<S> state;
  std::vector<double> steps;
  double before = 0;
  for (int n = 0; n < 8; ++n) {
    const double x = static_cast<double>(profile_step(config, state, S(12 * unit))) / unit;
    steps.push_back(x - before);
    before = x;
  }
  EXPECT_EQ(steps, (std::vector<double>{1, 2, 3, 3, 2, 1, 0, 0}));
}

TYPED_TEST(SetpointShaping, ProfileKeepsItsLimitsAndStandsOnTheTarget) {
  using S = TypeParam;
  constexpr int seed = 75;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-0.9, 0.9), share(0.002, 0.02), steep(0.02, 1.0);
  for (int run = 0; run < 300; ++run) {
    const double speed = share(random);
    const ProfileConfig<S> config{static_cast<S>(speed), static_cast<S>(speed * steep(random))};
    ProfileState<S> state;
    state.position = static_cast<S>(any(random));
    const double a = static_cast<double>(config.acceleration), w = static_cast<double>(config.speed);
    // The error is a few roundings per tick of sums that are below 2.
    const double near = is_fixed<S> ? 0.0 : 8 * digit<S>();
    for (int leg = 0; leg < 3; ++leg) {
      const auto target = static_cast<S>(any(random));
      // In the second motion, a new target arrives before the end.
      const int ticks = leg == 1 ? 20 : 100000;
      const double start = static_cast<double>(state.position), v0 = static_cast<double>(state.velocity);
      int n = 0;
      for (; n < ticks; ++n) {
        const double x = static_cast<double>(state.position), v = static_cast<double>(state.velocity);
        if (x == static_cast<double>(target) && v == 0) break;
        const double next = static_cast<double>(profile_step(config, state, target));
        const double travel = next - x;
        ASSERT_LE(std::fabs(travel), w + near) << "seed " << seed << " run " << run;
        ASSERT_LE(std::fabs(travel - v), a + near) << "seed " << seed << " run " << run;
      }
      if (leg == 1) continue;
      ASSERT_EQ(state.position, target) << "seed " << seed << " run " << run;
      // The time is at most the time of the continuous profile, plus the time to reverse the initial speed v0
      // and a few ticks of rounding.
      const double way = std::fabs(static_cast<double>(target) - start) + v0 * v0 / a;
      const double best = way > w * w / a ? way / w + w / a : 2 * std::sqrt(way / a);
      ASSERT_LE(n, best + 2 * std::fabs(v0) / a + 4) << "seed " << seed << " run " << run;
      ASSERT_EQ(profile_step(config, state, target), target);
    }
  }
}

TYPED_TEST(SetpointShaping, ProfileSurvivesTheEndsOfItsRange) {
  using S = TypeParam;
  for (const ProfileConfig<S>& config :
       {ProfileConfig<S>{S(1.9), S(digit<S>())}, ProfileConfig<S>{S(1.9), S(1.9)}, ProfileConfig<S>{},
        ProfileConfig<S>{S(digit<S>()), S(1.9)}, ProfileConfig<S>{S(1.0), S(0.0)}}) {
    ProfileState<S> state;
    state.position = S(-1.99);
    for (int n = 0; n < 2000; ++n) {
      const S x = profile_step(config, state, S(1.99));
      EXPECT_TRUE(x >= S(-1.99) && x <= S(1.99));
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE

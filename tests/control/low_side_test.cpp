// SPDX-License-Identifier: Apache-2.0
// The block of low-side shunts (control/low_side.hpp) in every scalar: which legs a sample shows, reconstruction by
// the sum of the currents, and the share of angles at which space vector modulation leaves two legs.
#include "sixstep/control/low_side.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<LowSideState<Q15>> &&
              std::is_trivially_copyable_v<LowSideConfig<Q15>>);

template <class Scalar>
class LowSide : public ::testing::Test {};
TYPED_TEST_SUITE(LowSide, Scalars);

TYPED_TEST(LowSide, TwoLegsGiveTheThirdByTheSumOfTheCurrents) {
  using S = TypeParam;
  const S sample[3] = {S(0.25), S(-0.125),
                       S(0.5)};  // the sum is not 0: one of them is a leg that is not shown
  for (unsigned hidden = 0; hidden < 3; ++hidden) {
    LowSideState<S> state;
    low_side_legs(state, static_cast<std::uint8_t>(7U & ~(1U << hidden)), sample);
    EXPECT_EQ(state.leg_A[0] + state.leg_A[1] + state.leg_A[2], S{});
    for (unsigned k = 0; k < 3; ++k)
      if (k != hidden) {
        EXPECT_EQ(state.leg_A[k], sample[k]);
      }
    EXPECT_EQ(state.blind, 0U);
  }
  LowSideState<S> state;
  low_side_legs(state, 7, sample);
  for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(state.leg_A[k], sample[k]) << "three legs are taken as they are";
}

TYPED_TEST(LowSide, FewerThanTwoLegsKeepTheLastCurrents) {
  using S = TypeParam;
  const S first[3] = {S(0.25), S(-0.125), S(-0.125)}, second[3] = {S(0.5), S(0.5), S(0.5)};
  LowSideState<S> state;
  low_side_legs(state, 7, first);
  for (const unsigned shown : {0U, 1U, 2U, 4U})
    low_side_legs(state, static_cast<std::uint8_t>(shown), second);
  for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(state.leg_A[k], first[k]);
  EXPECT_EQ(state.samples, 5U);
  EXPECT_EQ(state.blind, 4U);
}

TYPED_TEST(LowSide, OneLegOfAPairIsEnough) {
  using S = TypeParam;
  const Pair pair{Leg::b, Leg::c};
  const S sample[3] = {S(0.75), S(0.25), S(-0.5)};
  LowSideState<S> state;
  EXPECT_EQ(low_side_pair(state, 0b010, pair, false, sample), S(0.25)) << "the source";
  EXPECT_EQ(low_side_pair(state, 0b100, pair, false, sample), S(0.5)) << "the sink";
  EXPECT_EQ(low_side_pair(state, 0b111, pair, false, sample), S(0.375)) << "half the difference";
  EXPECT_EQ(low_side_pair(state, 0b001, pair, false, sample), S(0.375))
      << "the free leg shows nothing of the pair";
  EXPECT_EQ(low_side_pair(state, 0, swapped(pair), true, sample), S(0.375))
      << "kept: the command turns, not the current";
  EXPECT_EQ(low_side_pair(state, 0b100, swapped(pair), true, sample), S(0.5))
      << "the source of the reversed pair";
  EXPECT_EQ(state.samples, 6U);
  EXPECT_EQ(state.blind, 2U);
}

TYPED_TEST(LowSide, ALegIsShownWhileItsCurrentFlowsBelow) {
  using S = TypeParam;
  const LowSideConfig<S> start{.shunts = 7, .greatest_duty = S(0.75)};
  const LowSideConfig<S> middle{.shunts = 7, .greatest_duty = S{}, .least_duty = S(0.25)};
  const auto shows = [](const LowSideConfig<S>& config, LegState state, PwmSwitches switches, double duty) {
    return shows_current(config, LegCommand<S>{state, switches, S(duty)});
  };
  using enum PwmSwitches;
  for (const LowSideConfig<S>& config : {start, middle}) {
    EXPECT_TRUE(shows(config, LegState::low, complementary, 0.0));
    EXPECT_FALSE(shows(config, LegState::high, complementary, 0.0));
    EXPECT_FALSE(shows(config, LegState::off, complementary, 0.0));
  }
  for (const PwmSwitches both : {complementary, upper}) {  // after its pulse the current is below
    EXPECT_TRUE(shows(start, LegState::pwm, both, 0.75));
    EXPECT_FALSE(shows(start, LegState::pwm, both, 0.75 + 1.0 / 256));
    EXPECT_FALSE(shows(middle, LegState::pwm, both, 0.5));
  }
  for (const PwmSwitches below : {lower, lower_first}) {  // after its pulse the current is above
    EXPECT_FALSE(shows(start, LegState::pwm, below, 0.5));
    EXPECT_TRUE(shows(middle, LegState::pwm, below, 0.25));
    EXPECT_FALSE(shows(middle, LegState::pwm, below, 0.25 - 1.0 / 256));
  }
  LegCommand<S> legs[3] = {{LegState::low, complementary, S{}}, {LegState::low, complementary, S{}}, {}};
  EXPECT_EQ(shown_legs(start, legs), 0b011);
  EXPECT_EQ(shown_legs(LowSideConfig<S>{.shunts = 0b110}, legs), 0b010) << "no shunt, no sample";
  EXPECT_EQ(shown_legs(LowSideConfig<S>{}, legs), 0) << "the default has no shunts";
}

/// Share of a turn in which fewer than two legs are shown.
double blind_share(std::uint8_t shunts, double greatest, double modulation) {
  constexpr int steps = 36000;
  const LowSideConfig<double> config{.shunts = shunts, .greatest_duty = greatest};
  int blind = 0;
  for (int n = 0; n < steps; ++n) {
    const double angle = 2 * std::numbers::pi * (n + 0.5) / steps, third = 2 * std::numbers::pi / 3;
    const double v = modulation / std::sqrt(3.0);
    const auto legs = space_vector(
        Abc<double>{v * std::cos(angle), v * std::cos(angle - third), v * std::cos(angle + third)}, 1.0);
    blind += std::popcount(shown_legs(config, legs.leg)) < 2;
  }
  return static_cast<double>(blind) / steps;
}

/// With two shunts a leg's duty must stay below the limit over its whole turn: 1/2 + m/2 at most. With three the
/// second largest must: 1/2 + sqrt(3)/4 m.
TEST(LowSideModulation, TwoShuntsMeasureUpToALowerModulationThanThree) {
  for (const double d : {0.7, 0.8, 0.9}) {
    const double two = 2 * (d - 0.5), three = 4 / std::sqrt(3.0) * (d - 0.5);
    EXPECT_EQ(blind_share(0b011, d, 0.999 * two), 0.0);
    EXPECT_GT(blind_share(0b011, d, 1.01 * two), 0.0);
    EXPECT_EQ(blind_share(0b111, d, 0.999 * three), 0.0);
    EXPECT_GT(blind_share(0b111, d, 1.01 * three), 0.0);
  }
}

/// Arc in rad over which one leg's duty is above d. Within 60 degrees of its axis the leg is the largest, with the duty
/// 1/2 + (m/2) cos(x - 30 degrees), which has a maximum to either side of the axis. Beyond, the leg is the middle one:
/// 1/2 + (sqrt(3)/2) m cos(x).
double hidden_arc(double d, double m) {
  const double c = 2 * d - 1;
  if (m <= c) return 0.0;
  return m * std::cos(std::numbers::pi / 6) <= c ? 4 * std::acos(c / m)
                                                 : 2 * std::acos(c / (std::sqrt(3.0) * m));
}

TEST(LowSideModulation, TheBlindShareIsTheArcOfTheDuty) {
  for (const double d : {0.8, 0.9})
    for (const double m : {0.5, 0.7, 0.82, 0.9, 0.95, 1.0}) {
      const double each = hidden_arc(d, m);  // the arcs of two legs are 120 degrees apart
      const double both = std::max(0.0, each - 2 * std::numbers::pi / 3);
      EXPECT_NEAR(blind_share(0b011, d, m), (2 * each - both) / (2 * std::numbers::pi), 2e-4)
          << d << " " << m;
      EXPECT_NEAR(blind_share(0b111, d, m), 3 * both / (2 * std::numbers::pi), 2e-4) << d << " " << m;
    }
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/feed_forward.hpp"
#include "sixstep/control/gates.hpp"
#include "sixstep/control/smooth_chopping.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<SmoothChoppingState<Q15>>);

template <class Scalar>
class Limits : public ::testing::Test {};
TYPED_TEST_SUITE(Limits, Scalars);

TYPED_TEST(Limits, TheDefaultAllowsNothingAndTheCurrentLimitIsSymmetric) {
  using S = TypeParam;
  const CurrentWindow<S> none = current_window(LimitsConfig<S>{}, S(0.5), S(0.5));
  EXPECT_TRUE(none.low == S{} && none.high == S{});
  LimitsConfig<S> config;
  config.current_A = S(0.75);
  const CurrentWindow<S> w = current_window(config, S(0.5), S(0.5));
  EXPECT_TRUE(w.low == S(-0.75) && w.high == S(0.75));
  EXPECT_EQ(current_of_torque(S(0.25), Gain<S>(3.0)), S(0.75));
}

TYPED_TEST(Limits, SpeedFoldsTheDrivingSideBackAndLeavesBraking) {
  using S = TypeParam;
  LimitsConfig<S> config;
  config.current_A = S(0.75);
  config.limits_speed = true;
  config.speed_rad_s = S(0.5);
  config.A_per_rad_s = Gain<S>(4.0);
  for (const double w : {-1.0, -0.6, -0.5, -0.45, -0.25, 0.0, 0.25, 0.45, 0.5, 0.6, 1.0}) {
    const CurrentWindow<S> window = current_window(config, S(w), S{});
    const double high = std::fmin(0.75, std::fmax(0.0, 4 * (0.5 - w)));
    const double low = -std::fmin(0.75, std::fmax(0.0, 4 * (0.5 + w)));
    // The error has two parts: the error of the rounded speed times the gain, and the rounding of the
    // product.
    EXPECT_NEAR(static_cast<double>(window.high), high, 3 * digit<S>()) << w;
    EXPECT_NEAR(static_cast<double>(window.low), low, 3 * digit<S>()) << w;
  }
}

TYPED_TEST(Limits, RegenerationTakesBrakingAwayAsTheBusRises) {
  using S = TypeParam;
  LimitsConfig<S> config;
  config.current_A = S(0.75);
  config.limits_regeneration = true;
  config.bus_V = S(0.875);
  config.A_per_V = Gain<S>(6.0);
  const auto at = [&](double w, double bus) { return current_window(config, S(w), S(bus)); };
  EXPECT_TRUE(at(0.5, 0.5).low == S(-0.75) && at(0.5, 0.5).high == S(0.75)) << "far below: all of it";
  EXPECT_TRUE(at(0.5, 0.8125).low == S(-0.375) && at(0.5, 0.8125).high == S(0.75)) << "driving is free";
  EXPECT_TRUE(at(-0.5, 0.8125).low == S(-0.75) && at(-0.5, 0.8125).high == S(0.375));
  EXPECT_TRUE(at(0.5, 0.875).low == S{} && at(0.5, 1.5).low == S{}) << "none at and above the limit";
  EXPECT_TRUE(at(0.0, 1.5).low == S(-0.75)) << "at rest nothing comes back";
}

/// The whole braking current i charges the bus capacitor C: C dU/dt = i. The bus voltage U must stay below
/// its limit.
TYPED_TEST(Limits, ABusThatCannotSinkStaysBelowItsLimit) {
  using S = TypeParam;
  LimitsConfig<S> config;
  config.current_A = S(0.75);
  config.limits_regeneration = true;
  config.bus_V = S(0.875);
  config.A_per_V = Gain<S>(6.0);
  const double T_over_C = 0.02;  // the loop's gain per period, g T/C = 0.12, is well below 1
  double bus = 0.5;
  for (int n = 0; n < 500; ++n) {
    bus += T_over_C * -static_cast<double>(current_window(config, S(0.5), S(bus)).low);
    ASSERT_LT(bus, 0.875 + digit<S>()) << n;
  }
  EXPECT_GT(bus, 0.87) << "and uses what room there is";
}

TYPED_TEST(Limits, AtALimitTheBridgeIsOffUnlessTheReferenceLeadsAway) {
  using S = TypeParam;
  LimitsConfig<S> config;
  config.current_A = S(0.5);
  config.limits_speed = config.limits_regeneration = true;
  config.speed_rad_s = S(0.5);
  config.bus_V = S(0.75);
  const auto coasts = [&](double i_ref, double w, double bus) {
    return must_coast(config, S(i_ref), S(w), S(bus));
  };
  for (const double sign : {1.0, -1.0}) {
    EXPECT_FALSE(coasts(sign * 0.25, sign * 0.5, 0.75)) << "at both limits, beyond none";
    EXPECT_TRUE(coasts(0.0, sign * 0.51, 0.5)) << "a reference of 0 may drive by its ripple";
    EXPECT_TRUE(coasts(sign * 0.25, sign * 0.51, 0.5));
    EXPECT_FALSE(coasts(sign * -0.25, sign * 0.51, 0.5)) << "braking leads back";
    EXPECT_TRUE(coasts(sign * -0.25, sign * 0.3, 0.76)) << "braking feeds back";
    EXPECT_TRUE(coasts(0.0, sign * 0.3, 0.76));
    EXPECT_FALSE(coasts(sign * 0.25, sign * 0.3, 0.76)) << "driving takes from the bus";
    EXPECT_TRUE(coasts(sign * -0.25, sign * 0.51, 0.76)) << "nothing leads away from both";
  }
  EXPECT_FALSE(coasts(0.25, 0.0, 0.76)) << "at rest nothing feeds back, and the drive must start";
}

TYPED_TEST(Limits, APhaseAFourthAboveTheLimitIsOverIt) {
  using S = TypeParam;
  LimitsConfig<S> config;
  config.current_A = S(0.5);
  for (const double sign : {1.0, -1.0})
    for (int phase = 0; phase < 3; ++phase) {
      Measurement<S> m;
      S* const i[3] = {&m.i_a_A, &m.i_b_A, &m.i_c_A};
      *i[phase] = S(sign * 0.625);
      EXPECT_FALSE(over_limit(config, m));
      *i[phase] = S(sign * 0.6254);
      EXPECT_TRUE(over_limit(config, m));
    }
}

TYPED_TEST(Limits, FeedForwardAndBusCompensationByHand) {
  using S = TypeParam;
  EXPECT_EQ(back_emf_voltage(FeedForwardConfig<S>{Gain<S>(1.5)}, S(-0.5)), S(-0.75));
  EXPECT_EQ(back_emf_voltage(FeedForwardConfig<S>{}, S(1.0)), S{});
  const BusCompensationConfig<S> bus{S(0.25)};
  EXPECT_EQ(compensated_duty(bus, S(0.25), S(0.5)), S(0.5));
  EXPECT_EQ(compensated_duty(bus, S(0.75), S(0.5)), S(1.0));
  EXPECT_EQ(compensated_duty(bus, S(-0.75), S(0.5)), S(-1.0));
  EXPECT_EQ(compensated_duty(bus, S(0.125), S(0.0)), S(0.5)) << "a lost sensor divides by the lowest bus";
}

TYPED_TEST(Limits, ChoppingIsComplementaryWhereverTheCurrentMayReverse) {
  using S = TypeParam;
  const SmoothChoppingConfig<S> config{S(0.2), S(0.1)};
  SmoothChoppingState<S> state;
  const auto at = [&](bool reversed, double i) {
    return smooth_chopping_step(config, state, reversed, S(i));
  };
  EXPECT_EQ(at(false, 0.0), Chopping::complementary);
  EXPECT_EQ(at(false, 0.15), Chopping::complementary) << "between the levels: as before";
  EXPECT_EQ(at(false, 0.25), Chopping::soft);
  EXPECT_EQ(at(false, 0.15), Chopping::soft);
  EXPECT_EQ(at(false, 0.05), Chopping::complementary);
  EXPECT_EQ(at(false, -0.5), Chopping::complementary) << "braking with a positive duty";
  EXPECT_EQ(at(true, -0.5), Chopping::soft) << "the same current driven by a negative one";
}

/// If the duty d approaches 0 from either side, only the gates of the off-time act. With complementary
/// chopping, both sides have the same gates; with the other kinds of chopping, they do not.
TEST(Chopping, OnlyComplementaryIsContinuousThroughZero) {
  const auto off_time = [](bool reversed, Chopping chopping) {
    const Pair p{Leg::a, Leg::b};
    BridgeCommand<double> c{.enabled = true, .pair = reversed ? Pair{p.sink, p.source} : p};
    c.chopping = chopping;
    return gates(c, false);
  };
  EXPECT_EQ(off_time(false, Chopping::complementary), off_time(true, Chopping::complementary));
  EXPECT_NE(off_time(false, Chopping::soft), off_time(true, Chopping::soft));
}

TEST(Gates, DrivenPairAsTheModelsTableSays) {
  // Bits 0, 2, 4 are the switches T1, T3, T5. Bits 1, 3, 5 are T2, T4, T6. Sector 1 drives T1 and T6.
  BridgeCommand<float> c{.enabled = true, .pair = {Leg::a, Leg::c}};
  EXPECT_EQ(gates(c, true), 0b100001);
  EXPECT_EQ(gates(c, false), 0b100000);
  c.chopping = Chopping::hard;
  EXPECT_EQ(gates(c, false), 0);
  c.chopping = Chopping::complementary;
  EXPECT_EQ(gates(c, false), 0b100010);
  c.enabled = false;
  EXPECT_EQ(gates(c, true), 0);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The PI blocks in every scalar type are compared with the double version, within the resolution of each
// type.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/control/pi.hpp"
#include "sixstep/control/pi_positional.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<PiState<Q15>> && std::is_trivially_copyable_v<PiState<Q31>> &&
              std::is_trivially_copyable_v<PiPositionalState<Q15>>);

template <class Scalar>
class PiScalars : public ::testing::Test {};
TYPED_TEST_SUITE(PiScalars, Scalars);

/// The gain with the rounding of the format, as a double for the comparison.
template <class S>
double held(double gain) {
  return static_cast<double>(static_cast<Gain<S>>(gain));
}

TYPED_TEST(PiScalars, FollowsExactArithmeticOnTheSameGains) {
  using S = TypeParam;
  constexpr int seed = 6150;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  const double d1 = held<S>(4.0956), K_i = held<S>(0.4016);
  const PiConfig<S> config = pi<S>(d1, K_i, 0.9);
  PiState<S> state;
  double u = 0, before = 0;
  double worst = 0;
  for (int n = 0; n < 2000; ++n) {
    // The random error keeps the output away from its limits. If only one of the two calculations were
    // clamped, the results would differ permanently.
    const auto e = static_cast<S>(any(random) - 0.05 * static_cast<double>(u));
    u = u + d1 * (static_cast<double>(e) - before) + K_i * before;
    before = static_cast<double>(e);
    ASSERT_LT(std::fabs(static_cast<double>(u)), 0.9) << "seed " << seed;
    worst = std::fmax(worst, std::fabs(static_cast<double>(pi_step(config, state, e)) - u));
  }
  // Rounding per sample. In fixed point, two increments are each rounded by half a digit of the sum. In
  // floating point, three numbers below 1 are each rounded by half an epsilon. The output is rounded once.
  const double rounding = is_fixed<S> ? digit<S>() * std::ldexp(1.0, 4 - 8 * int{sizeof(S)}) : 2 * digit<S>();
  EXPECT_LE(worst, 2000 * rounding + 2 * digit<S>()) << "seed " << seed;
}

TYPED_TEST(PiScalars, ASmallIntegralGainDoesNotVanish) {
  using S = TypeParam;
  // The error e is 40 digits. The increment per sample is 1.3e-4 e, which is 2^-8 of a digit. It must
  // accumulate.
  const double e = 40 * std::ldexp(1.0, -14), K_i = held<S>(1.3378e-4);
  const PiConfig<S> config = pi<S>(held<S>(0.0158299), K_i, 0.9);
  PiState<S> state;
  double u = 0;
  for (int n = 0; n < 10000; ++n) u = static_cast<double>(pi_step(config, state, static_cast<S>(e)));
  const double exact = held<S>(0.0158299) * e + 9999 * K_i * e;
  // The rounding of each increment: in fixed point, a digit of the sum (with 16 bits, 2^-12 of 2^-14); in
  // float, an epsilon of u.
  const double rounding =
      is_fixed<S> ? digit<S>() * std::ldexp(1.0, 4 - 8 * int{sizeof(S)}) : digit<S>() * exact;
  // In float, the difference d0 = K_i - d1 has an error of an epsilon of d1. This error acts like an error of
  // K_i.
  const double cancelled = is_fixed<S> ? 0 : 10000 * e * 0.0158299 * digit<S>();
  EXPECT_NEAR(u, exact, 10000 * rounding + digit<S>() + cancelled);
}

/// While the integral pauses, u changes by d1 times the change of the error. Afterwards, u continues from the
/// value reached.
TYPED_TEST(PiScalars, WaitsAndGoesOnFromThere) {
  using S = TypeParam;
  const double d1 = held<S>(0.75), K_i = held<S>(0.125);
  const PiConfig<S> config = pi<S>(d1, K_i, 0.9);
  PiState<S> state;
  pi_step(config, state, S(0.25));
  for (const double e : {0.5, -0.25, 0.125})
    EXPECT_NEAR(static_cast<double>(pi_wait(config, state, S(e))), d1 * e, 4 * digit<S>());
  EXPECT_NEAR(static_cast<double>(pi_step(config, state, S(0.125))), (d1 + K_i) * 0.125, 4 * digit<S>());
}

TYPED_TEST(PiScalars, LeavesTheLimitWithTheFirstSampleOfTheOtherSign) {
  using S = TypeParam;
  const PiConfig<S> config = pi<S>(1.0, 0.25, 0.5);
  PiState<S> state;
  for (int n = 0; n < 1000; ++n) EXPECT_LE(pi_step(config, state, S(0.5)), S(0.5));
  EXPECT_EQ(pi_step(config, state, S(0.5)), S(0.5));
  // The sum is 0.5 - 1.0*(0.25 + 0.5) + 0.25*0.5.
  EXPECT_NEAR(static_cast<double>(pi_step(config, state, S(-0.25))), -0.125, 2 * digit<S>());
  for (int n = 0; n < 1000; ++n) pi_step(config, state, S(-1.9));
  EXPECT_EQ(pi_step(config, state, S(-1.9)), S(-0.5)) << "a jump beyond the range saturates, it never wraps";
}

TYPED_TEST(PiScalars, LargeJumpsAreNotCutBeforeTheLimit) {
  using S = TypeParam;
  // A change of the error from 0.8 to -0.8 at a gain of 4.5 changes the sum by -7.2. The output changes
  // directly from +0.9 to -0.9, although signals are limited to 2.
  const PiConfig<S> config = pi<S>(4.5, 0.0, 0.9);
  PiState<S> state;
  EXPECT_EQ(pi_step(config, state, S(0.8)), S(0.9));
  EXPECT_EQ(pi_step(config, state, S(-0.8)), S(-0.9));
}

TYPED_TEST(PiScalars, PositionalIsTheVelocityFormAwayFromTheLimit) {
  using S = TypeParam;
  const PiConfig<S> velocity = pi<S>(1.5, 0.125, 1.9);
  const PiPositionalConfig<S> positional{Gain<S>(1.5), Gain<S>(0.125), Gain<S>(0.5), S(1.9)};
  PiState<S> a;
  PiPositionalState<S> b;
  std::mt19937_64 random{11};
  std::uniform_real_distribution<double> any(-0.02, 0.02);
  for (int n = 0; n < 200; ++n) {
    const auto e = static_cast<S>(any(random));
    const double u = static_cast<double>(pi_step(velocity, a, e));
    EXPECT_NEAR(static_cast<double>(pi_positional_step(positional, b, e)), u,
                1 * digit<S>() * (1 + n * !is_fixed<S>))
        << n;
  }
}

/// At the limit, the integral I settles at the value for which K_i e = K_b (v - limit), with the sum v = I +
/// K e and the error e. The excess v - limit is therefore K_i e/K_b.
TYPED_TEST(PiScalars, BackCalculationHoldsTheIntegralNearTheLimit) {
  using S = TypeParam;
  const double e = 0.25, K = 1.5, K_i = 0.125;
  for (const double K_b : {0.25, 0.5, 1.0}) {
    const auto K_c = static_cast<Gain<S>>(gain_beyond_limit(K, K_i, K_b));
    const PiPositionalConfig<S> config{Gain<S>(K), Gain<S>(K_i), Gain<S>(K_b), S(0.5), K_c};
    PiPositionalState<S> state;
    for (int n = 0; n < 500; ++n) pi_positional_step(config, state, S(e));
    EXPECT_EQ(pi_positional_step(config, state, S(e)), S(0.5));
    const double integral = static_cast<double>(ScalarTraits<S>::signal(state.integral));
    EXPECT_NEAR(integral, 0.5 + K_i * e / K_b - K * e, 2 * digit<S>() / K_b) << K_b;
  }
  PiPositionalState<S> winding;
  const PiPositionalConfig<S> open{Gain<S>(K), Gain<S>(K_i), Gain<S>(0.0), S(0.5), Gain<S>(K_i)};
  for (int n = 0; n < 40; ++n) pi_positional_step(open, winding, S(e));
  EXPECT_NEAR(static_cast<double>(ScalarTraits<S>::signal(winding.integral)), 40 * K_i * e, 1e-3)
      << "without it the integral winds up";
}

/// The product K e exceeds 16 times a signal's range, which is the limit of every fixed-point sum. The
/// integral stays at the limit, and the output leaves the limit at the first small error.
TYPED_TEST(PiScalars, NothingWindsUpWhereTheProportionalPartSaturates) {
  using S = TypeParam;
  const double K = 200, K_i = 20, K_b = K_i / K;
  const PiPositionalConfig<S> config{Gain<S>(K), Gain<S>(K_i), Gain<S>(K_b), S(0.5),
                                     static_cast<Gain<S>>(gain_beyond_limit(K, K_i, K_b))};
  PiPositionalState<S> state;
  for (int n = 0; n < 5000; ++n) EXPECT_EQ(pi_positional_step(config, state, S(0.75)), S(0.5));
  // An excess below half a digit/K_b is rounded to zero.
  EXPECT_NEAR(static_cast<double>(ScalarTraits<S>::signal(state.integral)), 0.5, digit<S>() / (2 * K_b));
  EXPECT_LT(static_cast<double>(pi_positional_step(config, state, S(-0.0015))), 0.25);
}

TYPED_TEST(PiScalars, FeedForwardSharesTheLimitOfThePositionalForm) {
  using S = TypeParam;
  const PiPositionalConfig<S> config{Gain<S>(1.0), Gain<S>(0.0), Gain<S>(0.0), S(0.75)};
  PiPositionalState<S> state;
  EXPECT_EQ(pi_positional_step(config, state, S(0.25), S(0.25)), S(0.5));
  EXPECT_EQ(pi_positional_step(config, state, S(0.75), S(0.25)), S(0.75));
  EXPECT_EQ(pi_positional_step(PiPositionalConfig<S>{}, state, S(0.75), S(0.25)), S{}) << "default: nothing";
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/adc.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/derivative.hpp"
#include "sixstep/control/one_shunt.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<AdcState> && std::is_trivially_copyable_v<OneShuntState<Q15>>);

template <class Scalar>
class Sensing : public ::testing::Test {};
TYPED_TEST_SUITE(Sensing, Scalars);

/// A 12-bit converter with 0.0005 per count around 2048.
template <class S>
AdcConfig<S> adc() {
  return {per_count<S>(0.0000625), 2048, 20, 4};
}

TYPED_TEST(Sensing, CountsBecomeSignalsAroundTheMeasuredOffset) {
  using S = TypeParam;
  AdcState state;
  // In 16-bit formats, the gain has a relative error of 2^-15, and the product has an error of one digit.
  const double near = digit<S>() + std::ldexp(1.0, -15) * (is_fixed<S> ? 1 : 0);
  EXPECT_NEAR(static_cast<double>(adc_value(adc<S>(), state, 2148)), 0.05, near) << "the circuit's offset";
  for (int n = 0; n < 15; ++n)
    EXPECT_EQ(adc_calibrate(adc<S>(), state, static_cast<std::uint16_t>(2055 + n % 2)), Calibration::running);
  EXPECT_EQ(adc_calibrate(adc<S>(), state, 2056), Calibration::done);
  EXPECT_EQ(state.offset_eighths, 8 * 2055 + 4) << "the mean, 2055.5, below a count";
  for (const int counts : {0, 1000, 2055, 2056, 3000, 4095})
    EXPECT_NEAR(static_cast<double>(adc_value(adc<S>(), state, static_cast<std::uint16_t>(counts))),
                0.0005 * (counts - 2055.5), near * 2)
        << counts;
}

TYPED_TEST(Sensing, AnOffsetFarFromTheCircuitsFailsAndIsNotUsed) {
  using S = TypeParam;
  for (const std::uint16_t counts : {std::uint16_t{2027}, std::uint16_t{2069}, std::uint16_t{0}}) {
    AdcState state;
    Calibration last = Calibration::running;
    for (int n = 0; n < 16; ++n) last = adc_calibrate(adc<S>(), state, counts);
    EXPECT_EQ(last, Calibration::failed);
    EXPECT_LT(state.offset_eighths, 0);
  }
  EXPECT_EQ(static_cast<double>(adc_value(AdcConfig<S>{}, AdcState{}, 4095)), 0.0) << "the default reads 0";
}

template <class S>
OneShuntConfig<S> shunt() {
  return {S(0.1), 10, S(0.5)};
}

TYPED_TEST(Sensing, OneShuntShowsTheDrivenCurrentInTheOnTimeOnly) {
  using S = TypeParam;
  OneShuntState<S> state;
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.25)), S(0.25));
  EXPECT_EQ(state.hidden, 0);
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.1), S(0.9)), S(0.125)) << "too short: fades";
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.0), S(0.9)), S(0.0625));
  EXPECT_EQ(state.hidden, 2);
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, true, S(0.5), S(0.25)), S(-0.25)) << "a negative command";
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.05), S(0.9)), S(-0.125))
      << "the sign of the command turns, the current does not";
  EXPECT_EQ(one_shunt_step(OneShuntConfig<S>{}, state, false, S(1.0), S(0.9)), S{})
      << "the default sees nothing";
}

/// During the commutation, the current of the incoming phase rises exponentially to the constant current of
/// the staying phase. The motor current i_m is the mean of these two currents.
TYPED_TEST(Sensing, OneShuntCorrectsForTheIncomingPhase) {
  using S = TypeParam;
  OneShuntState<S> state;
  one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.4));
  one_shunt_commutation(shunt<S>(), state);
  for (int n = 0; n < 8; ++n) {
    const double incoming = 0.4 * n / 8;
    const double i_m = static_cast<double>(one_shunt_step(shunt<S>(), state, false, S(0.5), S(incoming)));
    EXPECT_NEAR(i_m, (0.4 + incoming) / 2, 2 * digit<S>());
  }
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.41)), S(0.41)) << "commutation is over";
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.3)), S(0.3));
  one_shunt_commutation(shunt<S>(), state);
  for (int n = 0; n < 10; ++n) one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.0));
  EXPECT_EQ(one_shunt_step(shunt<S>(), state, false, S(0.5), S(0.0)), S{}) << "not corrected for ever";
}

TYPED_TEST(Sensing, PhaseCurrentsOfAPairGiveBackTheMotorCurrent) {
  using S = TypeParam;
  for (std::uint8_t s = 0; s < 6; ++s) {
    Measurement<S> m;
    set_phase_currents(m, positive_pair(s), S(0.375));
    EXPECT_EQ(motor_current(m, positive_pair(s)), S(0.375));
    EXPECT_EQ(m.i_a_A + m.i_b_A + m.i_c_A, S{});
  }
}

TYPED_TEST(Sensing, DerivativeOfARampSettlesAtItsSlopeWithTheFilterTimeConstant) {
  using S = TypeParam;
  // The filter's factor is b = T_s/(T_f + T_s) = 1/8 (sample period T_s, filter time constant T_f). For a
  // ramp of r per sample and the gain g, the output settles at g r/b.
  const DerivativeConfig<S> config{Gain<S>(4.0), Gain<S>(0.125)};
  DerivativeState<S> state;
  const double r = 1.0 / 128;
  EXPECT_EQ(derivative_step(config, state, S(0.25)), Accumulator<S>{}) << "the first sample is no step";
  for (int n = 1; n <= 64; ++n) {
    const S seen = ScalarTraits<S>::signal(derivative_step(config, state, S(0.25 + r * n)));
    const double y = static_cast<double>(seen);
    // The exact output is y[n] = g r (1 - (1-b)^n)/b. In fixed point, y is rounded and fed back through b.
    // The error of b/2 digits per sample accumulates to half a digit.
    EXPECT_NEAR(y, 32 * r * (1 - std::pow(0.875, n)), 2 * digit<S>()) << n;
  }
}

TYPED_TEST(Sensing, ADerivativeMayExceedTheSignalItIsTakenOff) {
  using S = TypeParam;
  using T = ScalarTraits<S>;
  // The input rises by 0.4 per sample for four samples, and g/b = 16 (gain g, filter factor b). The output
  // approaches 6.4, which is more than three times a signal's range.
  const DerivativeConfig<S> config{Gain<S>(8.0), Gain<S>(0.5)};
  DerivativeState<S> state;
  double exact = 0;
  derivative_step(config, state, S(-0.8));
  for (int n = 1; n <= 4; ++n) {
    exact = exact / 2 + 8 * 0.4;
    const Accumulator<S> y = derivative_step(config, state, S(-0.8 + 0.4 * n));
    // A quarter of the output is within the signal's range. Each input x has an error of half a digit, which
    // the gain g increases to four digits.
    EXPECT_NEAR(4 * static_cast<double>(T::signal(T::share(y, Gain<S>(0.25)))), exact, 20 * digit<S>()) << n;
  }
  EXPECT_GT(exact, 5.9);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Tests a product's additions within the loops, and the speed loop that sets the duty (thesis 6.2.2).
#include "sixstep/control/drive_extras.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/control/drive.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<DriveState<Q15>> &&
              std::is_trivially_copyable_v<DriveConfig<Q31>>);

template <class S>
struct Bench {
  DriveConfig<S> config{};
  DriveState<S> state{};
  Measurement<S> measured{.bus_V = S(0.75), .hall = 0b100};
  Telemetry<S> telemetry{};
  BridgeCommand<S> tick(double setpoint) {
    return step(config, state, measured, Setpoint<S>{static_cast<S>(setpoint)}, telemetry);
  }
  explicit Bench(Mode mode) {
    config.mode = mode;
    config.current = pi<S>(1.0, 0.0, 0.75);
    config.nominal_bus_V = static_cast<Divisor<S>>(0.75);
    config.speed = pi<S>(1.0, 0.25, 1.0);
    config.current_at_full_torque_A = Gain<S>(1.0);
    config.current_limit_A = S(0.75);
    config.extras.on = true;
    config.extras.torque_fraction_per_A = Gain<S>(1.0);
  }
  void carry(double i) {
    measured.i_a_A = S(i);
    measured.i_b_A = S(-i);
  }
};

template <class Scalar>
class Extras : public ::testing::Test {};
TYPED_TEST_SUITE(Extras, Scalars);

TYPED_TEST(Extras, SpeedSetsTheDutyWithoutACurrentLoop) {
  Bench<TypeParam> b(Mode::speed);
  b.config.extras.on = false;
  b.config.speed_control = SpeedControl::duty;
  b.carry(0.5);
  b.measured.speed_rad_s = TypeParam(0.25);
  EXPECT_EQ(b.tick(0.5).duty, TypeParam(0.25));
  EXPECT_EQ(b.tick(0.5).duty, TypeParam(0.3125)) << "K_i times the error more";
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, TypeParam(0.5));
  const BridgeCommand<TypeParam> back = b.tick(-1.5);
  EXPECT_EQ(back.pair, swapped(positive_pair(0)));
  EXPECT_EQ(back.duty, one<TypeParam>);
}

TYPED_TEST(Extras, SwitchedOffTheyChangeNothing) {
  Bench<TypeParam> with(Mode::speed), without(Mode::speed);
  with.config.extras.limits_current = with.config.extras.slews_setpoint = with.config.extras.smooth_chopping =
      true;
  with.config.extras.on = false;
  without.config.extras = {};
  for (int n = 0; n < 50; ++n) EXPECT_EQ(with.tick(0.3 - 0.02 * n), without.tick(0.3 - 0.02 * n));
}

TYPED_TEST(Extras, OnButUnsetTheyKeepTheLoopsAsTheyAre) {
  Bench<TypeParam> with(Mode::speed), without(Mode::speed);
  with.config.extras.torque_fraction_per_A = {};
  without.config.extras = {};
  for (int n = 0; n < 20; ++n) {
    const double w = 0.3 - 0.02 * n;
    EXPECT_EQ(with.tick(w).duty, without.tick(w).duty) << n;
  }
}

TYPED_TEST(Extras, TheWindowLimitsTheReferenceAndTheSpeedPi) {
  using S = TypeParam;
  for (const Mode mode : {Mode::current, Mode::speed}) {
    Bench<S> b(mode);
    b.config.extras.limits_current = true;
    b.config.extras.limits.current_A = S(0.25);
    for (int n = 0; n < 200; ++n) b.tick(1.0);
    EXPECT_EQ(b.telemetry.current_reference_A, S(0.25));
    b.tick(-1.0);
    EXPECT_EQ(b.telemetry.current_reference_A, S(-0.25)) << "not wound up: back with the first sample";
  }
}

/// Above the speed limit, all gates are off. Below it, the loop continues from its last output.
TYPED_TEST(Extras, AtALimitTheLoopWaitsWithTheBridgeOff) {
  using S = TypeParam;
  Bench<S> b(Mode::current), free(Mode::current);
  b.config.extras.limits_current = b.config.extras.limits.limits_speed = true;
  b.config.extras.limits = {S(0.5), true, S(0.5), Gain<S>(4.0)};
  for (Bench<S>* bench : {&b, &free}) bench->tick(0.25);
  b.measured.speed_rad_s = S(0.6);
  const BridgeCommand<S> off = b.tick(0.25);
  EXPECT_FALSE(off.enabled || off.fault);
  EXPECT_EQ(b.telemetry.duty, S{});
  b.measured.speed_rad_s = S(0.25);
  EXPECT_EQ(b.tick(0.25), free.tick(0.25));
  b.carry(0.7);
  EXPECT_FALSE(b.tick(0.25).enabled) << "0.7 is more than 5/4 of 0.5";
}

TYPED_TEST(Extras, BackEmfAndMeasuredBusEnterTheDuty) {
  using S = TypeParam;
  Bench<S> b(Mode::current);
  b.config.extras.feed_forward.K_t_V_s = Gain<S>(0.5);
  b.measured.speed_rad_s = S(0.75);
  // The voltage u = 0.125 + 0.375 is divided first by the nominal bus voltage 0.75, then by the measured bus
  // voltage.
  EXPECT_NEAR(static_cast<double>(b.tick(0.125).duty), 0.5 / 0.75, 3 * digit<S>());
  b.config.extras.bus.lowest_bus_V = S(0.5);
  b.measured.bus_V = S(1.0);
  EXPECT_NEAR(static_cast<double>(b.tick(0.125).duty), 0.5, 3 * digit<S>());
  // The PI's limit also applies to the sum of its output and the feed-forward. The PI does not wind up at
  // this limit.
  for (int n = 0; n < 10; ++n) EXPECT_LE(b.tick(1.5).duty, S(0.75));
  EXPECT_EQ(b.tick(1.5).duty, S(0.75));
  b.tick(1.25);
  EXPECT_EQ(b.telemetry.duty, S(0.5)) << "leaves the limit by the kick of the first smaller error";
}

TYPED_TEST(Extras, TheSetpointSlewsFromWhatIsMeasured) {
  using S = TypeParam;
  Bench<S> b(Mode::speed);
  b.config.extras.slews_setpoint = true;
  b.config.extras.slew.step = static_cast<Accumulator<S>>(0.0625);
  b.measured.speed_rad_s = S(0.5);
  b.tick(1.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, S(0.5625));
  for (int n = 0; n < 20; ++n) b.tick(1.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, S(1.0));
  b.measured.hall = 0;  // a fault turns the bridge off
  b.tick(1.0);
  b.measured.hall = 0b100;
  b.tick(1.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, S(0.5625)) << "and starts anew after the bridge was off";
}

TYPED_TEST(Extras, SmoothChoppingFollowsTheCurrentNotTheConfig) {
  using S = TypeParam;
  Bench<S> b(Mode::duty);
  b.config.chopping = Chopping::hard;
  b.config.extras.smooth_chopping = true;
  b.config.extras.chopping = {S(0.2), S(0.1)};
  EXPECT_EQ(b.tick(0.01).chopping, Chopping::complementary);
  b.carry(0.5);
  EXPECT_EQ(b.tick(0.5).chopping, Chopping::soft);
  EXPECT_EQ(b.tick(-0.01).chopping, Chopping::complementary);
  b.carry(-0.5);
  EXPECT_EQ(b.tick(-0.5).chopping, Chopping::soft);
}

/// The lean drive receives arbitrary bits in a fixed-point measurement. The duties stay within 0 to 1, and no
/// operation overflows (the sanitizers report overflows).
TYPED_TEST(Extras, AnyMeasurementGivesALawfulDuty) {
  using S = TypeParam;
  constexpr int seed = 1307;
  std::mt19937_64 random{seed};
  const auto any = [&random] {
    if constexpr (is_fixed<S>)
      return S::from_raw(static_cast<typename S::Storage>(random() >> 24));
    else
      return static_cast<S>(
          std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -63 + int(random() % 8)));
  };
  for (int run = 0; run < 2000; ++run) {
    const std::uint64_t bits = random();
    Bench<S> b(static_cast<Mode>(1 + bits % 4));
    DriveExtras<S>& x = b.config.extras;
    b.config.speed_control = static_cast<SpeedControl>(bits / 4 % 2);
    b.config.position_gain = Gain<S>(3.0);
    b.config.speed_limit_rad_s = S(1.0);
    x.on = bits / 8 % 4 != 0;
    x.limits_current = x.limits.limits_speed = x.limits.limits_regeneration = bits / 32 % 2;
    x.limits = {S(0.5), x.limits.limits_speed, S(0.9), Gain<S>(8.0), x.limits.limits_regeneration,
                S(0.9), Gain<S>(8.0)};
    x.slews_setpoint = bits / 64 % 2;
    x.slew.step = static_cast<Accumulator<S>>(0.01);
    x.feed_forward.K_t_V_s = Gain<S>(0.7);
    x.bus.lowest_bus_V = S(bits / 128 % 2 ? 0.1 : 0.0);
    x.smooth_chopping = bits / 256 % 2;
    for (int n = 0; n < 20; ++n) {
      b.measured = {any(), any(), any(), any(), any(), any(), static_cast<std::uint8_t>(random() % 8)};
      const BridgeCommand<S> c = step(b.config, b.state, b.measured, Setpoint<S>{any()}, b.telemetry);
      ASSERT_TRUE(c.duty >= S{} && c.duty <= one<S>) << "seed " << seed << " run " << run;
      ASSERT_NE(c.pair.source, c.pair.sink);
      const bool may_coast = x.on && x.limits_current;
      ASSERT_TRUE(may_coast ? !(c.enabled && c.fault) : c.enabled != c.fault);
      if (b.config.mode >= Mode::speed && b.config.speed_control == SpeedControl::cascade) {
        ASSERT_LE(magnitude(b.telemetry.current_reference_A), b.config.current_limit_A);
      }
    }
  }
}

/// The bench's gains in positional form: proportional gain K = 1, integral gain K_i = 1/4.
template <class S>
Bench<S> positional(double K_b) {
  Bench<S> b(Mode::speed);
  b.config.extras.speed_law = SpeedLaw::positional;
  b.config.extras.speed = {Gain<S>(1.0), Gain<S>(0.25), Gain<S>(K_b), one<S>,
                           Gain<S>(gain_beyond_limit(1.0, 0.25, K_b))};
  return b;
}

TYPED_TEST(Extras, PositionalSpeedIsTheSamePiShortOfItsLimit) {
  Bench<TypeParam> incremental(Mode::speed), b = positional<TypeParam>(0.0);
  for (int n = 0; n < 8; ++n) {  // multiples of 2^-6: exact in both forms
    for (Bench<TypeParam>* bench : {&incremental, &b}) bench->tick(n % 3 == 0 ? -0.125 : 0.125);
    EXPECT_EQ(b.telemetry.current_reference_A, incremental.telemetry.current_reference_A) << n;
  }
}

TYPED_TEST(Extras, PositionalSpeedThatFollowsItsWindowAtOnceIsTheIncrementalForm) {
  Bench<TypeParam> incremental(Mode::speed), b = positional<TypeParam>(1.0),
                                             free = positional<TypeParam>(0.0);
  std::mt19937 random{20260301};
  bool winds_up = false;
  for (Bench<TypeParam>* bench : {&incremental, &b, &free}) {
    bench->config.extras.limits_current = true;
    bench->config.extras.limits.current_A = TypeParam(0.25);
  }
  for (int n = 0; n < 300; ++n) {
    const double setpoint = (static_cast<double>(random() % 17) - 8) / 16;
    for (Bench<TypeParam>* bench : {&incremental, &b, &free}) bench->tick(setpoint);
    EXPECT_EQ(b.telemetry.current_reference_A, incremental.telemetry.current_reference_A) << n;
    EXPECT_LE(magnitude(free.telemetry.current_reference_A), TypeParam(0.25));
    winds_up = winds_up || free.telemetry.current_reference_A != b.telemetry.current_reference_A;
  }
  EXPECT_TRUE(winds_up);
}

TYPED_TEST(Extras, TheDerivativeIsOfTheMeasuredSpeed) {
  Bench<TypeParam> b = positional<TypeParam>(0.0), without = positional<TypeParam>(0.0);
  b.config.extras.speed_derivative = {Gain<TypeParam>(0.5), Gain<TypeParam>(1.0)};
  b.tick(0.25), without.tick(0.25);
  EXPECT_EQ(b.telemetry.current_reference_A, TypeParam(0.25)) << "a step of the setpoint gives no kick";
  for (Bench<TypeParam>* bench : {&b, &without}) bench->measured.speed_rad_s = TypeParam(0.125);
  b.tick(0.25), without.tick(0.25);
  EXPECT_EQ(without.telemetry.current_reference_A - b.telemetry.current_reference_A, TypeParam(0.0625));
}

}  // namespace SIXSTEP_TEST_FILE

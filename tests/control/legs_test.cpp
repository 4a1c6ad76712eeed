// SPDX-License-Identifier: Apache-2.0
// Tests three legs together (model.md 11): leg commands, frames, modulation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sixstep/control/gates.hpp"
#include "sixstep/control/three_phase_pwm.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<LegCommands<double>> && std::is_aggregate_v<LegCommands<Q15>>);
static_assert(std::is_trivially_copyable_v<Abc<Q15>> && std::is_trivially_copyable_v<Direction<float>>);

constexpr double third = 2 * std::numbers::pi / 3;

TEST(Legs, ADefaultCommandHasNoGateOn) {
  const LegCommands<double> none;
  EXPECT_FALSE(none.enabled);
  for (const bool pulse : {false, true}) EXPECT_EQ(gates(none.leg[0], Leg::a, pulse), 0);
}

TEST(Legs, EachStateAndKindOfPwmHasItsGates) {
  using enum LegState;
  using enum PwmSwitches;
  constexpr std::uint8_t up = upper_gate(Leg::b), down = lower_gate(Leg::b);
  const struct {
    LegCommand<double> leg;
    std::uint8_t pulse, rest;
  } table[] = {{{off, complementary, 0.5}, 0, 0},    {{low, complementary, 0.5}, down, down},
               {{high, complementary, 0.5}, up, up}, {{pwm, complementary, 0.5}, up, down},
               {{pwm, upper, 0.5}, up, 0},           {{pwm, lower, 0.5}, down, 0},
               {{pwm, lower_first, 0.5}, down, up}};
  for (const auto& row : table) {
    EXPECT_EQ(gates(row.leg, Leg::b, true), row.pulse) << int(row.leg.state) << int(row.leg.switches);
    EXPECT_EQ(gates(row.leg, Leg::b, false), row.rest) << int(row.leg.state) << int(row.leg.switches);
  }
}

/// The kinds of chopping of model.md 3, for either switch. A command as a pair and the same command as three
/// legs must have the same gates.
TEST(Legs, SixStepAsLegsHasItsGates) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const ChoppedSwitch chopped : {ChoppedSwitch::upper, ChoppedSwitch::lower})
      for (unsigned source = 0; source < 3; ++source)
        for (unsigned sink = 0; sink < 3; ++sink)
          for (const bool pulse : {false, true}) {
            const BridgeCommand<double> pair{.enabled = true,
                                             .pair = {static_cast<Leg>(source), static_cast<Leg>(sink)},
                                             .duty = 0.25,
                                             .chopping = chopping,
                                             .chopped = chopped};
            const LegCommands<double> legs = as_legs(pair);
            std::uint8_t all = 0;
            for (unsigned k = 0; k < 3; ++k) all |= gates(legs.leg[k], static_cast<Leg>(k), pulse);
            EXPECT_EQ(all, gates(pair, pulse)) << int(chopping) << source << sink << pulse;
          }
}

template <class Scalar>
class Frames : public ::testing::Test {
 public:
  static Abc<Scalar> phases(double peak, double angle, double common = 0.0) {
    return {Scalar(peak * std::cos(angle) + common), Scalar(peak * std::cos(angle - third) + common),
            Scalar(peak * std::cos(angle + third) + common)};
  }
  static Direction<Scalar> direction(double angle) {
    return {Scalar(std::cos(angle)), Scalar(std::sin(angle))};
  }
};
TYPED_TEST_SUITE(Frames, Scalars);

/// The tolerance is half a digit for each input, difference, product and gain.
constexpr double digits = 4;

TYPED_TEST(Frames, ThreePhasesAreOneVectorOfTheirPeakAndACommonPartDropsOut) {
  using S = TypeParam;
  for (double angle = -3; angle < 3.2; angle += 0.1)
    for (const double common : {0.0, 0.3}) {
      const AlphaBeta<S> x = clarke(this->phases(0.6, angle, common));
      EXPECT_NEAR(static_cast<double>(x.alpha), 0.6 * std::cos(angle), digits * digit<S>());
      EXPECT_NEAR(static_cast<double>(x.beta), 0.6 * std::sin(angle), digits * digit<S>());
      const Abc<S> back = inverse_clarke(x), wanted = this->phases(0.6, angle);
      EXPECT_NEAR(static_cast<double>(back.a), static_cast<double>(wanted.a), 2 * digits * digit<S>());
      EXPECT_NEAR(static_cast<double>(back.b), static_cast<double>(wanted.b), 2 * digits * digit<S>());
      EXPECT_NEAR(static_cast<double>(back.c), static_cast<double>(wanted.c), 2 * digits * digit<S>());
    }
}

TYPED_TEST(Frames, ParkTurnsTheVectorIntoTheAxesFrameAndBack) {
  using S = TypeParam;
  for (double angle = -3; angle < 3.2; angle += 0.1)
    for (const double axis : {-2.0, 0.0, 0.7}) {
      const AlphaBeta<S> x{S(0.6 * std::cos(angle)), S(0.6 * std::sin(angle))};
      const Dq<S> seen = park(x, this->direction(axis));
      EXPECT_NEAR(static_cast<double>(seen.d), 0.6 * std::cos(angle - axis), digits * digit<S>());
      EXPECT_NEAR(static_cast<double>(seen.q), 0.6 * std::sin(angle - axis), digits * digit<S>());
      const AlphaBeta<S> back = inverse_park(seen, this->direction(axis));
      EXPECT_NEAR(static_cast<double>(back.alpha), static_cast<double>(x.alpha), 2 * digits * digit<S>());
      EXPECT_NEAR(static_cast<double>(back.beta), static_cast<double>(x.beta), 2 * digits * digit<S>());
    }
}

TEST(Frames, FixedPointSaturatesWhatIsLongerThanItsRange) {
  const Q15 most = Q15::max(), least = Q15::min();
  EXPECT_EQ(clarke(Abc<Q15>{most, least, least}).alpha, most) << "4/3";
  EXPECT_EQ(clarke(Abc<Q15>{Q15{}, most, least}).beta, most) << "2/sqrt 3";
  EXPECT_EQ(inverse_clarke(AlphaBeta<Q15>{most, most}).c, least) << "-1/2 - sqrt 3/2";
}

template <class Scalar>
class Modulation : public Frames<Scalar> {};
TYPED_TEST_SUITE(Modulation, Scalars);

constexpr double bus = 0.75;  // relative to the base, for fixed point

/// The rounding error of a duty: a few digits of the voltage, divided by the bus voltage.
template <class S>
constexpr double duty_digits = 8 * digit<S>();

template <class S>
double duty(const LegCommands<S>& legs, int k) {
  EXPECT_TRUE(legs.enabled);
  EXPECT_EQ(legs.leg[k].state, LegState::pwm);
  EXPECT_EQ(legs.leg[k].switches, PwmSwitches::complementary);
  return static_cast<double>(legs.leg[k].duty);
}

TYPED_TEST(Modulation, BothReachTheVoltagesBetweenTheTerminalsWithinTheirRange) {
  using S = TypeParam;
  for (const bool space : {false, true}) {
    const double most = space ? bus / std::numbers::sqrt3 : bus / 2;
    for (double angle = -3; angle < 3.2; angle += 0.05) {
      const Abc<S> v = this->phases(most - 2 * digit<S>(), angle);
      const LegCommands<S> legs = space ? space_vector(v, S(bus)) : sine_triangle(v, S(bus));
      const double a = duty(legs, 0), b = duty(legs, 1), c = duty(legs, 2);
      EXPECT_NEAR((a - b) * bus, static_cast<double>(v.a) - static_cast<double>(v.b), duty_digits<S>);
      EXPECT_NEAR((b - c) * bus, static_cast<double>(v.b) - static_cast<double>(v.c), duty_digits<S>);
      if (space) {
        EXPECT_NEAR(std::max({a, b, c}) + std::min({a, b, c}), 1.0, duty_digits<S>)
            << "zero vectors equally long";
      } else {
        EXPECT_NEAR(a, 0.5 + static_cast<double>(v.a) / bus, duty_digits<S>);
      }
    }
  }
}

TYPED_TEST(Modulation, ClampsBeyondItsRangeAndNotBefore) {
  using S = TypeParam;
  // A vector along phase a points to a corner of the hexagon, so it may be the longest. A vector 30 degrees
  // away from phase a reaches the hexagon at U_s/sqrt 3 (bus voltage U_s).
  const double reach = bus / std::numbers::sqrt3, thirty = std::numbers::pi / 6;
  const auto within = [](const LegCommands<S>& legs) {
    bool free = true;
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(duty(legs, k), 0.0);
      EXPECT_LE(duty(legs, k), 1.0);
      free = free && duty(legs, k) > 0.0 && duty(legs, k) < static_cast<double>(one<S>);
    }
    return free;
  };
  EXPECT_TRUE(within(space_vector(this->phases(0.99 * reach, thirty), S(bus))));
  EXPECT_FALSE(within(space_vector(this->phases(1.01 * reach, thirty), S(bus))));
  EXPECT_TRUE(within(space_vector(this->phases(1.01 * reach, 0.0), S(bus)))) << "towards a corner";
  EXPECT_TRUE(within(sine_triangle(this->phases(0.99 * bus / 2, 0.0), S(bus))));
  EXPECT_FALSE(within(sine_triangle(this->phases(1.01 * bus / 2, 0.0), S(bus))));
  EXPECT_EQ(duty(sine_triangle(this->phases(0.9, 0.0), S(bus)), 0), static_cast<double>(one<S>));
  EXPECT_EQ(duty(sine_triangle(this->phases(-0.9, 0.0), S(bus)), 0), 0.0);
}

TYPED_TEST(Modulation, WithoutABusThereIsNoVoltage) {
  using S = TypeParam;
  for (int k = 0; k < 3; ++k) EXPECT_EQ(duty(space_vector(this->phases(0.5, 0.3), S{}), k), 0.5);
}

}  // namespace SIXSTEP_TEST_FILE

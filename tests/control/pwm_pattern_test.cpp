// SPDX-License-Identifier: Apache-2.0
// The chopped switch of the pair is compared with the definition of the patterns. The definition uses the 120
// degrees in which each switch carries current.
#include "sixstep/control/pwm_pattern.hpp"

#include <gtest/gtest.h>

#include "sixstep/control/drive.hpp"
#include "tests/control/scalars.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr PwmPattern all[] = {PwmPattern::upper, PwmPattern::lower, PwmPattern::pwm_on, PwmPattern::on_pwm,
                              PwmPattern::pwm_on_pwm};

/// A rotor that turns in one direction. The drive's torque has the same direction.
struct Turning {
  bool backward = false;
  std::uint8_t sector(int n) const { return static_cast<std::uint8_t>(backward ? 5 - n % 6 : n % 6); }
  Pair pair(int n) const {
    const Pair positive = positive_pair(sector(n));
    return backward ? swapped(positive) : positive;
  }
};

/// The definition: a switch carries current in the sectors n and n + 1. The argument `begun` is true in
/// sector n + 1.
bool chops(PwmPattern pattern, bool upper, bool begun, bool second_half) {
  switch (pattern) {
    case PwmPattern::upper:
      return upper;
    case PwmPattern::lower:
      return !upper;
    case PwmPattern::pwm_on:
      return !begun;
    case PwmPattern::on_pwm:
      return begun;
    case PwmPattern::pwm_on_pwm:
      break;
  }
  return begun == second_half;  // the first and the last 30 degrees of the switch's 120 degrees
}

template <class Scalar>
class PwmPatternOf : public ::testing::Test {};
TYPED_TEST_SUITE(PwmPatternOf, Scalars);

TYPED_TEST(PwmPatternOf, ChopsWhatItsNameSaysBothWays) {
  using S = TypeParam;
  constexpr int ticks = 16;  // per sector
  for (const PwmPattern pattern : all)
    for (const bool backward : {false, true}) {
      const Turning rotor{backward};
      const PwmPatternConfig<S> config{pattern, Gain<S>(2.0 / ticks / 0.5)};
      PwmPatternState<S> state;
      for (int n = 5; n < 24; ++n)
        for (int k = 0; k <= ticks; ++k) {
          if (k > 0) move_in_sector(config, state, rotor.sector(n), backward ? S(-0.5) : S(0.5));
          const ChoppedSwitch chopped = chopped_switch(config, state, rotor.sector(n), rotor.pair(n));
          const bool begun = rotor.pair(n - 1).source == rotor.pair(n).source;  // also true in the first
                                                                                // sector
          if (pattern == PwmPattern::pwm_on_pwm && is_fixed<S> && k == ticks / 2)
            continue;  // rounding of S decides on which side of the middle this tick lies
          EXPECT_EQ(chopped == ChoppedSwitch::upper, chops(pattern, true, begun, k >= ticks / 2))
              << int(pattern) << backward << " sector " << n << " tick " << k;
          EXPECT_EQ(chopped == ChoppedSwitch::lower, chops(pattern, false, !begun, k >= ticks / 2));
        }
    }
}

/// A braked motor is driven against its rotation. The source and the sink of the pair are swapped, and the
/// staying leg remains the same.
TEST(PwmPattern, ACommandOfTheOtherSignKeepsTheLeg) {
  const PwmPatternConfig<double> config{PwmPattern::on_pwm, 0.0};
  PwmPatternState<double> state;
  for (int n = 0; n < 12; ++n) {
    const Turning rotor;
    const Pair pair = rotor.pair(n);
    const auto drives = chopped_switch(config, state, rotor.sector(n), pair);
    const auto brakes = chopped_switch(config, state, rotor.sector(n), swapped(pair));
    EXPECT_NE(drives, brakes);
  }
}

/// With these patterns, every switch is chopped for the same time over a turn. With the patterns `upper` and
/// `lower`, three switches are chopped more than the others.
TEST(PwmPattern, ShareTheChoppingAmongSixSwitches) {
  for (const PwmPattern pattern : {PwmPattern::pwm_on, PwmPattern::on_pwm, PwmPattern::pwm_on_pwm}) {
    const Turning rotor;
    const PwmPatternConfig<double> config{pattern, 0.125};
    PwmPatternState<double> state;
    int chopped[6] = {};
    for (int n = 0; n < 66; ++n)
      for (int k = 0; k < 16; ++k) {
        move_in_sector(config, state, rotor.sector(n), 1.0);
        const Pair pair = rotor.pair(n);
        const bool lower = chopped_switch(config, state, rotor.sector(n), pair) == ChoppedSwitch::lower;
        if (n >= 6) ++chopped[2 * static_cast<int>(lower ? pair.sink : pair.source) + lower];
      }
    for (const int of : chopped) EXPECT_EQ(of, 160) << int(pattern);
  }
}

/// The Hall interrupt starts the first half of the sector. A pattern that always chops the same switch leaves
/// the command unchanged.
TEST(PwmPattern, TheDriveHasItAtTicksAndInTheInterrupt) {
  DriveConfig<double> config{.mode = Mode::duty};
  config.extras.on = true;
  config.extras.pwm = {PwmPattern::pwm_on_pwm, 0.25};
  DriveState<double> state;
  Telemetry<double> telemetry;
  const Turning rotor;
  const auto tick = [&](int n) {
    const Measurement<double> m{.speed_rad_s = 1.0, .hall = hall_of_sector(rotor.sector(n))};
    return step(config, state, m, Setpoint<double>{0.5}, telemetry).chopped;
  };
  tick(5);
  for (int n = 6; n < 18; ++n) {
    const auto entering = n % 2 == 0 ? ChoppedSwitch::upper : ChoppedSwitch::lower;
    EXPECT_EQ(on_hall(config, state, hall_of_sector(rotor.sector(n))).chopped, entering);
    for (int k = 1; k <= 8; ++k) EXPECT_EQ(tick(n) == entering, k < 4) << n << " " << k;
  }
  config.extras.pwm.pattern = PwmPattern::upper;
  state = {};
  EXPECT_EQ(tick(7), ChoppedSwitch::upper);
}

}  // namespace SIXSTEP_TEST_FILE

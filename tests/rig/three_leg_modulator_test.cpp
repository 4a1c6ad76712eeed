// SPDX-License-Identifier: Apache-2.0
// The gates follow three leg commands edge by edge (model.md 11). Ticks are picoseconds, and the period is 30
// us.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/dead_time_watch.hpp"
#include "tests/support/modulating.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::LegCommand;
using control::LegCommands;
using control::LegState;
using control::PwmSwitches;

LegCommand<double> pwm(double duty, PwmSwitches switches = PwmSwitches::complementary) {
  return {LegState::pwm, switches, duty};
}
constexpr LegCommand<double> off{}, low{LegState::low}, high{LegState::high};

LegCommands<double> legs(LegCommand<double> a, LegCommand<double> b, LegCommand<double> c) {
  return {.enabled = true, .leg = {a, b, c}};
}

/// All edges of one period, as pairs like {2.5, "a-b+"}. A pair is the time in us since the start of the
/// period, and the gates after the edge.
std::vector<std::pair<double, std::string>> edges(ThreeLegModulator& m, std::int64_t start) {
  std::vector<std::pair<double, std::string>> all;
  while (m.next_edge() < at(start + period)) {
    const Instant now = do_next(m);
    all.emplace_back((static_cast<double>(now.ticks - start) + now.offset) / 1e6, on(m));
  }
  return all;
}
using Edges = std::vector<std::pair<double, std::string>>;

TEST(ThreeLegModulator, IsOffUntilItIsToldSomething) {
  const ThreeLegModulator m{ModulatorConfig{}};
  EXPECT_EQ(on(m), "");
  EXPECT_TRUE(m.steady());
}

TEST(ThreeLegModulator, CentredPulsesLieWithinEachOther) {
  ThreeLegModulator m{ModulatorConfig{.centre_aligned = true}};
  m.start_period(at(period), legs(pwm(0.5), pwm(0.25), pwm(0.75)));
  EXPECT_EQ(on(m), "a-b-c-");
  EXPECT_EQ(edges(m, period), (Edges{{3.75, "a-b-c+"},
                                     {7.5, "a+b-c+"},
                                     {11.25, "a+b+c+"},
                                     {18.75, "a+b-c+"},
                                     {22.5, "a-b-c+"},
                                     {26.25, "a-b-c-"}}));
  EXPECT_EQ(m.turn_ons(), 3);
}

TEST(ThreeLegModulator, EdgeAlignedPulsesBeginTogether) {
  ThreeLegModulator m{ModulatorConfig{}};
  m.start_period(at(0), legs(pwm(0.5), pwm(0.25), pwm(0.75)));
  EXPECT_EQ(on(m), "a+b+c+");
  EXPECT_EQ(edges(m, 0), (Edges{{7.5, "a+b-c+"}, {15.0, "a-b-c+"}, {22.5, "a-b-c-"}}));
}

TEST(ThreeLegModulator, EachLegHasItsOwnKindOfPwm) {
  ThreeLegModulator m{ModulatorConfig{}};
  m.start_period(at(0), legs(pwm(0.5, PwmSwitches::upper), pwm(0.25, PwmSwitches::lower), low));
  EXPECT_EQ(on(m), "a+b-c-");
  EXPECT_EQ(edges(m, 0), (Edges{{7.5, "a+c-"}, {15.0, "c-"}}));
  m.start_period(at(period), legs(off, high, pwm(0.5)));
  EXPECT_EQ(on(m), "b+c+");
  EXPECT_EQ(edges(m, period), (Edges{{15.0, "b+c-"}}));
}

TEST(ThreeLegModulator, EdgesOfTwoLegsAtOneInstantHappenTogether) {
  for (const bool centred : {false, true}) {
    ThreeLegModulator m{ModulatorConfig{.centre_aligned = centred}};
    m.start_period(at(0), legs(pwm(0.5), pwm(0.5), pwm(0.0)));
    const Edges all = edges(m, 0);
    EXPECT_EQ(all, centred ? (Edges{{7.5, "a+b+c-"}, {22.5, "a-b-c-"}}) : (Edges{{15.0, "a-b-c-"}}));
  }
}

/// The pulse of b ends at the same instant as the dead time of a.
TEST(ThreeLegModulator, AnEdgeAndTheEndOfADeadTimeAtOneInstantBothHappen) {
  ThreeLegModulator m{ModulatorConfig{.dead_ticks = 1.5e6}};
  m.start_period(at(0), legs(pwm(0.25), pwm(0.3), high));
  EXPECT_EQ(edges(m, 0), (Edges{{1.5, "a+b+c+"}, {7.5, "b+c+"}, {9.0, "a-c+"}, {10.5, "a-b-c+"}}));
}

TEST(ThreeLegModulator, DeadTimeIsPerLegAndOnlyWhereItsCommandChanges) {
  ThreeLegModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), legs(pwm(1.0), pwm(0.5), low));
  EXPECT_EQ(on(m), "") << "the first command of a run is a change of every leg";
  EXPECT_EQ(edges(m, 0), (Edges{{1.0, "a+b+c-"}, {15.0, "a+c-"}, {16.0, "a+b-c-"}}));
  m.start_period(at(period), legs(high, pwm(0.5), pwm(0.0)));
  EXPECT_EQ(on(m), "a+c-") << "no change, no dead time";
  EXPECT_EQ(edges(m, period), (Edges{{1.0, "a+b+c-"}, {15.0, "a+c-"}, {16.0, "a+b-c-"}}));
}

/// The off-time is shorter than the dead time. The lower switch is commanded on and off, but never turns on.
/// The upper switch must still wait for the dead time.
TEST(ThreeLegModulator, TheUpperSwitchWaitsFromTheTurnOffCommandOfTheLowerEvenIfThatNeverCameOn) {
  ThreeLegModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), legs(pwm(0.98), low, low));
  edges(m, 0);
  m.start_period(at(period), legs(pwm(0.98), low, low));
  EXPECT_EQ(edges(m, period), (Edges{{1.0, "a+b-c-"}, {29.4, "b-c-"}}));
}

TEST(ThreeLegModulator, APulseOrGapBelowTheMinimumIsLeftOutAndOneOfItsLengthIsNot) {
  for (const bool centred : {false, true}) {
    SCOPED_TRACE(centred);
    ThreeLegModulator m{ModulatorConfig{.centre_aligned = centred, .minimum_pulse_ticks = 1.5e6}};
    m.start_period(at(0), legs(pwm(0.049), pwm(0.951), pwm(0.5)));
    EXPECT_EQ(on(m), centred ? "a-b+c-" : "a-b+c+");
    for (const auto& [us, gates] : edges(m, 0)) EXPECT_EQ(gates.substr(0, 4), "a-b+") << us;
    m.start_period(at(period), legs(pwm(0.05), pwm(0.95), low));
    EXPECT_EQ(edges(m, period).size(), centred ? 4u : 2u);
  }
}

TEST(ThreeLegModulator, TurningOffOpensEverythingAndWakingWaits) {
  ThreeLegModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), legs(pwm(0.5), high, low));
  edges(m, 0);
  m.turn_off(at(20'000'000));
  EXPECT_EQ(on(m), "");
  m.start_period(at(period), legs(pwm(0.5), high, low));
  EXPECT_EQ(on(m), "");
  EXPECT_EQ(do_next(m), at(period + 1'000'000));
  EXPECT_EQ(on(m), "a+b+c-");
}

TEST(ThreeLegModulator, ATimerRoundsTheEdgesOfEachLeg) {
  ThreeLegModulator m{ModulatorConfig{.timer_ticks = 100'000}};  // 10 MHz
  m.start_period(at(0), legs(pwm(0.5017), pwm(0.2517), low));    // 15.051 us, 7.551 us
  EXPECT_EQ(edges(m, 0), (Edges{{7.6, "a+b-c-"}, {15.1, "a-b-c-"}}));
}

LegCommand<double> drawn_leg(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto switches = static_cast<PwmSwitches>(random() % 3);
  switch (random() % 8) {
    case 0:
      return off;
    case 1:
      return low;
    case 2:
      return high;
    case 3:
      return pwm(static_cast<double>(random() % 2), switches);
    case 4:
      return pwm(0.04 * unit(random), switches);
    case 5:
      return pwm(1 - 0.04 * unit(random), switches);
    default:
      return pwm(unit(random), switches);
  }
}

/// A sequence of random leg commands, with pulses and off-times down to zero. In some periods the bridge is
/// off.
TEST(ThreeLegModulator, NeverShootsThroughAndKeepsTheDeadTimeOverAnyCommands) {
  constexpr std::uint32_t seed = 1113;
  std::mt19937_64 random{seed};
  for (int board = 0; board < 32; ++board) {
    const bool dead = board % 2 == 1;
    const ModulatorConfig config{.centre_aligned = board / 2 % 2 == 1,
                                 .dead_ticks = dead ? 1e6 : 0.0,
                                 .timer_ticks = board / 4 % 2 == 1 ? 13888.9 : 0.0,
                                 .minimum_pulse_ticks = board / 8 % 2 == 1 ? 5e5 : 0.0};
    ThreeLegModulator m{config};
    DeadTimeWatch watch{config.in_counts(config.dead_ticks) * 1e-12};
    for (int k = 0; k < 500; ++k) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " board " << board << " period " << k);
      const auto look = [&](const Instant& now) {
        ASSERT_FALSE(shoots_through(m.gates()));
        watch.look(m.gates(), now);
      };
      LegCommands<double> command = legs(drawn_leg(random), drawn_leg(random), drawn_leg(random));
      command.enabled = random() % 10 != 0;
      m.start_period(at(k * period), command);
      look(at(k * period));
      const Instant stop = at(k * period + static_cast<std::int64_t>(random() % period));
      const bool stops = random() % 20 == 0;
      while (m.next_edge() < (stops ? stop : at((k + 1) * period))) look(do_next(m));
      if (!stops) continue;
      m.turn_off(stop);
      look(stop);
    }
    EXPECT_GT(watch.turn_ons(), 500);
  }
}

/// Six-step is a special case of three leg commands. Without a commutation, both must have the same gates at
/// the same instants.
TEST(ThreeLegModulator, SixStepAsLegsIsSixStep) {
  constexpr std::uint32_t seed = 6;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> unit(0, 1);
  for (int board = 0; board < 24; ++board) {
    const ModulatorConfig config{.centre_aligned = board % 2 == 1,
                                 .dead_ticks = board / 2 % 2 == 1 ? 1e6 : 0.0,
                                 .minimum_pulse_ticks = board / 4 % 2 == 1 ? 5e5 : 0.0};
    const auto chopping = static_cast<Chopping>(board / 8);
    SixStepModulator six{config};
    ThreeLegModulator three{config};
    for (int k = 0; k < 200; ++k) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " board " << board << " period " << k);
      // In six-step, a new pair takes over the state of the replaced legs, including a dead time. Independent
      // legs do not take over a state. The third phase is therefore used only if there is no dead time.
      const bool reversed = random() % 4 == 0;
      Pair pair = reversed ? Pair{Leg::b, Leg::a} : Pair{Leg::a, Leg::b};
      if (!(config.dead_ticks > 0) && random() % 2 == 0) pair = {Leg::c, Leg::b};
      const double duty = random() % 5 == 0 ? static_cast<double>(random() % 2) : unit(random);
      const control::BridgeCommand<double> bridge{
          .enabled = random() % 10 != 0, .pair = pair, .duty = duty, .chopping = chopping};
      six.start_period(at(k * period), rig::widened(bridge, {}));
      three.start_period(at(k * period), rig::widened(as_legs(bridge), {}));
      for (;;) {
        ASSERT_EQ(six.gates(), three.gates());
        ASSERT_EQ(six.next_edge(), three.next_edge());
        if (!(six.next_edge() < at((k + 1) * period))) break;
        do_next(six);
        do_next(three);
      }
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE

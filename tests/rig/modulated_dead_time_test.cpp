// SPDX-License-Identifier: Apache-2.0
// Tests the dead times of the six-step modulator edge by edge, and the state of a leg that a commutation
// transfers to another leg (model.md 3, 11). Ticks are picoseconds, and the period is 30 us.
#include <gtest/gtest.h>

#include "tests/support/maxon.hpp"
#include "tests/support/modulating.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

TEST(Modulator, DeadTimeDelaysEachTurnOnTheFirstToo) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), command(0.5, Chopping::complementary));
  EXPECT_EQ(on(m), "");
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(on(m), "a+b-");
  EXPECT_EQ(do_next(m), at(period / 2));
  EXPECT_EQ(on(m), "b-");
  EXPECT_EQ(do_next(m), at(period / 2 + 1'000'000));
  EXPECT_EQ(on(m), "a-b-");
  m.start_period(at(period), command(0.5, Chopping::complementary));
  EXPECT_EQ(on(m), "b-");
  EXPECT_EQ(do_next(m), at(period + 1'000'000));
  EXPECT_EQ(on(m), "a+b-");
}

TEST(Modulator, APulseShorterThanTheDeadTimeNeverTurnsOn) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), command(0.01, Chopping::complementary));  // 0.3 us
  EXPECT_EQ(do_next(m), at(300'000));
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(on(m), "b-");
  EXPECT_EQ(do_next(m), at(1'300'000)) << "the lower switch waits from the upper one's turn-off command";
  EXPECT_EQ(on(m), "a-b-");
}

/// The first command of a run changes the state of every leg (model.md 11), in duty control and in hysteresis
/// control.
TEST(Modulator, TheFirstTurnOnOfARunWaitsInEveryChoppingForDutyAndHysteresis) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.5, 1.0})
      for (const Watch watch : {Watch::none, Watch::motor, Watch::phase}) {
        SCOPED_TRACE(::testing::Message() << int(chopping) << " " << duty << " " << int(watch));
        SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
        m.start_period(at(0),
                       watch == Watch::none ? command(duty, chopping) : compared(watch, chopping, 5.0));
        EXPECT_EQ(on(m), "");
        EXPECT_EQ(do_next(m), at(1'000'000));
        EXPECT_EQ(on(m), "a+b-");
      }
}

/// No dead time is needed, because no other switch of the leg has received a turn-off command since the
/// switch was last on.
TEST(Modulator, LaterTurnOnsOfSoftAndHardChoppingNeedNoDeadTime) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard}) {
    SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
    m.start_period(at(0), command(0.5, chopping));
    while (m.next_edge() < at(period)) do_next(m);
    m.start_period(at(period), command(0.5, chopping));
    EXPECT_EQ(on(m), "a+b-");
  }
}

TEST(Modulator, WithoutAChangeOfTheLegsCommandThereIsNoDeadTime) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.0, 1.0}) {
      SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
      m.start_period(at(0), command(duty, chopping));
      m.act(at(1'000'000));
      const std::string before = on(m);
      for (int n = 1; n < 4; ++n) {
        m.start_period(at(n * period), command(duty, chopping));
        EXPECT_EQ(on(m), before) << int(chopping) << " " << duty;
        EXPECT_TRUE(m.steady());
      }
    }
}

/// In an off-time of 0.3 us, the lower switch is commanded on and off, but never turns on. Its turn-off
/// command still starts the dead time.
TEST(Modulator, AGapShorterThanTheDeadTimeKeepsTheUpperSwitchWaitingForAllOfIt) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), command(0.99, Chopping::complementary));
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(do_next(m), at(29'700'000));
  EXPECT_EQ(on(m), "b-");
  m.start_period(at(period), command(1.0, Chopping::complementary));
  EXPECT_EQ(on(m), "b-");
  EXPECT_EQ(do_next(m), at(period + 1'000'000));
  EXPECT_EQ(on(m), "a+b-");
}

TEST(Modulator, AReversalWaitsWhereTheSourceWasTheSink) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary}) {
    SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
    m.start_period(at(0), command(1.0, chopping));
    m.act(at(1'000'000));
    m.start_period(at(period), command(1.0, chopping, {Leg::b, Leg::a}));
    EXPECT_FALSE(m.gates().high[1]) << int(chopping);
    EXPECT_EQ(do_next(m), at(period + 1'000'000));
    EXPECT_EQ(on(m), "a-b+");
  }
}

/// A centred on-time of 98 % begins 0.3 us into the period, within the dead time of 1 us.
TEST(Modulator, ACentredOnTimeWaitsAtAReversalToo) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard}) {
    SixStepModulator m{ModulatorConfig{.centre_aligned = true, .dead_ticks = 1e6}};
    m.start_period(at(0), command(1.0, chopping));
    m.start_period(at(period), command(0.98, chopping, {Leg::b, Leg::a}));
    EXPECT_EQ(do_next(m), at(period + 300'000)) << int(chopping);
    EXPECT_FALSE(m.gates().high[1]) << int(chopping);
    EXPECT_EQ(do_next(m), at(period + 1'000'000)) << int(chopping);
    EXPECT_EQ(on(m), "a-b+") << int(chopping);
  }
}

/// With complementary chopping, the lower switch is on until the new command turns it off. The new command
/// has soft chopping, and the upper switch waits for the dead time.
TEST(Modulator, AnotherChoppingWaitsForTheLowerSwitch) {
  for (const bool centred : {false, true}) {
    SixStepModulator m{ModulatorConfig{.centre_aligned = centred, .dead_ticks = 1e6}};
    m.start_period(at(0), command(0.5, Chopping::complementary));
    while (m.next_edge() < at(period)) do_next(m);
    EXPECT_EQ(on(m), "a-b-") << centred;
    m.start_period(at(period), command(0.98, Chopping::soft));
    EXPECT_EQ(on(m), "b-") << centred;
    while (!m.gates().high[0] && m.next_edge() < at(2 * period)) m.act(m.next_edge());
    EXPECT_EQ(m.next_edge(), centred ? at(period + 29'700'000) : at(period + 29'400'000)) << centred;
    EXPECT_EQ(on(m), "a+b-") << centred;
  }
}

/// Leg a changes from source to sink. Its command changes from the upper to the lower switch, and the lower
/// switch waits for the dead time.
TEST(Modulator, AReversalWaitsWhereTheSinkWasTheSource) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.98, 1.0}) {
      SCOPED_TRACE(::testing::Message() << int(chopping) << " " << duty);
      SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
      m.start_period(at(0), command(duty, chopping));
      while (m.next_edge() < at(period)) do_next(m);
      m.start_period(at(period), command(1.0, chopping, {Leg::b, Leg::a}));
      EXPECT_FALSE(m.gates().low[0]);
      const std::int64_t off = duty < 1.0 ? 29'400'000 : period;  // the turn-off command of a's upper switch
      Instant now{};
      while (!m.gates().low[0]) now = do_next(m);
      EXPECT_EQ(now, at(off + 1'000'000));
    }
}

/// Both switches of the pair have been off since the middle of the period, which is longer than the dead
/// time.
TEST(Modulator, AHardSignFlipDoesNotWaitWhereTheOtherSwitchIsLongOff) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 2e6}};
  m.start_period(at(0), command(0.5, Chopping::hard));
  while (m.next_edge() < at(period)) do_next(m);
  EXPECT_EQ(on(m), "");
  m.start_period(at(period), command(0.5, Chopping::hard, {Leg::b, Leg::a}));
  EXPECT_EQ(on(m), "a-b+");
  EXPECT_EQ(do_next(m), at(period + period / 2)) << "and nothing ends at 32 us";
}

TEST(Modulator, AHardSinkWaitsWithItsSourceAtAReversal) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), command(1.0, Chopping::hard));
  m.act(at(1'000'000));
  m.start_period(at(period), command(1.0, Chopping::hard, {Leg::b, Leg::a}));
  EXPECT_EQ(on(m), "") << "both switches of the pair are one";
}

TEST(Modulator, TheFirstTurnOnOfTheLowerSwitchWaitsToo) {
  for (const bool centred : {false, true}) {
    SixStepModulator m{ModulatorConfig{.centre_aligned = centred, .dead_ticks = 1e6}};
    m.start_period(at(0), command(centred ? 0.5 : 0.0, Chopping::complementary));
    EXPECT_EQ(on(m), "") << centred;
    EXPECT_EQ(do_next(m), at(1'000'000)) << centred;
    EXPECT_EQ(on(m), "a-b-") << centred;
  }
}

TEST(Modulator, AHysteresisThatWasOffWakesOn) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), compared(Watch::motor, Chopping::soft, 5.0));
  m.comparator_tripped(at(1'000), 0);
  EXPECT_EQ(on(m), "b-");
  m.start_period(at(period), {});
  EXPECT_EQ(on(m), "");
  m.start_period(at(2 * period), compared(Watch::motor, Chopping::soft, 5.0));
  EXPECT_EQ(on(m), "a+b-");
}

TEST(Modulator, AHallEdgeMovesTheStateAsItIs) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
  m.start_period(at(0), command(0.5, Chopping::complementary));
  m.commutate(at(500'000), {Leg::a, Leg::c});  // in the dead time
  EXPECT_EQ(on(m), "");
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(on(m), "a+c-");
  m.commutate(at(2'000'000), {Leg::b, Leg::c});  // in the on-time
  EXPECT_EQ(on(m), "b+c-") << "no dead time of its own";
  EXPECT_EQ(do_next(m), at(period / 2)) << "PWM is not restarted";
  m.commutate(at(15'500'000), {Leg::a, Leg::c});  // in the dead time
  EXPECT_EQ(on(m), "c-");
  EXPECT_EQ(do_next(m), at(16'000'000)) << "nor is the dead time";
  EXPECT_EQ(on(m), "a-c-");
  m.commutate(at(20'000'000), {Leg::b, Leg::c});  // in the off-time
  EXPECT_EQ(on(m), "b-c-");
  EXPECT_EQ(m.turn_ons(), 1);
}

TEST(Modulator, DeadTimeAtCommutationDelaysTheNewTurnOnsOnly) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6, .dead_time_at_commutation = true}};
  m.start_period(at(0), command(0.5));
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(on(m), "a+b-");
  m.commutate(at(5'000'000), {Leg::a, Leg::c});
  EXPECT_EQ(on(m), "a+");
  EXPECT_EQ(do_next(m), at(6'000'000));
  EXPECT_EQ(on(m), "a+c-");
  m.commutate(at(7'000'000), {Leg::b, Leg::c});
  EXPECT_EQ(on(m), "c-");
  EXPECT_EQ(do_next(m), at(8'000'000));
  EXPECT_EQ(on(m), "b+c-");
}

/// With commutation = "sample", the pair changes with the command of a period. Leg a transfers its state to
/// leg b, and leg c is unchanged.
TEST(Modulator, ACommutationAtTheSampleMovesTheStateAsItIs) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.5, 1.0}) {
      SCOPED_TRACE(::testing::Message() << int(chopping) << " " << duty);
      SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
      m.start_period(at(0), command(duty, chopping, {Leg::a, Leg::c}));
      while (m.next_edge() < at(period)) do_next(m);
      m.start_period(at(period), command(duty, chopping, {Leg::b, Leg::c}));
      // In every period of complementary chopping, the state of leg a is low until now. The turn-on is then a
      // change within the transferred state, so it waits for the dead time.
      const bool waits = chopping == Chopping::complementary && duty < 1.0;
      EXPECT_EQ(on(m), waits ? "c-" : "b+c-");
      if (waits) {
        EXPECT_EQ(do_next(m), at(period + 1'000'000));
      }
      EXPECT_EQ(on(m), "b+c-");
    }
}

TEST(Modulator, DeadTimeAtCommutationDelaysSourceAndSinkAtTheSampleToo) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary}) {
    SCOPED_TRACE(int(chopping));
    SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6, .dead_time_at_commutation = true}};
    m.start_period(at(0), command(1.0, chopping));
    m.act(at(1'000'000));
    m.start_period(at(period), command(1.0, chopping, {Leg::a, Leg::c}));
    EXPECT_EQ(on(m), "a+") << "the sink";
    EXPECT_EQ(do_next(m), at(period + 1'000'000));
    EXPECT_EQ(on(m), "a+c-");
    m.start_period(at(2 * period), command(1.0, chopping, {Leg::b, Leg::c}));
    EXPECT_EQ(on(m), "c-") << "the source";
    EXPECT_EQ(do_next(m), at(2 * period + 1'000'000));
    EXPECT_EQ(on(m), "b+c-");
  }
}

}  // namespace SIXSTEP_TEST_FILE

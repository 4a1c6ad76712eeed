// SPDX-License-Identifier: Apache-2.0
// Command in, gates out, edge by edge (model.md 3). Ticks are picoseconds, the period is 30 us.
#include <gtest/gtest.h>

#include <random>

#include "sixstep/control/commutation.hpp"
#include "tests/support/dead_time_watch.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/modulating.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

TEST(Modulator, IsOffUntilItIsToldSomething) {
  const SixStepModulator m{ModulatorConfig{}};
  EXPECT_EQ(on(m), "");
  EXPECT_TRUE(m.steady());
}

TEST(Modulator, GatesOfEachChoppingInBothParts) {
  const std::pair<Chopping, std::array<const char*, 2>> table[] = {
      {Chopping::soft, {"a+b-", "b-"}},
      {Chopping::hard, {"a+b-", ""}},
      {Chopping::complementary, {"a+b-", "a-b-"}}};
  for (const auto& [chopping, gates] : table) {
    SixStepModulator m{ModulatorConfig{}};
    m.start_period(at(0), command(0.25, chopping));
    EXPECT_EQ(on(m), gates[0]);
    EXPECT_EQ(do_next(m), at(period / 4));
    EXPECT_EQ(on(m), gates[1]);
    EXPECT_TRUE(m.steady()) << "until the next period";
  }
}

TEST(Modulator, ZeroHasNoOnTimeAndOneNoGap) {
  SixStepModulator m{ModulatorConfig{}};
  for (int n = 0; n < 3; ++n) {
    m.start_period(at(n * period), command(0.0));
    EXPECT_EQ(on(m), "b-");
    EXPECT_TRUE(m.steady());
  }
  EXPECT_EQ(m.turn_ons(), 0);
  for (int n = 3; n < 6; ++n) {
    m.start_period(at(n * period), command(1.0));
    EXPECT_EQ(on(m), "a+b-");
    EXPECT_TRUE(m.steady());
  }
  EXPECT_EQ(m.turn_ons(), 1);
}

TEST(Modulator, PicosecondPulsesAreNotDropped) {
  for (const double ticks : {1.0, 0.25, 1e-6}) {
    SixStepModulator m{ModulatorConfig{}};
    m.start_period(at(0), command(ticks / period));
    EXPECT_EQ(on(m), "a+b-");
    const Instant edge = do_next(m);
    EXPECT_NEAR(static_cast<double>(edge.ticks) + edge.offset, ticks, 4 * 0x1p-52 * ticks);
    EXPECT_EQ(on(m), "b-");
  }
}

TEST(Modulator, CentreAlignedPulsesAreCentred) {
  SixStepModulator m{ModulatorConfig{.centre_aligned = true}};
  m.start_period(at(period), command(0.25));
  EXPECT_EQ(on(m), "b-");
  EXPECT_EQ(do_next(m), at(period + 11'250'000));
  EXPECT_EQ(on(m), "a+b-");
  EXPECT_EQ(do_next(m), at(period + 18'750'000));
  EXPECT_EQ(on(m), "b-");
}

TEST(Modulator, CentreAlignedAfterFullDutyTurnsOffAtThePeriodsStart) {
  SixStepModulator m{ModulatorConfig{.centre_aligned = true}};
  m.start_period(at(0), command(1.0));
  m.start_period(at(period), command(0.5));
  EXPECT_EQ(on(m), "b-");
}

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

/// model.md 11: the first command of a run is a change, of every leg, whatever gave it.
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

/// Nothing within the leg was told to turn off.
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

/// 0.3 us of gap: the lower switch, told to turn on and off again, never came on; its turn-off counts all the
/// same.
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

/// On-time of 98 % around the middle begins 0.3 us into the period, within the dead time of 1 us.
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

/// The lower switch of complementary chopping turns off with the command; the upper one of soft chopping
/// waits.
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

/// The current of a passes from its upper to its lower switch: that is a change of a's command too.
TEST(Modulator, AReversalWaitsWhereTheSinkWasTheSource) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.98, 1.0}) {
      SCOPED_TRACE(::testing::Message() << int(chopping) << " " << duty);
      SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
      m.start_period(at(0), command(duty, chopping));
      while (m.next_edge() < at(period)) do_next(m);
      m.start_period(at(period), command(1.0, chopping, {Leg::b, Leg::a}));
      EXPECT_FALSE(m.gates().low[0]);
      const std::int64_t off =
          duty < 1.0 ? 29'400'000 : period;  // when a's upper switch was told to turn off
      Instant now{};
      while (!m.gates().low[0]) now = do_next(m);
      EXPECT_EQ(now, at(off + 1'000'000));
    }
}

/// Both switches of the pair have been off since the middle of the period.
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
  m.commutate(at(500'000), {Leg::a, Leg::c});  // dead
  EXPECT_EQ(on(m), "");
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(on(m), "a+c-");
  m.commutate(at(2'000'000), {Leg::b, Leg::c});  // on
  EXPECT_EQ(on(m), "b+c-") << "no dead time of its own";
  EXPECT_EQ(do_next(m), at(period / 2)) << "PWM is not restarted";
  m.commutate(at(15'500'000), {Leg::a, Leg::c});  // dead
  EXPECT_EQ(on(m), "c-");
  EXPECT_EQ(do_next(m), at(16'000'000)) << "nor is the dead time";
  EXPECT_EQ(on(m), "a-c-");
  m.commutate(at(20'000'000), {Leg::b, Leg::c});  // low
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

/// commutation = "sample": the pair moves on with a period's command. Leg a hands its state to b, c goes on.
TEST(Modulator, ACommutationAtTheSampleMovesTheStateAsItIs) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const double duty : {0.5, 1.0}) {
      SCOPED_TRACE(::testing::Message() << int(chopping) << " " << duty);
      SixStepModulator m{ModulatorConfig{.dead_ticks = 1e6}};
      m.start_period(at(0), command(duty, chopping, {Leg::a, Leg::c}));
      while (m.next_edge() < at(period)) do_next(m);
      m.start_period(at(period), command(duty, chopping, {Leg::b, Leg::c}));
      // Low until now, as in any period of complementary chopping: that is a change within the leg.
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

TEST(Modulator, ATimerRoundsEdgesAndDeadTimeToItsCounts) {
  SixStepModulator m{ModulatorConfig{.dead_ticks = 1.04e6, .timer_ticks = 100'000}};  // 10 MHz
  m.start_period(at(0), command(0.5017, Chopping::complementary));                    // 15.051 us -> 15.1 us
  EXPECT_EQ(do_next(m), at(1'000'000));
  EXPECT_EQ(do_next(m), at(15'100'000));
  EXPECT_EQ(do_next(m), at(16'100'000));
}

TEST(Modulator, APairOfOneLegIsAShootThroughThatThePlantRefuses) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), command(0.5, Chopping::soft, {Leg::a, Leg::a}));
  EXPECT_TRUE(shoots_through(m.gates()));
  plant::Plant<double> plant = Drivetrain{}.plant();
  EXPECT_FALSE(plant.set_gates(m.gates()));
}

TEST(Modulator, TurningOffOpensEverything) {
  SixStepModulator m{ModulatorConfig{}};
  m.start_period(at(0), command(1.0));
  m.turn_off(at(5));
  EXPECT_EQ(on(m), "");
}

BoardCommand drawn(std::mt19937_64& random, const ModulatorConfig&, Chopping chopping) {
  std::uniform_real_distribution<double> unit(0, 1);
  const int source = static_cast<int>(random() % 3), sink = (source + 1 + static_cast<int>(random() % 2)) % 3;
  const Pair pair{static_cast<Leg>(source), static_cast<Leg>(sink)};
  if (random() % 4 == 0)
    return compared(random() % 2 == 0 ? Watch::motor : Watch::phase, chopping, 3.0, pair);
  BoardCommand c =
      command(random() % 5 == 0 ? static_cast<double>(random() % 2) : unit(random), chopping, pair);
  c.enabled = random() % 10 != 0;
  return c;
}

TEST(Modulator, NeverHasBothGatesOfALegOn) {
  constexpr std::uint32_t seed = 99;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> current(-6, 6);
  for (int n = 0; n < 2000; ++n) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " board " << n);
    const ModulatorConfig config{.centre_aligned = random() % 2 == 0,
                                 .dead_ticks = random() % 2 == 0 ? 0.0 : 1e6,
                                 .dead_time_at_commutation = random() % 2 == 0,
                                 .timer_ticks = random() % 2 == 0 ? 0.0 : 13888.9};
    const auto chopping = static_cast<Chopping>(random() % 3);
    SixStepModulator m{config};
    for (int k = 0; k < 20; ++k) {
      const Instant start = at(k * period);
      m.start_period(start, drawn(random, config, chopping));
      ASSERT_FALSE(shoots_through(m.gates()));
      for (int edge = 0; edge < 6 && m.next_edge() < at((k + 1) * period); ++edge) {
        const Instant now = do_next(m);
        ASSERT_FALSE(shoots_through(m.gates()));
        const double i = current(random);
        m.compare(now, plant::PerLeg<double>{i, -i, 0.0});
        ASSERT_FALSE(shoots_through(m.gates()));
        if (random() % 4 == 0) m.commutate(now, drawn(random, config, chopping).pair);
        ASSERT_FALSE(shoots_through(m.gates()));
      }
    }
  }
}

double drawn_duty(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const int kind = static_cast<int>(random() % 6);
  if (kind < 2) return static_cast<double>(kind);
  return kind == 2 ? 0.03 * unit(random) : kind == 3 ? 1 - 0.03 * unit(random) : unit(random);
}

/// The pair of a sector, or the swapped one.
Pair pair_of(unsigned sector, bool reversed) {
  const Pair pair = control::positive_pair(static_cast<std::uint8_t>(sector % 6));
  return reversed ? control::swapped(pair) : pair;
}

TEST(Modulator, DeadTimeHoldsInEveryLegOverAnyDutiesChoppingsSignsAndCommutations) {
  constexpr std::uint32_t seed = 12;
  std::mt19937_64 random{seed};
  for (const bool centred : {false, true})
    for (const bool at_commutation : {false, true}) {
      SixStepModulator m{ModulatorConfig{
          .centre_aligned = centred, .dead_ticks = 1e6, .dead_time_at_commutation = at_commutation}};
      DeadTimeWatch watch{1e-6};
      unsigned sector = 0;
      bool reversed = false;
      const auto turn = [&] { sector += random() % 2 == 0 ? 1 : 5; };
      for (int k = 0; k < 5000; ++k) {
        SCOPED_TRACE(::testing::Message() << "seed " << seed << " centred " << centred << " period " << k);
        constexpr Chopping choppings[] = {Chopping::soft, Chopping::hard, Chopping::complementary};
        if (random() % 4 == 0) reversed = !reversed;
        if (random() % 4 == 0) turn();  // seen at the sample
        m.start_period(at(k * period),
                       command(drawn_duty(random), choppings[random() % 3], pair_of(sector, reversed)));
        watch.look(m.gates(), at(k * period));
        const Instant hall = at(k * period + 2'000'000 + static_cast<std::int64_t>(random() % 20'000'000));
        bool turned = random() % 2 == 0;
        while (m.next_edge() < at((k + 1) * period)) {
          if (!turned && hall < m.next_edge()) {
            turned = true;
            turn();
            m.commutate(hall, pair_of(sector, reversed));
            watch.look(m.gates(), hall);
          } else {
            watch.look(m.gates(), do_next(m));
          }
        }
      }
    }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// The gates follow the command edge by edge (model.md 3). Ticks are picoseconds, and the period is 30 us.
#include <gtest/gtest.h>

#include <random>

#include "sixstep/control/commutation.hpp"
#include "tests/support/dead_time_watch.hpp"
#include "tests/support/maxon.hpp"
#include "tests/support/modulating.hpp"

namespace SIXSTEP_TEST_FILE {

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

/// The driven pair of a sector. If the drive is reversed, source and sink are exchanged.
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
        if (random() % 4 == 0) turn();  // the drive detects this edge at the sample
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

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensorless/zero_crossing.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/control/sensorless/terminals.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using namespace sixstep::testing;

constexpr ZeroCrossingConfig config{.rail_counts = 60, .threshold = 12, .below = 12};

TEST(ZeroCrossing, LiesInTheMiddleOfEverySectorBothWaysWhateverTheSamplesPhase) {
  const unsigned seed = 31;
  std::mt19937 draw(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int n = 0; n < 2000; ++n) {
    const std::uint8_t sector = static_cast<std::uint8_t>(n % 6);
    const double sense = n % 12 < 6 ? 1.0 : -1.0, emf = sense * (100 + 1400 * part(draw));
    const double T = 6000 + 60000 * part(draw), period = T / (8 + 30 * part(draw));  // ticks
    const std::uint32_t origin = static_cast<std::uint32_t>(draw());                 // the counter wraps
    ZeroCrossingState state;
    zero_crossing_begin(state, sector, 0, origin);
    bool seen = false;
    for (double t = period * part(draw); t < T && !seen; t += period) {
      const double deg = 60.0 * sector + (sense > 0 ? 60.0 * t / T : 60.0 - 60.0 * t / T);
      const auto at = origin + static_cast<std::uint32_t>(t);
      const CrossingReading r = zero_crossing_step(config, state, driven_sample(sector, deg, emf, at), true);
      if (r.crossing == Crossing::none) continue;
      seen = true;
      EXPECT_EQ(r.crossing, Crossing::seen);
      // The interpolation of a straight line has two errors: the rounding of the counts (the slope is 4 |emf|
      // per sector), and the rounding to whole ticks.
      EXPECT_NEAR(static_cast<double>(r.at - origin), T / 2, 2 + 2.0 * T / (4 * std::fabs(emf)))
          << "seed " << seed << " draw " << n;
    }
    EXPECT_TRUE(seen) << "seed " << seed << " draw " << n;
  }
}

/// In sector 0, the back-EMF of leg c falls. The old current keeps this leg's terminal at the lower rail,
/// which resembles a crossing.
TEST(ZeroCrossing, WaitsForTheOldCurrentAndMeasuresIt) {
  ZeroCrossingState state;
  zero_crossing_begin(state, 0, 0, 1000);
  for (std::uint32_t t = 0; t < 400; t += 100) {
    TerminalSample s = driven_sample(0, 5, 800, 1000 + t);
    s.u[2] = 0;
    const CrossingReading r = zero_crossing_step(config, state, s, true);
    EXPECT_EQ(r.crossing, Crossing::none);
    EXPECT_FALSE(r.free);
  }
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(0, 10, 800, 1400), true).crossing,
            Crossing::none);
  EXPECT_TRUE(state.hidden);
  EXPECT_EQ(state.freewheel, 400u);
  const CrossingReading r = zero_crossing_step(config, state, driven_sample(0, 50, 800, 1800), true);
  EXPECT_EQ(r.crossing, Crossing::seen);
  EXPECT_EQ(r.at, 1600u) << "30 degrees, halfway between 10 and 50";
}

TEST(ZeroCrossing, OneThatTheOldCurrentHidHadPassed) {
  ZeroCrossingState state;
  zero_crossing_begin(state, 1, 0, 0);  // the back-EMF rises in sector 1: the upper rail resembles a crossing
  TerminalSample s = driven_sample(1, 70, 800, 100);
  s.u[1] = bus_counts;
  EXPECT_EQ(zero_crossing_step(config, state, s, true).crossing, Crossing::none);
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(1, 110, 800, 200), true).crossing,
            Crossing::passed_before);
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(1, 115, 800, 300), true).crossing, Crossing::none)
      << "once";
}

TEST(ZeroCrossing, NoiseAroundZeroIsNone) {
  ZeroCrossingState state;
  zero_crossing_begin(state, 0, 0, 0);
  for (std::uint32_t n = 0; n < 1000; ++n) {
    TerminalSample s = driven_sample(0, 0, 0, n);
    s.u[2] = static_cast<std::uint16_t>(s.u[2] + n % 7 - 3);
    EXPECT_EQ(zero_crossing_step(config, state, s, true).crossing, Crossing::none);
  }
}

TEST(ZeroCrossing, NoneBeforeTheEarliestTime) {
  ZeroCrossingState state;
  zero_crossing_begin(state, 0, 500, 0);
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(0, 10, 800, 100), true).crossing, Crossing::none);
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(0, 50, 800, 300), true).crossing, Crossing::none);
  EXPECT_EQ(zero_crossing_step(config, state, driven_sample(0, 55, 800, 600), true).crossing, Crossing::seen);
}

/// The old current ends before tick 200. No crossing is reported until the margin after the first sample
/// without this current has passed. A crossing within the margin is reported at the first sample after the
/// margin.
TEST(ZeroCrossing, NoneWithinTheMarginBehindTheFreewheelsEnd) {
  for (const std::uint32_t margin : {0u, 1u, 100u, 101u, 250u}) {
    ZeroCrossingConfig c = config;
    c.margin_ticks = margin;
    ZeroCrossingState state;
    zero_crossing_begin(state, 0, 0, 0);
    TerminalSample held = driven_sample(0, 5, 800, 100);
    held.u[2] = 0;
    zero_crossing_step(c, state, held, true);
    std::uint32_t told = 0;
    for (std::uint32_t t = 200; told == 0 && t <= 1000; t += 100)
      if (zero_crossing_step(c, state, driven_sample(0, 40, 800, t), true).crossing != Crossing::none)
        told = t;
    EXPECT_EQ(told, 200 + (margin + 99) / 100 * 100) << margin;
  }
}

/// Before the filter has settled, the filtered voltage is the voltage of the previous pair. This voltage must
/// indicate neither the end of freewheeling nor a crossing.
TEST(ZeroCrossing, NothingIsLookedAtBeforeTheFiltersHaveSettled) {
  for (const std::uint32_t settle : {0u, 50u, 51u}) {
    ZeroCrossingConfig c = config;
    c.settle_ticks = settle;
    ZeroCrossingState state;
    zero_crossing_begin(state, 0, 0, 1000);
    // The filtered voltage falls from the upper rail to the lower rail. The diode then keeps the terminal at
    // the lower rail.
    zero_crossing_step(c, state, driven_sample(0, 40, 800, 1050), true);
    TerminalSample held = driven_sample(0, 5, 800, 1150);
    held.u[2] = 0;
    const Crossing then = zero_crossing_step(c, state, held, true).crossing;
    EXPECT_EQ(state.hidden, settle > 50) << settle;
    EXPECT_EQ(then, Crossing::none) << settle;
  }
}

/// The off-time of soft chopping, with both driven legs at the lower rail. If the back-EMF e_f of the
/// floating leg is positive, the terminal voltage is u_f = 3/2 e_f. Otherwise a diode keeps the terminal at
/// the rail.
TerminalSample soft_freewheel(double e_f, std::uint32_t at) {
  TerminalSample s;
  s.bus = bus_counts;
  s.at = at;
  s.u[2] = held_to_rails(1.5 * e_f);
  return s;
}

TEST(ZeroCrossing, AFreewheelOfSoftChoppingIsSeenOnlyWhereAskedFor) {
  ZeroCrossingConfig off = config;
  off.seen = NeutralSeen::freewheel;
  off.below = -1;  // the terminal can be used only while it is at its rail
  for (const bool asked : {false, true}) {
    ZeroCrossingState state;
    zero_crossing_begin(state, 0, 0, 0);
    const ZeroCrossingConfig& c = asked ? off : config;
    zero_crossing_step(c, state, soft_freewheel(500, 100), false);
    zero_crossing_step(c, state, soft_freewheel(100, 200), false);
    const CrossingReading r = zero_crossing_step(c, state, soft_freewheel(-300, 300), false);
    EXPECT_EQ(r.crossing, asked ? Crossing::seen : Crossing::none);
    EXPECT_EQ(r.visible, asked);
  }
}

TEST(ZeroCrossing, CountsSamplesThatContradictTheCommand) {
  ZeroCrossingState state;
  zero_crossing_begin(state, 0, 0, 0);
  TerminalSample dead = driven_sample(0, 10, 800, 100);
  dead.u[0] = 0;  // the source's divider fails
  for (std::uint8_t n = 1; n < 5; ++n) {
    zero_crossing_step(config, state, dead, true);
    EXPECT_EQ(state.unlike, n);
  }
  zero_crossing_step(config, state, driven_sample(0, 10, 800, 200), true);
  EXPECT_EQ(state.unlike, 0);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/commissioning/level_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "sixstep/control/commissioning/flux_turn.hpp"
#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<LevelStepsState>);

/// A phase has the resistance r, in bus counts per count of current, and the time constant tau, in ticks.
/// Dead time and diodes reduce the voltage vector by `lost` bus counts.
struct Phase {
  double r = 0.3, tau = 12.0, lost = 20.0, bus = 3000.0;

  double steady(std::int32_t v) const { return (v * bus / whole_bus - lost) / r; }
};

/// The result for exact exponential steps between the levels `low` and `high`. A new voltage acts
/// config.late_half_ticks half ticks after the sample. Currents are rounded to 1/`digit` of a count.
LevelStepsReading stepped(const LevelStepsConfig& config, const Phase& phase, std::int32_t low,
                          std::int32_t high, double digit) {
  LevelStepsState state;
  const auto steady = [&] { return phase.steady(state.high ? high : low); };
  const auto relaxed = [&](double from, double to, double ticks) {
    return to + (from - to) * std::exp(-ticks / phase.tau);
  };
  double i = steady();
  const double late = config.late_half_ticks / 2.0;
  for (bool over = false; !over;) {
    const double commanded = steady();
    over = level_steps_tick(config, state,
                            static_cast<std::int32_t>(std::lround(std::round(i * digit) * 24 / digit)),
                            static_cast<std::uint16_t>(phase.bus));
    i = relaxed(relaxed(i, commanded, late), steady(), 1 - late);
  }
  return level_steps_reading(config, state, low, high);
}

TEST(LevelSteps, FindsResistanceLossAndTimeConstantOfAnExponential) {
  for (const std::uint8_t late : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}})
    for (const double tau : {3.0, 12.0, 60.0}) {
      const Phase phase{.tau = tau};
      const LevelStepsConfig config{.ticks = 1024, .pairs = 2, .late_half_ticks = late};
      const LevelStepsReading reading = stepped(config, phase, 60'000, 120'000, 24.0);
      ASSERT_TRUE(reading.usable);
      // The error is 1/24 of a count in about 570, for each of the two levels. The rounding unit of 2^-20 is
      // smaller.
      const double step = (phase.steady(120'000) - phase.steady(60'000)) * 24;
      EXPECT_NEAR(reading.resistance / 1048576.0, phase.r, phase.r * 1.0 / step) << int(late);
      EXPECT_NEAR(reading.lost / 256.0, phase.lost, 2 * phase.r * phase.steady(120'000) / step + 1.0 / 256);
      // The error is the next term of the series plus the rounding that level_steps.hpp states.
      const double allowed = std::pow(1 / tau, 4) / 500 + std::log(2 * step) / step;
      EXPECT_NEAR(reading.tau / 65536.0 / tau, 1.0, allowed) << int(late) << " " << tau;
    }
}

/// With currents in whole counts, as a converter gives them, the error is within the header's bound for any
/// phase.
TEST(LevelSteps, RoundingStaysWithinWhatIsSaid) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Drawn drawn{seed};
    const Phase phase{.r = 0.05 + drawn.unit(), .tau = 2 + 60 * drawn.unit(), .lost = 40 * drawn.unit()};
    const LevelStepsConfig config{.ticks = 1024, .pairs = 1, .late_half_ticks = 1};
    const double high = (300 + 1500 * drawn.unit()) * phase.r + phase.lost;
    const auto v = static_cast<std::int32_t>(high / phase.bus * whole_bus);
    const LevelStepsReading reading = stepped(config, phase, v / 2, v, 1.0);
    const double step = phase.steady(v) - phase.steady(v / 2);
    ASSERT_TRUE(reading.usable) << seed;
    EXPECT_NEAR(reading.resistance / 1048576.0 / phase.r, 1.0, 1.0 / step + 1e-5) << seed;
    EXPECT_NEAR(reading.tau / 65536.0 / phase.tau, 1.0,
                std::log(2 * step) / step + std::pow(1 / phase.tau, 4) / 500)
        << seed;
  }
}

TEST(LevelSteps, LevelsThatDoNotDifferAreNotUsable) {
  const LevelStepsConfig config{.ticks = 64, .pairs = 1};
  LevelStepsState state;
  while (!level_steps_tick(config, state, 24 * (state.high ? 163 : 100), 3000)) {
  }
  EXPECT_FALSE(level_steps_reading(config, state, 100, 200).usable);
}

/// The voltage is v = R i + j w L i + j w psi + lost s, in the frame of v (model.md; s: direction of the
/// current, lost: voltage lost to dead time and diodes). The EMF is the length of v - R i - j w L i - lost s.
TEST(FluxTurn, SolvesTheVoltageEquation) {
  LevelStepsReading winding{.usable = true};
  winding.resistance = static_cast<std::int32_t>(0.4 * 1048576);
  winding.tau = 20 * 65536;
  winding.lost = 12 * 256;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Drawn drawn{seed};
    const std::uint32_t speed = 1'000'000 + drawn.below(20'000'000);
    const double w = 2 * 3.14159265358979 * speed / 4294967296.0, X = w * 0.4 * 20;
    const double d = 2000 * drawn.unit() - 1000, q = 2000 * drawn.unit() - 1000, bus = 3000;
    const double s_d = 2 * drawn.unit() - 1, s_q = 2 * drawn.unit() - 1;
    const std::int32_t v = 100'000 + static_cast<std::int32_t>(drawn.below(400'000));
    FluxTurnState state;
    const auto in_24ths = [](double x) { return static_cast<std::int32_t>(std::lround(24 * x)); };
    for (int n = 0; n < 100; ++n)
      flux_turn_tick(state, {{in_24ths(d), in_24ths(q)}, {in_24ths(s_d), in_24ths(s_q)}}, 3000);
    const FluxTurnReading reading = flux_turn_reading(winding, state, v, speed);
    const double e_d = v * bus / whole_bus - 0.4 * d + X * q - 0.75 * 12 * s_d;
    const double e_q = -0.4 * q - X * d - 0.75 * 12 * s_q;
    const double e = std::hypot(e_d, e_q);
    // The errors are 1/24 of a count in R and in the reactance X, and some units of 2^-8.
    EXPECT_NEAR(reading.emf / 256.0, e, (0.4 + X) / 24 + 9.0 / 24 + 8.0 / 256) << seed;
    EXPECT_NEAR(reading.flux / 16.0, reading.emf / 256.0 * 4294967296.0 / speed, 0.1) << seed;
  }
}

}  // namespace SIXSTEP_TEST_FILE

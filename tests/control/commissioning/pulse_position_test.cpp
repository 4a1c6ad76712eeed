// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/commissioning/pulse_position.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <type_traits>

#include "tests/control/sensing/drawn.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<PulsePositionState>);

constexpr double pi = 3.14159265358979323846;

/// The law of the header, i L(x, i) = constant, is solved for the current i.
struct Iron {
  double counts = 600.0;     ///< current where L is L_S
  double saliency = -0.1;    ///< L_D/L_S
  double saturation = 0.06;  ///< L_d i/(2 I_sat L_S) at `counts`
  double gain[3] = {1, 1, 1}, offset[3] = {0, 0, 0};
  double noise = 0.0;  ///< counts

  double current(double x) const {
    double i = 1.0;
    for (int n = 0; n < 60; ++n)
      i = 1 / (1 + saliency * std::cos(2 * x) - saturation * i * std::pow(std::cos(x), 3));
    return counts * i;
  }
};

PulsePositionState pulsed(const PulsePositionConfig& config, const Iron& iron, double electrical_deg,
                          Drawn& drawn) {
  PulsePositionState state;
  while (state.phase != PulsePhase::done) {
    double i[3] = {0, 0, 0};
    if (state.phase == PulsePhase::pulse) {
      const Pair pair = pulsed_pair(state);
      const double direction = 60.0 * detail::pulsed_sector(state.step) - 30;
      const double I = iron.current((direction - (electrical_deg - 150)) * pi / 180);
      i[static_cast<int>(pair.source)] = I;
      i[static_cast<int>(pair.sink)] = -I;
    }
    std::uint16_t counts[3];
    for (int k = 0; k < 3; ++k) {
      const double seen =
          iron.gain[k] * i[k] + iron.offset[k] + (iron.noise > 0 ? iron.noise * drawn.normal() : 0);
      counts[k] = static_cast<std::uint16_t>(std::floor(2048 + seen + 0.5));
    }
    pulses_tick(config, state, counts);
  }
  return state;
}

constexpr PulsePositionConfig usual{
    .current = {.offset_counts = 2048, .offset_tolerance = 100}, .pulse_ticks = 3, .rest_ticks = 4};

double off(const PulsePositionReading& reading, double deg) {
  return degrees_of(way_between(of_turns(deg / 360), reading.electrical));
}

/// The polarity is found for either sign of the saliency. The error of the angle is the noise plus the effect
/// of saturation on the second harmonic, which is 3/32 of the square of the saturation
/// (rig/pulse_start_test.cpp).
TEST(PulsePosition, FindsNorthAndTheAngle) {
  Drawn drawn{1};
  for (const double saliency : {-0.1, 0.1})
    for (const double noise : {0.0, 1.0})
      for (int deg = 0; deg < 360; deg += 3) {
        const Iron iron{.saliency = saliency, .offset = {7.4, -3.3, 0.6}, .noise = noise};
        const PulsePositionReading reading = pulse_position(usual, pulsed(usual, iron, deg, drawn));
        ASSERT_TRUE(reading.seen) << deg;
        EXPECT_TRUE(reading.axis_seen);
        const double allowed = (5 * 16.0 / reading.axis_16 + 0.06 * 0.06 * 3 / 32 / 0.1) / 2 * 180 / pi;
        EXPECT_LT(std::fabs(off(reading, deg)), allowed) << deg << " " << saliency;
      }
}

/// For a rotor without saliency, the polarity signal alone determines the angle, within the noise of this
/// signal. The third harmonic of cos^3 has no effect.
TEST(PulsePosition, SaturationAloneIsEnough) {
  Drawn drawn{2};
  for (int deg = 1; deg < 360; deg += 7) {
    const PulsePositionReading reading = pulse_position(usual, pulsed(usual, {.saliency = 0.0}, deg, drawn));
    ASSERT_TRUE(reading.seen) << deg;
    EXPECT_FALSE(reading.axis_seen);
    // Besides the noise, 1/I distorts cos^3. Parts of the square of this distortion alias onto the first
    // harmonic, with a tenth of the depth.
    EXPECT_LT(std::fabs(off(reading, deg)), (5 * 16.0 / reading.north_16 + 0.06 / 10) * 180 / pi) << deg;
  }
}

/// Saliency alone does not determine the polarity. Different gains of the amplifiers do not count as an axis.
TEST(PulsePosition, SaysWhereNothingIsSeen) {
  Drawn drawn{3};
  for (int deg = 0; deg < 360; deg += 10) {
    const PulsePositionReading salient =
        pulse_position(usual, pulsed(usual, {.saturation = 0.0, .noise = 0.5}, deg, drawn));
    EXPECT_FALSE(salient.seen) << deg;
    const PulsePositionReading round = pulse_position(
        usual, pulsed(usual, {.saliency = 0.0, .saturation = 0.0, .gain = {1.01, 0.99, 1.0}, .noise = 0.5},
                      deg, drawn));
    EXPECT_FALSE(round.seen) << deg;
    EXPECT_FALSE(round.axis_seen) << deg;
    EXPECT_FALSE(pulse_position(usual, pulsed(usual, {.counts = 20.0}, deg, drawn)).seen);
  }
  EXPECT_FALSE(pulse_position(usual, pulsed(usual, {.offset = {150, 0, 0}}, 0, drawn)).seen);
}

/// A round rotor with noise and any offsets. The ratio of signal to noise is the length of a vector of two
/// independent normal parts. This length exceeds sqrt(-2 ln 0.05) = 2.45 in 5 % of the draws, but none of
/// 4000 draws may count as a detected rotor. With 8 counts of noise, s^2 is 2 64^2, and sigma^2 is 1408 + 45,
/// of which 13 are rounding. Then exp(-3 1453/1421) = 4.65 % of the draws exceed the limit.
TEST(PulsePosition, NoiseIsNotTakenForARotor) {
  int seen = 0, above = 0;
  const int draws = 4000;
  for (int n = 0; n < draws; ++n) {
    Drawn drawn{static_cast<std::uint64_t>(100 + n)};
    const bool quiet = n % 2 == 0;
    const Iron iron{.counts = 300 + 1200 * drawn.unit(),
                    .saliency = 0.0,
                    .saturation = 0.0,
                    .offset = {drawn.unit(), drawn.unit(), drawn.unit()},
                    .noise = quiet ? 0.0 : 8.0};
    const PulsePositionReading reading = pulse_position(usual, pulsed(usual, iron, 0, drawn));
    seen += reading.seen;
    above += !quiet && reading.north_16 > 2.45 * 16;
  }
  std::printf("%d of %d round rotors seen, %.2f %% of the noisy ones above the 5 %% mark\n", seen, draws,
              200.0 * above / draws);
  EXPECT_EQ(seen, 0);
  // The tolerance for 2000 draws is four standard deviations of 0.47 %.
  EXPECT_NEAR(2.0 * above / draws, 0.0465, 0.019);
}

}  // namespace SIXSTEP_TEST_FILE

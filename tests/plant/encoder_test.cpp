// SPDX-License-Identifier: Apache-2.0
// Encoders and resolver are compared with their equations in long double.
#include "sixstep/plant/encoder.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "sixstep/plant/resolver.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using Angle = plant::ShaftAngle<double>;

constexpr long double two_pi_l = 6.283185307179586476925286766559005768L;

long double turns(const Angle& at) {
  return (static_cast<long double>(at.sector) + static_cast<long double>(at.x) / (two_pi_l / 6)) /
         (6 * at.pole_pairs);
}

Angle drawn(std::mt19937_64& draw) {
  std::uniform_real_distribution<double> x(0, base::sector_rad);
  return {static_cast<std::int64_t>(draw() % 2'000'001) - 1'000'000, x(draw),
          static_cast<std::int64_t>(draw() % 20) + 1};
}

TEST(Encoder, CountsQuarterLinesOverAllTurns) {
  std::mt19937_64 draw(16);
  for (int n = 0; n < 100'000; ++n) {
    const Angle at = drawn(draw);
    const std::int64_t lines = static_cast<std::int64_t>(draw() % 5000) + 1;
    const long double exact = 4 * lines * turns(at);
    if (std::fabs(exact - std::round(exact)) < 1e-9L)
      continue;  // an edge: the angle's rounding decides the side
    EXPECT_EQ(plant::parts_of_turn(at, 4 * lines), static_cast<std::int64_t>(std::floor(exact)))
        << "draw " << n;
  }
}

TEST(Encoder, CountsEveryEdgeThatFallsOnASectorExactly) {
  // With 3 p lines, each sector has exactly two quarter lines. This is true after any number of turns.
  for (std::int64_t sector = -1000; sector < 1000; ++sector)
    EXPECT_EQ(plant::parts_of_turn(Angle{sector, 0.0, 8}, 4 * 24), 2 * sector);
}

TEST(Encoder, LinesAreThoseOfTheModel) {
  std::mt19937_64 draw(17);
  for (int n = 0; n < 100'000; ++n) {
    const Angle at = drawn(draw);
    const std::int64_t lines = static_cast<std::int64_t>(draw() % 5000) + 1;
    const auto frac = [](long double x) { return x - std::floor(x); };
    const long double line = lines * turns(at);
    if (std::fabs(4 * line - std::round(4 * line)) < 1e-9L) continue;
    const bool a = frac(line) < 0.5L, b = frac(line - 0.25L) < 0.5L, z = frac(turns(at)) * lines < 1;
    EXPECT_EQ(plant::encoder_lines(at, lines), (a << 2 | b << 1 | static_cast<int>(z))) << "draw " << n;
  }
}

TEST(AbsoluteEncoder, NeighboursDifferInOneBit) {
  for (const int bits : {4, 8, 12}) {
    const std::int64_t parts = std::int64_t{1} << bits;
    std::uint32_t before = 0;
    for (std::int64_t n = 0; n <= parts; ++n) {
      // The middle of part n of the turn, in sectors of one pole pair.
      const double sectors = 6 * (static_cast<double>(n % parts) + 0.5) / static_cast<double>(parts);
      const Angle at{static_cast<std::int64_t>(sectors), (sectors - std::floor(sectors)) * base::sector_rad,
                     1};
      const std::uint32_t code = plant::gray_code(at, bits);
      std::uint32_t decoded = code;
      for (int shift = 1; shift < 32; shift *= 2) decoded ^= decoded >> shift;
      EXPECT_EQ(decoded, static_cast<std::uint32_t>(n % parts));
      if (n > 0) {
        EXPECT_EQ(std::popcount(code ^ before), 1) << n;
      }
      before = code;
    }
  }
}

TEST(Resolver, AgreesWithItsEquation) {
  std::mt19937_64 draw(18);
  std::uniform_real_distribution<double> small(-0.1, 0.1);
  for (int n = 0; n < 10'000; ++n) {
    const Angle at = drawn(draw);
    const plant::Resolver r{.amplitude_V = 2.0,
                            .excitation_Hz = 8e3 + static_cast<double>(draw() % 8001),
                            .pole_pairs = static_cast<int>(draw() % 4) + 1,
                            .imbalance = small(draw),
                            .quadrature_rad = small(draw),
                            .phase_1_rad = small(draw),
                            .phase_2_rad = small(draw)};
    const auto t_ps = static_cast<std::int64_t>(draw() % 1'000'000'000'000);
    const long double carrier =
        two_pi_l * static_cast<long double>(r.excitation_Hz) * static_cast<long double>(t_ps) * 1e-12L;
    const long double angle = two_pi_l * turns(at) * r.pole_pairs;
    const auto [v1, v2] = plant::resolver_V(r, at, t_ps);
    // A carrier angle of up to 16 000 turns is rounded by 16 000 x 2^-53 turns, which is 1e-11 rad.
    EXPECT_NEAR(v1, static_cast<double>(2 * sinl(carrier + r.phase_1_rad) * cosl(angle)), 4e-11)
        << "draw " << n;
    EXPECT_NEAR(v2,
                static_cast<double>(2 * (1 + static_cast<long double>(r.imbalance)) *
                                    sinl(carrier + r.phase_2_rad) * sinl(angle + r.quadrature_rad)),
                4e-11);
  }
}

}  // namespace SIXSTEP_TEST_FILE

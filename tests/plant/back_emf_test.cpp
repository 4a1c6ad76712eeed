// SPDX-License-Identifier: Apache-2.0
#include "sixstep/plant/back_emf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using plant::EmfPiece;

constexpr double eps = 0x1p-52;
constexpr std::uint32_t seed = 41;

/// The definition of model.md 1, with the flat width w: +1 for |theta - 60| <= w/2, then ramps of 180 - w
/// degrees. The negative half wave is the mirrored positive half wave.
double trapezoid(double deg, double flat) {
  const double d = std::fabs(std::remainder(deg - 60.0, 360.0));
  if (d <= flat / 2) return 1.0;
  if (d >= 180.0 - flat / 2) return -1.0;
  return (90.0 - d) / (90.0 - flat / 2);
}

template <class Table>
const EmfPiece<double>& piece_at(const Table& table, int sector, double x) {
  int n = 0;
  while (n + 1 < table[sector].count && x >= table[sector].piece[n].to) ++n;
  return table[sector].piece[n];
}

TEST(Pitfall11_OneFormForAllShapes, TrapezoidOfAnyWidthIsTheDefinition) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> turn(0.0, 360.0);
  for (const double flat : {120.0, 100.0, 140.0, 60.0, 170.0, 20.0, 119.0, 0.5}) {
    const auto table = plant::trapezoid_table<double>(flat);
    const double slope = 1 / (90.0 - flat / 2);
    for (int n = 0; n < 5000; ++n) {
      const double deg = turn(random);
      const int sector = static_cast<int>(deg / 60.0);
      const double x = (deg - 60.0 * sector) * base::pi / 180.0;
      const EmfPiece<double>& p = piece_at(table, sector, x);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(p.alpha[k] + p.beta[k] * x, trapezoid(deg - 120.0 * k, flat), 4 * eps * (2 + 360 * slope))
            << "seed " << seed << " flat " << flat << " deg " << deg << " phase " << k;
    }
  }
}

TEST(BackEmf, PiecesCoverTheSectorAndMeet) {
  for (const double flat : {120.0, 100.0, 140.0, 60.0, 170.0, 20.0, 180.0 / 7}) {
    const auto table = plant::trapezoid_table<double>(flat);
    const double slope = 90.0 / (90.0 - flat / 2);
    for (int s = 0; s < 6; ++s) {
      EXPECT_EQ(table[s].piece[0].from, 0.0);
      EXPECT_EQ(table[s].piece[table[s].count - 1].to, base::sector_rad);
      for (int n = 0; n < table[s].count; ++n) {
        const bool last = n + 1 == table[s].count;
        const EmfPiece<double>& p = table[s].piece[n];
        const EmfPiece<double>& q = last ? table[(s + 1) % 6].piece[0] : table[s].piece[n + 1];
        EXPECT_LT(p.from, p.to);
        EXPECT_EQ(q.from, last ? 0.0 : p.to);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(p.alpha[k] + p.beta[k] * p.to, q.alpha[k] + q.beta[k] * q.from, 16 * eps * slope)
              << "flat " << flat << " sector " << s;
      }
    }
  }
}

TEST(BackEmf, TheUsualTrapezoidHasOnePiecePerSector) {
  const auto table = plant::trapezoid_table<double>(120.0);
  for (const auto& sector : table) EXPECT_EQ(sector.count, 1);
  EXPECT_EQ(table[0].piece[0].alpha[0], 1.0);
  EXPECT_EQ(table[0].piece[0].beta[0], 0.0);
  EXPECT_EQ(table[0].piece[0].alpha[1], -1.0);
}

TEST(Pitfall11_OneFormForAllShapes, SineIsTheDefinition) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> turn(0.0, 6 * base::sector_rad);
  const auto table = plant::sine_table<double>();
  for (int n = 0; n < 5000; ++n) {
    const double theta = turn(random);
    const int sector = static_cast<int>(theta / base::sector_rad);
    const double x = theta - sector * base::sector_rad;
    const EmfPiece<double>& p = table[sector].piece[0];
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(p.alpha[k] * std::cos(x) + p.beta[k] * std::sin(x),
                  std::cos(theta - (60.0 + 120.0 * k) * base::pi / 180.0), 16 * eps)
          << "seed " << seed << " theta " << theta;
  }
}

TEST(BackEmf, PhasesSumToZeroForASineAndNotForATrapezoid) {
  const auto sine = plant::sine_table<double>();
  for (const auto& s : sine) {
    EXPECT_NEAR(s.piece[0].alpha[0] + s.piece[0].alpha[1] + s.piece[0].alpha[2], 0.0, eps);
    EXPECT_NEAR(s.piece[0].beta[0] + s.piece[0].beta[1] + s.piece[0].beta[2], 0.0, eps);
  }
  const auto trapezoid_120 = plant::trapezoid_table<double>(120.0);
  const auto& p = trapezoid_120[0].piece[0];
  EXPECT_NEAR(p.alpha[0] + p.alpha[1] + p.alpha[2], 1.0, 4 * eps);
}

}  // namespace SIXSTEP_TEST_FILE

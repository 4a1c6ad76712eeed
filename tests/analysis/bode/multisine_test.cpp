// SPDX-License-Identifier: Apache-2.0
// A multisine has power only at its own frequencies. The response that it measures is equal to the known
// response of a system.
#include "sixstep/analysis/bode/multisine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sixstep/analysis/bode/measured_loop.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/loop_figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using analysis::Multisine;

TEST(Multisine, LinesAreOddDistinctAndWithinTheirEnd) {
  for (const std::size_t last : {1u, 2u, 7u, 64u, 1000u, 99999u})
    for (const std::size_t count : {1u, 2u, 32u, 200u}) {
      const auto lines = analysis::odd_lines(last, count);
      ASSERT_FALSE(lines.empty());
      EXPECT_EQ(lines.front(), 1u);
      EXPECT_LE(lines.back(), last);
      EXPECT_LE(lines.size(), count);
      for (std::size_t n = 0; n < lines.size(); ++n) {
        EXPECT_EQ(lines[n] % 2, 1u);
        if (n > 0) {
          EXPECT_GT(lines[n], lines[n - 1]);
        }
      }
      if (count > 1 && last > 2) {
        EXPECT_GE(lines.back() + 2, std::min(last, 2 * count - 1)) << last << " " << count;
      }
    }
}

TEST(Multisine, PeaksAtItsAmplitudeAndLowerThanSinesInStep) {
  const Multisine signal{1024, analysis::odd_lines(400, 32), 0.25};
  const std::vector<double> r = samples_of(signal);
  double peak = 0, square = 0;
  for (const double x : r) {
    peak = std::max(peak, std::abs(x));
    square += x * x / static_cast<double>(r.size());
  }
  EXPECT_NEAR(peak, 0.25, 1e-15);
  // The crest factor of 32 sines in phase is sqrt(2 32) = 8. With Schroeder's phases it is below half of this
  // value.
  EXPECT_LT(peak / std::sqrt(square), 4.0);
}

/// Output of y[n] = a y[n-1] + b r[n-1] after 20 periods of the signal, when the initial transient has
/// decayed.
std::vector<double> first_order(const Multisine& signal, double a, double b, std::size_t periods) {
  const std::vector<double> r = samples_of(signal);
  std::vector<double> out;
  double y = 0;
  for (std::size_t n = 0; n < (periods + 20) * r.size(); ++n) {
    if (n >= 20 * r.size()) out.push_back(y);
    y = a * y + b * r[n % r.size()];
  }
  return out;
}

TEST(Multisine, AnswerIsTheSystems) {
  const Multisine signal{512, analysis::odd_lines(200, 24), 2.0};
  const double a = 0.9, b = 0.3;
  const analysis::Answer answer = answer_to(signal, first_order(signal, a, b, 4));
  ASSERT_EQ(answer.lines.size(), signal.lines.size());
  EXPECT_LT(answer.beside, 1e-7);
  for (std::size_t k = 0; k < answer.lines.size(); ++k) {
    const double turn = 2 * base::pi * static_cast<double>(signal.lines[k]) / 512;
    const design::Complex z{std::cos(turn), std::sin(turn)};
    const design::Complex expected = design::Complex{b, 0} / (z + design::Complex{-a, 0});
    EXPECT_NEAR(answer.lines[k].gain.re, expected.re, 1e-13 * expected.size());
    EXPECT_NEAR(answer.lines[k].gain.im, expected.im, 1e-13 * expected.size());
    EXPECT_NEAR(answer.lines[k].coherence, 1.0, 1e-12);
    EXPECT_LT(answer.lines[k].scatter, 1e-12);
  }
}

/// The square of the input has power only at even lines of the spectrum. Noise differs from period to period
/// and lowers the coherence.
TEST(Multisine, SquaresFallBesideAndNoiseCostsCoherence) {
  const Multisine signal{512, analysis::odd_lines(100, 16), 1.0};
  const std::vector<double> r = samples_of(signal);
  std::vector<double> squared, noisy;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.5);
  for (std::size_t n = 0; n < 8 * r.size(); ++n) {
    const double x = r[n % r.size()];
    squared.push_back(3 * x + x * x);
    noisy.push_back(3 * x + noise(random));
  }
  const analysis::Answer even = answer_to(signal, squared), rough = answer_to(signal, noisy);
  EXPECT_GT(even.beside, 0.05);
  double strayed = 0, scatter = 0;
  for (std::size_t k = 0; k < signal.lines.size(); ++k) {
    EXPECT_NEAR(even.lines[k].gain.re, 3.0, 1e-12);
    EXPECT_NEAR(even.lines[k].gain.im, 0.0, 1e-12);
    const double off = std::hypot(rough.lines[k].gain.re - 3, rough.lines[k].gain.im) / 3;
    strayed += off * off / 2;  // mean of the real and the imaginary part
    scatter += rough.lines[k].scatter * rough.lines[k].scatter / 2;
    EXPECT_LT(rough.lines[k].coherence, 1.0);
    EXPECT_GT(rough.lines[k].coherence, 0.8);
  }
  EXPECT_NEAR(std::sqrt(strayed / scatter), 1.0, 0.35);  // the reported scatter is equal to the actual
                                                         // scatter
}

/// The margins computed from points of a known loop are the margins of the loop.
TEST(MeasuredLoop, MarginsAreTheLoops) {
  // L = k/(z (z - 1)). design::loop_figures() gives crossover and margins for comparison.
  const design::Transfer loop = design::series({{0.1}, {0.0, 1.0}}, design::delay(1));
  const double period_s = 50e-6;
  const design::LoopFigures figures = design::loop_figures(loop, period_s);
  const Multisine signal{4096, analysis::odd_lines(1800, 64), 1.0};
  analysis::Answer answer;
  for (const std::size_t line : signal.lines) {
    const design::Complex L = loop.at(2 * base::pi * static_cast<double>(line) / 4096);
    answer.lines.push_back({.gain = L / (L + design::Complex{1, 0}), .coherence = 1.0, .scatter = 0.0});
  }
  const auto points = loop_points(signal, answer, period_s);
  const analysis::ReadMargins read = margins_of(points);
  ASSERT_TRUE(read.crossover_rad_s && read.phase_rad && read.gain && read.bandwidth_rad_s);
  EXPECT_NEAR(*read.crossover_rad_s, *figures.crossover_rad_s, 2e-3 * *figures.crossover_rad_s);
  EXPECT_NEAR(*read.phase_rad, *figures.phase_rad, 2e-3);
  EXPECT_NEAR(*read.gain, *figures.gain, 1e-2 * *figures.gain);
  EXPECT_NEAR(*read.bandwidth_rad_s, *figures.bandwidth_rad_s, 5e-3 * *figures.bandwidth_rad_s);
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_NEAR(points[k].gain, loop.at(points[k].w_rad_s * period_s).size(), 1e-9 * points[k].gain);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The physics most often missed (ENGINE): under soft chopping the floating phase starts to conduct.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/naive.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double length_s = 0.1, grid_s = 0.25e-3;

struct Differences {
  double current = 0, speed = 0, peak_current = 0, top_speed = 0;
};

/// Half duty from rest, engine against the textbook simulator, on a grid.
Differences against_naive(double step_s) {
  const Board board = Board::duty(0.5);
  auto engine = board.rig();
  NaiveSoftChopper naive(board, step_s);
  Differences d;
  const int steps = static_cast<int>(std::lround(grid_s / step_s)),
            period = static_cast<int>(std::lround(30e-6 / step_s));
  std::int64_t n = 0;
  for (int row = 1; row <= std::lround(length_s / grid_s); ++row) {
    EXPECT_EQ(run_to(engine, row * grid_s), sim::Stop::end);
    for (int k = 0; k < steps; ++k, ++n) naive.step(n % period < period / 2);
    for (int k = 0; k < 3; ++k) {
      d.current = std::max(d.current, std::fabs(naive.i(k) - engine.plant().state().i[k]));
      d.peak_current = std::max(d.peak_current, std::fabs(engine.plant().state().i[k]));
    }
    d.speed = std::max(d.speed, std::fabs(naive.speed() - engine.plant().state().w));
    d.top_speed = std::max(d.top_speed, engine.plant().state().w);
  }
  return d;
}

TEST(SoftChopping, FloatingPhaseStartsToConductAndLeavingItOutCostsTenPercentOfPeakCurrent) {
  const Differences d = against_naive(0.25e-6);
  // 10.6 % and 0.4 % (ENGINE); a step of 0.25 us adds to the naive side about 0.1 to 0.3 % of its own.
  EXPECT_NEAR(d.current / d.peak_current, 0.106, 0.011);
  EXPECT_NEAR(d.speed / d.top_speed, 0.004, 0.001);
}

TEST(SoftChopping, TheDifferenceIsNotTheNaiveSimulatorsStep) {
  const Differences coarse = against_naive(0.5e-6), fine = against_naive(0.125e-6);
  EXPECT_NEAR(coarse.current, fine.current, 0.1 * fine.current);
  EXPECT_NEAR(coarse.speed, fine.speed, 0.1 * fine.speed);
}

TEST(SoftChopping, FloatingPhaseConductsInEverySectorOnceUpToSpeed) {
  const Board board = Board::duty(0.5);
  auto rig = board.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, length_s, laws), sim::Stop::end);
  laws.expect_all();
  // Counts of the reference trajectory R3.
  EXPECT_EQ(rig.happened(rig::Happening::sector_edge), 224);
  EXPECT_EQ(rig.happened(rig::Happening::diode_on), 1600);
  EXPECT_EQ(rig.happened(rig::Happening::diode_off), 2034);
}

}  // namespace

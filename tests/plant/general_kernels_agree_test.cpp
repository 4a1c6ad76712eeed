// SPDX-License-Identifier: Apache-2.0
// Both kernels give the same trajectory for all drives that the lean kernel supports. They have no common
// recurrence, mode search or guard of a leg.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

/// The largest difference, divided by the largest value: for the phase currents, and for the speed.
struct Apart {
  double current = 0, speed = 0;
};

Apart between(const Board& board, const GeneralSetup& setup, double length_s, double grid_s) {
  auto lean = board.rig();
  auto wide = general_rig(setup, board);
  double current = 0, speed = 0, most_current = 1e-9, most_speed = 1e-9;
  for (int row = 1; row <= std::lround(length_s / grid_s); ++row) {
    EXPECT_EQ(run_to(lean, row * grid_s), sim::Stop::end);
    EXPECT_EQ(run_to(wide, row * grid_s), sim::Stop::end);
    const auto &a = lean.plant().state(), &b = wide.plant().state();
    for (int k = 0; k < 3; ++k) {
      current = std::max(current, std::fabs(a.i[k] - b.i[k]));
      most_current = std::max(most_current, std::fabs(a.i[k]));
    }
    speed = std::max(speed, std::fabs(a.w - b.w));
    most_speed = std::max(most_speed, std::fabs(a.w));
    EXPECT_EQ(a.sector, b.sector);
  }
  return {current / most_current, speed / most_speed};
}

TEST(BothKernels, SayTheSameOfSoftChopping) {
  const Apart d = between(Board::duty(0.5), {}, 0.1, 0.25e-3);
  EXPECT_LT(d.current, 1e-10);
  EXPECT_LT(d.speed, 1e-12);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The scalar type is a template parameter. The results in double are compared with the results in long
// double.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

void compare(const Board& board, double length_s, double grid_s) {
  auto twice = board.rig<double>();
  auto wide = board.rig<long double>();
  double i_error = 0, i_top = 0, w_error = 0, w_top = 0;
  for (int n = 1; n <= std::lround(length_s / grid_s); ++n) {
    ASSERT_EQ(run_to(twice, n * grid_s), sim::Stop::end);
    ASSERT_EQ(run_to(wide, n * grid_s), sim::Stop::end);
    for (int k = 0; k < 3; ++k) {
      const double i = twice.plant().state().i[k];
      i_error = std::max(i_error, std::fabs(i - static_cast<double>(wide.plant().state().i[k])));
      i_top = std::max(i_top, std::fabs(i));
    }
    const double w = twice.plant().state().w;
    w_error = std::max(w_error, std::fabs(w - static_cast<double>(wide.plant().state().w)));
    w_top = std::max(w_top, std::fabs(w));
  }
  EXPECT_LE(i_error, 1e-11 * i_top);
  EXPECT_LE(w_error, 1e-12 * w_top);
  EXPECT_EQ(twice.plant().diodes_started(), wide.plant().diodes_started());
  EXPECT_EQ(twice.event_count(rig::EventKind::diode_off), wide.event_count(rig::EventKind::diode_off));
}

TEST(Pitfall11_ScalarIsATemplate, DoubleFollowsLongDoubleUnderSoftChopping) {
  compare(Board::duty(0.5), 0.1, 0.25e-3);
}

TEST(Pitfall11_ScalarIsATemplate, AndWithRealDevicesAndDeadTime) {
  Board board = Board::duty(0.5, control::Chopping::complementary);
  board.devices = {.R_on_ohm = 0.01, .V_f_V = 0.7, .r_d_ohm = 0.01};
  board.board.modulator.dead_ticks = 1e6;
  compare(board, 0.05, 0.25e-3);
}

TEST(Pitfall11_ScalarIsATemplate, AndWithFriction) {
  Board board = Board::duty(0.5);
  board.shaft.coulomb_Nm = 0.005;
  board.load(30'000'000'000, 0.05);
  compare(board, 0.05, 0.25e-3);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// Two speed cascades whose motors differ by a part in 1e12. The distance between their trajectories is a
// lower limit of the agreement that a comparison with another solver can require.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sixstep/rig/lean_rig.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/recorder.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;

struct Rows {
  GridRecorder grid;
  std::vector<std::vector<double>>& rows;
  void segment(const rig::LeanRig<double>& rig, double s) { grid.segment(rig, s); }
};

/// Phase currents and speed of the thesis's speed cascade from rest to 100 rad/s (reference case R8). The
/// factor changes only K_e.
std::vector<std::vector<double>> cascade(double K_e_factor) {
  Scenario s = maxon_scenario(control::Mode::speed, 100.0);
  s.duration_s = 0.2;
  s.control.current.d1 = 4.5;
  s.control.current.d0 = -4.04;
  s.control.speed.d1 = 0.017225;
  s.control.speed.d0 = -0.01707;
  s.control.speed.torque_limit_Nm = 0.78;
  const auto c = compile(s);
  std::vector<std::vector<double>> rows;
  if (!c) return rows;
  plant::Machine machine = c->motor.machine;
  machine.K_e_V_s *= K_e_factor;
  rig::LeanRig<double> rig({machine, c->shaft, c->devices, c->supply, c->start}, c->drive, c->board,
                           c->timeline);
  Rows rows_of{{100'000'000,
                c->end,
                {0, 1, 2, 3, static_cast<std::size_t>(ColumnId::speed)},
                [&](Row row) { rows.emplace_back(row.begin(), row.end()); }},
               rows};
  EXPECT_EQ(sim::run(rig, c->end, rows_of).stop, sim::Stop::end);
  return rows;
}

struct Apart {
  double current_A = 0.0, speed_rad_s = 0.0;
};

Apart apart(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  Apart most;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    for (std::size_t k = 1; k <= 3; ++k)
      most.current_A = std::max(most.current_A, std::fabs(a[n][k] - b[n][k]));
    most.speed_rad_s = std::max(most.speed_rad_s, std::fabs(a[n][4] - b[n][4]));
  }
  return most;
}

TEST(Pitfall13_Conditioning, TheSpeedCascadeAmplifiesATwelfthDigit) {
  const auto nominal = cascade(1.0);
  ASSERT_EQ(nominal.size(), 2001u);
  const Apart bit = apart(nominal, cascade(1.0 + 0x1p-52)), twelfth = apart(nominal, cascade(1.0 + 1e-12)),
              eleventh = apart(nominal, cascade(1.0 + 1e-11));
  std::printf(
      "K_e 1e-12 larger: currents apart by %.1e A, %.0f-fold of the stall current; speed by %.1e rad/s\n",
      twelfth.current_A, twelfth.current_A / (1e-12 * 24.0 / 1.03), twelfth.speed_rad_s);
  std::printf("one bit larger: currents apart by %.1e A\n", bit.current_A);
  // The tolerance for this cascade is 1e-9 A. Two solvers that read K_e with twelve digits may differ by
  // more. Two solvers that compute in double from the same bits may not.
  EXPECT_GT(twelfth.current_A, 1e-9);
  EXPECT_LT(bit.current_A, 1e-9);
  // The problem itself amplifies the difference, not the solver: ten times the change gives ten times the
  // distance. The tolerance is the rounding that a change of one bit shows.
  EXPECT_NEAR(eleventh.current_A / 10, twelfth.current_A, 2 * bit.current_A);
}

}  // namespace SIXSTEP_TEST_FILE

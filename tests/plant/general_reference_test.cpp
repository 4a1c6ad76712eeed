// SPDX-License-Identifier: Apache-2.0
// The general kernel is compared with trajectories that an independent brute-force solver has computed in
// float128 (tests/reference/G*). The lean kernel does not support these machines, shafts, bridges and
// supplies. If a test states nothing else, the duty is one half with soft chopping. The largest difference of
// a column, divided by the column's largest value, is at most 1e-10; for speed and angle, it is at most
// 1e-12.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

using Columns = std::map<std::string, std::vector<double>>;

Columns trajectory(const std::string& name) {
  std::ifstream file(SIXSTEP_SOURCE_DIR "/tests/reference/" + name + ".csv");
  std::string line, cell;
  std::vector<std::string> names;
  Columns all;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    for (std::size_t n = 0; std::getline(cells, cell, ','); ++n) {
      if (all.size() < names.size() || names.size() <= n)
        names.push_back(cell), all[cell];
      else
        all[names[n]].push_back(std::stod(cell));
    }
  }
  return all;
}

/// The rig's value of the quantity in the trajectory's column `column`.
double value_of(const std::string& column, const GeneralRig& rig) {
  const auto& plant = rig.plant();
  const auto& s = plant.state();
  const double angle =
      (static_cast<double>(s.sector) * base::sector_rad + s.x) / plant.constants().pole_pairs;
  if (column == "i_a") return s.i[0];
  if (column == "i_b") return s.i[1];
  if (column == "i_c") return s.i[2];
  if (column == "w_m") return s.w;
  if (column == "theta_m") return angle;
  if (column == "U_s") return s.bus;
  if (column == "i_src") return plant.more().source.value;
  if (column == "j_sum") return plant.more().loop.value;
  if (column == "w_2") return plant.more().load_w.value;
  if (column == "theta_2") return plant.constants().inv_gear * angle - plant.more().twist.value;
  return NAN;
}

struct Case {
  GeneralSetup setup;
  Board board = Board::duty(0.5);
};

void matches(const std::string& name, const Case& given) {
  const Columns theirs = trajectory(name);
  const std::vector<double>& t = theirs.at("t");
  ASSERT_GT(t.size(), 100u);
  GeneralRig rig = general_rig(given.setup, given.board);
  std::map<std::string, double> worst, peak;
  for (std::size_t row = 0; row < t.size(); ++row) {
    ASSERT_EQ(run_to(rig, t[row]), sim::Stop::end) << name << " at " << t[row];
    for (const auto& [column, values] : theirs) {
      if (column == "t") continue;
      worst[column] = std::max(worst[column], std::fabs(value_of(column, rig) - values[row]));
      peak[column] = std::max(peak[column], std::fabs(values[row]));
    }
  }
  for (const auto& [column, difference] : worst) {
    const bool mechanical = column[0] == 'w' || column[0] == 't';
    const double scale = peak[column] > 0 ? peak[column] : 1.0;
    EXPECT_LE(difference / scale, mechanical ? 1e-12 : 1e-10) << name << " " << column;
  }
}

TEST(GeneralReference, DeltaWithItsLoopCurrent) {
  Case c;
  const double K = 0.0335 * 6 / 7;
  c.setup.machine = {.winding = general::Winding::delta,
                     .R_ohm = {1.545, 1.545, 1.545},
                     .K_e_V_s = {K, K, K},
                     .L_H = 0.858e-3,
                     .pole_pairs = 8};
  matches("G1", c);
}

TEST(GeneralReference, BackEmfOfOddHarmonics) {
  Case c;
  c.setup.machine.shape.harmonics = {{1, 1.0}, {3, 0.12}, {5, -0.05}, {7, 0.02}};
  matches("G3", c);
}

TEST(GeneralReference, Cogging) {
  Case c;
  c.board = Board::duty(0.3);
  c.setup.machine.cogging = {{48, 0.008, 0.3}, {96, 0.002, 1.0}};
  matches("G5", c);
}

TEST(GeneralReference, Saliency) {
  Case c;
  c.setup.machine.shape.harmonics = {{1, 1.0}};
  c.setup.machine.L_d_H = 0.24e-3;
  c.setup.machine.L_q_H = 0.34e-3;
  matches("G6", c);
}

TEST(GeneralReference, PhasesThatAreNotAlike) {
  Case c;
  c.setup.machine.R_ohm = {0.515 * 1.05, 0.515 * 0.97, 0.515};
  c.setup.machine.K_e_V_s = {0.01675, 0.01675 * 0.96, 0.01675 * 1.02};
  matches("G7", c);
}

TEST(GeneralReference, Igbts) {
  Case c;
  c.setup.devices = {.igbt = true, .R_on_ohm = 0.02, .V_ce_V = 0.9, .V_f_V = 0.8, .r_d_ohm = 0.015};
  c.board = Board::duty(0.5, control::Chopping::complementary);
  c.board.board.modulator.dead_ticks = 1e6;
  matches("G8", c);
}

TEST(GeneralReference, ElasticShaft) {
  Case c;
  c.setup.shaft.load_J_kg_m2 = 5e-5;
  c.setup.shaft.load_B_Nm_s = 2e-6;
  c.setup.shaft.stiffness_Nm = 2.0;
  c.setup.shaft.damping_Nm_s = 1e-4;
  c.board.load(30'000'000'000, 0.05);
  matches("G9", c);
}

TEST(GeneralReference, GearFanAndGravity) {
  Case c;
  c.setup.shaft.gear = 3;
  c.setup.shaft.load_J_kg_m2 = 1e-4;
  c.setup.shaft.load = {.fan_Nm_s2 = 2e-7, .gravity_Nm = 0.03, .gravity_angle_rad = 0.2};
  matches("G10", c);
}

TEST(GeneralReference, SourceThatCannotSinkWithABrakeChopper) {
  Case c;
  c.setup.supply = {.V_0_V = 24,
                    .R_b_ohm = 0.1,
                    .L_b_H = 5e-6,
                    .C_F = 470e-6,
                    .sinks = false,
                    .brake_ohm = 2,
                    .brake_on_V = 30,
                    .brake_off_V = 28};
  c.setup.start.speed_rad_s = 500;
  c.board = Board::duty(0.3, control::Chopping::complementary);
  c.board.board.modulator.dead_ticks = 1e6;
  matches("G11", c);
}

TEST(GeneralReference, SourceThatBlocksAndConductsAgainAsItRings) {
  Case c;
  c.setup.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .L_b_H = 5e-6, .C_F = 470e-6, .sinks = false};
  matches("G11c", c);
}

TEST(GeneralReference, AWireThatBreaks) {
  Case c;
  c.board.timeline.push_back({{10'000'000'000, 0.0}, rig::ActionKind::wire_break, 1.0});
  matches("G13", c);
}

TEST(GeneralReference, ProbesThatAreMountedAskew) {
  Case c;
  c.setup.probes.placement = {
      .offset_deg = 4, .hysteresis_deg = 2, .own_deg = {0.0, 3.0, -2.0, 1.0, -4.0, 2.0}};
  matches("G14", c);
}

}  // namespace SIXSTEP_TEST_FILE

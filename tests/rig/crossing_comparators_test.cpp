// SPDX-License-Identifier: Apache-2.0
// The terminals of a rotor at constant speed are filtered and compared. The filter's lag tau delays the zero
// crossings of a sine by atan(w tau)/w. The comparator's offset and hysteresis shift the crossings by an arc
// sine.
#include "sixstep/rig/crossing_comparators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

struct Edge {
  std::uint8_t lines;
  double at_s;
};

struct Capturing : rig::SensedDrive<double> {
  using SensedDrive::SensedDrive;
  std::vector<Edge> edges;
  void look_at_terminals(const plant::PerLeg<double>&) {}
  void captured_crossing(std::uint8_t lines, const sim::Instant& at) {
    edges.push_back({lines, at.seconds()});
  }
};
using CapturingRig = rig::Rig<double, Capturing>;

constexpr double tau = 50e-6, w = 250.0, w_e = 8 * w;

/// A flywheel without friction, which keeps the speed of 250 rad/s.
Board flywheel(const rig::CrossingComparators& comparators) {
  Board board = Board::duty(0.4);
  board.machine.back_emf = plant::BackEmf::sine;
  board.shaft = {.J_kg_m2 = 1e9};
  board.start.speed_rad_s = w;
  board.board.front_end = {.comparators = comparators};
  return board;
}

std::vector<Edge> edges_of(const Board& board, double end_s) {
  CapturingRig rig(board.plant(), board.drive, board.board, board.timeline);
  EXPECT_EQ(run_to(rig, end_s), sim::Stop::end);
  return rig.firmware().edges;
}

double amplitude() { return 0.01675 * w / std::hypot(1, w_e * tau); }

/// After 2 ms (40 time constants), the initial transient has decayed. Each later edge is at its closed-form
/// angle. Line a rises `rises_late_rad` after the lagged crossing of e_a at -30 degrees. Each further line
/// rises a third of a turn later.
void expect_edges(const std::vector<Edge>& edges, double rises_late_rad, double falls_late_rad) {
  std::uint8_t before = 0;
  int seen = 0;
  for (const Edge& edge : edges) {
    const unsigned changed = before ^ edge.lines;
    before = edge.lines;
    if (edge.at_s < 2e-3) continue;
    const int leg = changed == 4 ? 0 : changed == 2 ? 1 : 2;
    ASSERT_TRUE(changed == 4 || changed == 2 || changed == 1) << changed;
    const bool rises = (edge.lines & changed) != 0;
    const double lag = std::atan(w_e * tau) + (rises ? rises_late_rad : falls_late_rad);
    const double at = base::pi / 180 * (-30 + 120 * leg + (rises ? 0 : 180)) + lag;
    const double off = std::remainder(w_e * edge.at_s - at, 2 * base::pi);
    // The bound, in radians, is the rounding error of a voltage of 24 V divided by the slope `amplitude`.
    EXPECT_LT(std::fabs(off), 1e-12 * 24 / amplitude()) << leg << rises << " " << edge.at_s;
    ++seen;
  }
  EXPECT_GE(seen, 30);
}

TEST(CrossingComparators, ACoastingSineCrossesLateByTheLag) {
  Board board = flywheel({.lag_s = tau});
  board.drive.mode = control::Mode::off;
  expect_edges(edges_of(board, 20e-3), 0, 0);
}

TEST(CrossingComparators, OffsetAndHysteresisShiftTheEdges) {
  Board board = flywheel({.lag_s = tau, .offset_V = {0.3, 0.3, 0.3}, .hysteresis_V = 0.5});
  board.drive.mode = control::Mode::off;
  const double rise = std::asin((0.3 + 0.25) / amplitude()), fall = std::asin((0.3 - 0.25) / amplitude());
  expect_edges(edges_of(board, 20e-3), rise, -fall);
}

/// The mean of the three terminals cancels the star point's voltage, even with chopping. A floating leg then
/// shows e_k minus the mean of the three back-EMFs, which is zero for sines.
TEST(CrossingComparators, ChoppingIsNotSeenAgainstTheVirtualStar) {
  Board board = flywheel({.lag_s = tau, .hysteresis_V = 0.1});
  board.start.speed_rad_s = 0;
  board.shaft.locked = true;
  EXPECT_TRUE(edges_of(board, 20e-3).size() <= 2);  // of the driven pair, one edge per leg
}

/// Half the bus voltage as reference does not cancel the star point's voltage. The terminal of a floating leg
/// then has the mean d U/2 (duty d, bus voltage U), and a ripple around this mean.
TEST(CrossingComparators, HalfTheBusIsPassedAtEveryChopWhereTheRippleReachesIt) {
  Board board = flywheel({.lag_s = tau, .against = rig::CrossingReference::half_bus});
  board.shaft.locked = true;
  board.start.speed_rad_s = 0;
  board.board.front_end.comparators.lag_s = 10e-6;
  board.timeline.clear();
  board.setpoint(0, 0.5);
  const std::vector<Edge> edges = edges_of(board, 3e-3);
  // In the steady state, terminal a at the duty d = 1/2 varies between U/2 +- (U/2) tanh(T/(4 tau)) (bus
  // voltage U, period T). It crosses U/2 once in each half of the period.
  double on = 0, off = 0;
  std::uint8_t before = 0;
  for (const Edge& edge : edges) {
    const bool of_a = ((before ^ edge.lines) & 4) != 0;
    before = edge.lines;
    if (!of_a || edge.at_s < 2e-3) continue;
    const double t = std::fmod(edge.at_s + 1e-12, 30e-6) - 1e-12;
    (t < 15e-6 ? on : off) = t;
  }
  const double e = std::exp(-15e-6 / 10e-6), half = 10e-6 * std::log(2 / (1 + e));
  EXPECT_NEAR(on, half, 1e-16 + 1e-12 * 2e-3);  // the run's clock has integer picoseconds and fractions
  EXPECT_NEAR(off, 15e-6 + half, 1e-16 + 1e-12 * 2e-3);
}

TEST(CrossingComparators, WithoutThemNothingIsCaptured) {
  Board board = flywheel({});
  EXPECT_TRUE(edges_of(board, 5e-3).empty());
}

}  // namespace SIXSTEP_TEST_FILE

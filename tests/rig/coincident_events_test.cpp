// SPDX-License-Identifier: Apache-2.0
// Two things at one instant, one test per pair of: scenario step, control tick, PWM edge, comparator, sector
// edge, current zero. Both must happen, once, with the effect of MODEL 4b's order (ENGINE, pitfall 1: a lost
// tick passes every energy balance). Here: the pairs of PWM edge, comparator, sector edge, current zero.
#include <gtest/gtest.h>

#include "tests/support/coinciding.hpp"
#include "tests/support/laws.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using rig::Happening;

TEST(Coincidence, PwmEdgeAndComparator) {
  // Complementary with a dead time of 1 us: off by a step at 500 us; the leg's dead time ends just when the
  // next step wants it on again.
  Board b = locked(Board::hysteresis(20.0, 0.25, Chopping::complementary));
  b.board.modulator.dead_ticks = 1e6;
  b.setpoint(500'000'000, 1.0);
  b.setpoint(501'000'000, 20.0);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 500.5 * us), sim::Stop::end);
  ASSERT_FALSE(rig.plant().gates().high[0]);
  ASSERT_FALSE(rig.plant().gates().low[0]);
  ASSERT_EQ(run_to(rig, 501 * us), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on()) << "the comparator did switch";
  EXPECT_FALSE(rig.plant().gates().low[0]) << "no glitch of the lower switch";
  EXPECT_FALSE(rig.plant().gates().high[0]) << "the turn-on waits";
  ASSERT_EQ(run_to(rig, 502 * us), sim::Stop::end);
  EXPECT_TRUE(rig.plant().gates().high[0]);
}

TEST(Coincidence, PwmEdgeAndSectorEdge) {
  Board b = turning(Board::duty(0.5), 15 * us);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 15 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
  EXPECT_EQ(rig.happened(Happening::pwm_edge), 1);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_EQ(rig.plant().gates(), gates({}, {false, false, true}));
  laws.expect_all();
}

TEST(Coincidence, PwmEdgeAndCurrentZero) {
  // Centre-aligned: the gap from off edge to the next on edge is the period less the on-time.
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.board.modulator.centre_aligned = true;
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 30 * us) / (30 * us));
  auto rig = b.rig();
  LawChecker<> laws;
  const double duty = b.timeline[0].value, on_edge_s = 30 * us * (1 + (1 - duty) / 2);
  ASSERT_EQ(run_to(rig, on_edge_s + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::pwm_edge), 3);
  EXPECT_TRUE(rig.plant().gates().high[0]);
  EXPECT_NEAR(rig.plant().state().i[0], 24.0 * ns / b.L_tt(), 1e-2 * 24.0 * ns / b.L_tt());
  laws.expect_all();
}

/// A comparator is judged again at once wherever its current jumps: never a segment that begins beyond its
/// level.
struct NeverBeyond {
  int beyond = 0, segments_of_edges = 0, last_sector = 0;
  void segment(const rig::Rig<double, double>& rig, double s) {
    if (!(s > 0)) return;
    const rig::ArmedComparator c = rig.modulator().comparator(0);
    const auto w = rig.modulator().comparator_weights(0);
    const auto& i = rig.plant().state().i;
    const double current = w[0] * i[0] + w[1] * i[1] + w[2] * i[2];
    segments_of_edges += rig.plant().sector() != last_sector;
    last_sector = rig.plant().sector();
    if (c.armed && (c.switches_off ? current > c.level_A + 1e-11 : current < c.level_A - 1e-11)) ++beyond;
  }
};

TEST(Coincidence, ComparatorAndSectorEdge) {
  // At an edge the motor current is another mean of phases: it jumps, and the comparator follows at once.
  Board b = Board::hysteresis(5.0, 0.2, Chopping::soft);
  auto rig = b.rig();
  NeverBeyond watch;
  ASSERT_EQ(run_to(rig, 20e-3, watch), sim::Stop::end);
  EXPECT_GT(watch.segments_of_edges, 5);
  EXPECT_EQ(watch.beyond, 0);
}

TEST(Coincidence, ComparatorAndCurrentZero) {
  // The lower level is zero itself: the current vanishes there, exactly, and is not strictly below it.
  Board b = locked(Board::hysteresis(0.5, 0.5, Chopping::hard));
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 1e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::diode_off), 1);
  EXPECT_FALSE(rig.modulator().source_on());
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  laws.expect_all();
}

TEST(Coincidence, SectorEdgeAndCurrentZero) {
  const double edge_s = 20 * us;
  Board b = turning(Board::duty(0.0, Chopping::hard), edge_s);
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 2 * b.machine.K_e_V_s * 300.0, edge_s) / (30 * us));
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, edge_s - ns, laws), sim::Stop::end);
  EXPECT_GT(rig.plant().state().i[0], 0.0);
  EXPECT_EQ(rig.plant().sector(), 0);
  ASSERT_EQ(run_to(rig, edge_s + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
  EXPECT_EQ(rig.happened(Happening::diode_off), 1);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  ASSERT_EQ(run_to(rig, 31 * us, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
  laws.expect_all();
}

}  // namespace

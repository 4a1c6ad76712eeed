// SPDX-License-Identifier: Apache-2.0
// Each test has two events at one instant. There is one test for each pair of scenario step, control tick,
// PWM edge, comparator, sector edge and current zero. Each of the two events must take effect once, in the
// order of model.md 4b (pitfall 1: no energy balance detects a lost tick). This file contains the pairs of
// PWM edge, comparator, sector edge and current zero.
#include <gtest/gtest.h>

#include "tests/support/coinciding.hpp"
#include "tests/support/laws.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using rig::EventKind;

TEST(Pitfall01_CoincidentInstants, PwmEdgeAndComparator) {
  // The chopping is complementary with a dead time of 1 us. A setpoint step turns the upper switch off at 500
  // us. The dead time after this turn-off ends exactly when the next setpoint step turns the upper switch on
  // again.
  Board b = locked(Board::hysteresis(20.0, 0.25, Chopping::complementary));
  b.board.modulator.dead_ticks = 1e6;
  b.setpoint(500'000'000, 1.0);
  b.setpoint(501'000'000, 20.0);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 500.5 * us), sim::Stop::end);
  ASSERT_EQ(rig.event_count(EventKind::pwm_edge), 1) << "end of the first turn-on's dead time";
  ASSERT_EQ(rig.event_count(EventKind::comparator), 1);
  ASSERT_FALSE(rig.plant().gates().high[0]);
  ASSERT_FALSE(rig.plant().gates().low[0]);
  ASSERT_EQ(run_to(rig, 501 * us), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on()) << "the comparator did switch";
  EXPECT_EQ(rig.event_count(EventKind::comparator), 2);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 2)
      << "the edge first: the comparator would have replaced it";
  EXPECT_FALSE(rig.plant().gates().low[0]) << "no glitch of the lower switch";
  EXPECT_FALSE(rig.plant().gates().high[0]) << "the turn-on waits";
  ASSERT_EQ(run_to(rig, 502 * us), sim::Stop::end);
  EXPECT_TRUE(rig.plant().gates().high[0]);
}

TEST(Pitfall01_CoincidentInstants, PwmEdgeAndSectorEdge) {
  Board b = turning(Board::duty(0.5), 15 * us);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 15 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 1);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_EQ(rig.plant().gates(), gates({}, {false, false, true}));
  laws.expect_all();
}

TEST(Pitfall01_CoincidentInstants, PwmEdgeAndCurrentZero) {
  // The PWM is centre-aligned. The off edge and the next on edge are therefore one off-time apart, which is
  // the period minus the on-time.
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.board.modulator.centre_aligned = true;
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 30 * us) / (30 * us));
  auto rig = b.rig();
  LawChecker<> laws;
  const double duty = b.timeline[0].value, on_edge_s = 30 * us * (1 + (1 - duty) / 2);
  ASSERT_EQ(run_to(rig, on_edge_s + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::pwm_edge), 3);
  EXPECT_TRUE(rig.plant().gates().high[0]);
  EXPECT_NEAR(rig.plant().state().i[0], 24.0 * ns / b.L_tt(), 1e-2 * 24.0 * ns / b.L_tt());
  laws.expect_all();
}

struct UntilDiodeStops {
  template <class Rig>
  void segment(const Rig&, double) {}
  template <class Rig>
  bool done(const Rig& rig) const {
    return rig.event_count(EventKind::diode_off) > 0;
  }
};

/// Runs to `at_s` with a comparator level above any current. Returns the current that the comparator measures
/// at `at_s`.
double current_at(Board b, double at_s) {
  b.timeline[0].value = 1e3;
  auto rig = b.rig();
  EXPECT_EQ(run_to(rig, at_s), sim::Stop::end);
  const auto w = rig.modulator().comparator_weights(0);
  const auto& i = rig.plant().state().i;
  return w[0] * i[0] + w[1] * i[1] + w[2] * i[2];
}

/// Runs the check with levels that differ from `level` by up to four units of the last bit, in both
/// directions. The result must not depend on which event rounding puts first. The setpoint is 0.25 A below
/// the level, which is the hysteresis.
template <class Check>
void at_levels_around(double level, Board b, Check&& check) {
  for (int bits = -4; bits <= 4; ++bits) {
    SCOPED_TRACE(bits);
    b.timeline[0].value = level * (1 + bits * eps) - 0.25;
    auto rig = b.rig();
    check(rig);
  }
}

TEST(Pitfall01_CoincidentInstants, ComparatorAndSectorEdgeBothHappen) {
  // The comparator measures a phase current. Phase a is the source before and after the edge, so this current
  // does not jump. The comparator trips once, at the edge, in either order of the two events.
  const double edge_s = 70 * us;
  Board b = turning(Board::hysteresis(5.0, 0.25, Chopping::soft), edge_s);
  b.drive.hysteresis.watch = control::Watch::phase;
  const double level = current_at(b, edge_s);
  double first = 0.0;
  at_levels_around(level, b, [&](auto& rig) {
    LawChecker<> laws;
    ASSERT_EQ(run_to(rig, edge_s + ns, laws), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
    EXPECT_EQ(rig.event_count(EventKind::comparator), 1);
    EXPECT_FALSE(rig.modulator().source_on());
    EXPECT_EQ(rig.plant().gates(), gates({}, {false, false, true}));
    // Rounding may change the time at which the switch turns off. The current may then differ by 64 eps of
    // the stall current, the noise of the guard.
    if (first == 0.0) first = rig.plant().state().i[0];
    EXPECT_NEAR(rig.plant().state().i[0], first, 2 * 64 * eps * rig.plant().constants().amp_scale);
    laws.expect_all();
  });
}

TEST(Pitfall01_CoincidentInstants, ComparatorAndSectorEdgeWhereTheEdgeTakesTheCauseAway) {
  // The comparator measures the motor current i_m. At the edge, i_m changes to the mean of another pair,
  // which is half as large. If the edge is first, the comparator does not trip. If rounding puts the
  // comparator first, the comparator is evaluated again just after the edge and turns the switch on again.
  const double edge_s = 70 * us;
  const Board b = turning(Board::hysteresis(5.0, 0.25, Chopping::soft), edge_s);
  const double level = current_at(b, edge_s - 1e-12) / (1 - 1e-12 / edge_s);
  at_levels_around(level, b, [&](auto& rig) {
    ASSERT_EQ(run_to(rig, edge_s + ns), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
    EXPECT_EQ(rig.event_count(EventKind::comparator) % 2, 0);
    EXPECT_LE(rig.event_count(EventKind::comparator), 2);
    EXPECT_TRUE(rig.modulator().source_on());
    EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
  });
}

TEST(Pitfall01_CoincidentInstants, ComparatorAndCurrentZeroBothHappen) {
  // After a Hall edge, the current of the old sink decays in a diode while the current of the source rises.
  // The old sink's current reaches zero at some instant. The comparator's level is the source's current at
  // this instant.
  const Board b = turning(Board::hysteresis(5.0, 0.25, Chopping::hard), 70 * us);
  Board free = b;
  free.timeline[0].value = 1e3;
  auto scout = free.rig();
  UntilDiodeStops until;
  ASSERT_EQ(run_to(scout, 300 * us, until), sim::Stop::observer);
  const double zero_s = scout.now().seconds(), level = scout.plant().state().i[0];
  ASSERT_GT(zero_s, 70 * us);
  at_levels_around(level, b, [&](auto& rig) {
    LawChecker<> laws;
    ASSERT_EQ(run_to(rig, zero_s + ns, laws), sim::Stop::end);
    EXPECT_EQ(rig.event_count(EventKind::comparator), 1);
    EXPECT_FALSE(rig.modulator().source_on());
    EXPECT_EQ(rig.plant().gates(), all_off());
    // The current of the old sink remains zero. It reaches zero by its own event. If the comparator is first,
    // it is zero within rounding at that instant.
    EXPECT_LE(rig.event_count(EventKind::diode_off), 1);
    EXPECT_EQ(rig.plant().state().i[1], 0.0);
    EXPECT_TRUE(plant::is_floating(rig.plant().mode().legs[1]));
    laws.expect_all();
  });
}

TEST(Pitfall01_CoincidentInstants, AComparatorThatWaitsForZeroDoesNotTripThere) {
  // The lower level is zero. The current reaches exactly zero, which is not strictly below the level.
  Board b = locked(Board::hysteresis(0.5, 0.5, Chopping::hard));
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 1e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::diode_off), 1);
  EXPECT_FALSE(rig.modulator().source_on());
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  laws.expect_all();
}

TEST(Pitfall01_CoincidentInstants, SectorEdgeAndCurrentZero) {
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
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
  EXPECT_EQ(rig.event_count(EventKind::diode_off), 1);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  ASSERT_EQ(run_to(rig, 31 * us, laws), sim::Stop::end);
  EXPECT_EQ(rig.event_count(EventKind::sector_edge), 1);
  EXPECT_EQ(rig.plant().gates(), gates({true, false, false}, {false, false, true}));
  laws.expect_all();
}

/// A comparator is evaluated again whenever its current jumps. No segment may begin with a current beyond the
/// comparator's level.
struct NeverBeyond {
  int beyond = 0, segments_of_edges = 0, last_sector = 0;
  void segment(const rig::LeanRig<double>& rig, double s) {
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

TEST(Pitfall08_Sticking, TheComparatorIsJudgedAgainAfterASectorEdge) {
  // At an edge, the motor current jumps to the mean of another pair. The comparator must react at once.
  Board b = Board::hysteresis(5.0, 0.2, Chopping::soft);
  auto rig = b.rig();
  NeverBeyond watch;
  ASSERT_EQ(run_to(rig, 20e-3, watch), sim::Stop::end);
  EXPECT_GT(watch.segments_of_edges, 5);
  EXPECT_EQ(watch.beyond, 0);
}

}  // namespace SIXSTEP_TEST_FILE

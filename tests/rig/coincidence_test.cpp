// SPDX-License-Identifier: Apache-2.0
// Two things at one instant, one test per pair of: scenario step, control tick, PWM edge, comparator, sector
// edge, current zero. Both must happen, once, with the effect of MODEL 4b's order (ENGINE, pitfall 1: a lost
// tick passes every energy balance).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/board.hpp"
#include "tests/support/laws.hpp"

namespace {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using rig::Happening;

constexpr std::int64_t period = 30'000'000;
constexpr double us = 1e-6, ns = 1e-9;

Board locked(Board b) {
  b.shaft.locked = true;
  b.start.angle_rad = 0.02;  // sector 0: a to b
  return b;
}

/// Speed that no torque changes (2 K_e w = 10 V), with the edge from sector 0 to 1 at `edge_s`.
Board turning(Board b, double edge_s) {
  b.shaft.J_kg_m2 = 1e9;
  b.shaft.B_Nm_s = 0.0;
  b.start.speed_rad_s = 300.0;
  b.start.angle_rad = at_electrical_deg(60.0) - 300.0 * edge_s;
  return b;
}

/// On-time after which a current, pushed by U - E and pulled by U + E, is back at zero at `zero_s`.
double on_time_for_zero(const Drivetrain& d, double E, double zero_s) {
  const double U = 24.0, R = d.R_tt(), tau = d.tau();
  double low = 0, high = zero_s;
  for (int n = 0; n < 200; ++n) {
    const double on = low + (high - low) / 2, i = -(U - E) / R * std::expm1(-on / tau);
    (on + tau * std::log1p(i * R / (U + E)) > zero_s ? high : low) = on;
  }
  return low;
}

template <class Rig>
int source_leg(const Rig& rig) {
  return static_cast<int>(rig.modulator().command().pair.source);
}
template <class Rig>
int sink_leg(const Rig& rig) {
  return static_cast<int>(rig.modulator().command().pair.sink);
}

TEST(Coincidence, StepAndTickTheTickSeesTheStep) {
  Board b = Board::duty(0.5);
  b.setpoint(500 * period, -0.25);  // 15 ms
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 15e-3), sim::Stop::end);
  EXPECT_EQ(rig.setpoint(), -0.25);
  EXPECT_EQ(rig.telemetry().duty, -0.25) << "a reference that steps at 15 ms is new at that sample";
  EXPECT_EQ(rig.happened(Happening::tick), 501);
}

TEST(Coincidence, StepAndPwmEdge) {
  Board b = locked(Board::duty(0.5));
  b.setpoint(10 * period + period / 2, 0.75);
  b.load(10 * period + period / 2, 0.1);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 10.5 * 30 * us), sim::Stop::end);
  EXPECT_EQ(rig.setpoint(), 0.75);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.1);
  EXPECT_FALSE(rig.modulator().source_on()) << "the running period keeps its duty";
  EXPECT_EQ(rig.happened(Happening::pwm_edge), 11);
  ASSERT_EQ(run_to(rig, 11.5 * 30 * us), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on());
}

TEST(Coincidence, StepAndComparator) {
  Board b = locked(Board::hysteresis(10.0, 0.25, Chopping::soft));
  b.setpoint(123'456'789, 1.0);  // the current lies between: the comparator trips at that very instant
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 123.456788 * us), sim::Stop::end);
  ASSERT_TRUE(rig.modulator().source_on());
  ASSERT_GT(rig.plant().state().i[0], 1.25);
  ASSERT_EQ(run_to(rig, 123.456789 * us), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_FALSE(rig.plant().gates().high[0]);
  ASSERT_EQ(run_to(rig, 130 * us), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on()) << "and only once";
  EXPECT_EQ(rig.modulator().turn_ons(), 1);
}

TEST(Coincidence, StepAndSectorEdge) {
  Board b = turning(Board::duty(1.0), 20 * us);
  b.setpoint(20'000'000, 0.5);
  b.load(20'000'000, 0.125);
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 20 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
  EXPECT_EQ(sink_leg(rig), 2);
  EXPECT_EQ(rig.setpoint(), 0.5);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.125);
  laws.expect_all();
}

TEST(Coincidence, StepAndCurrentZero) {
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 27 * us) / (30 * us));
  b.setpoint(27'000'000, 0.75);
  b.load(27'000'000, 0.125);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 27 * us + ns), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::diode_off), 1);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(rig.plant().state().i[k], 0.0);
  EXPECT_EQ(static_cast<double>(rig.plant().constants().load), 0.125);
  ASSERT_EQ(run_to(rig, 30 * us), sim::Stop::end);
  EXPECT_EQ(rig.telemetry().duty, 0.75);
  EXPECT_EQ(rig.happened(Happening::diode_off), 1);
}

TEST(Coincidence, TickAndPwmEdgeTheTickComesFirst) {
  // Dead time of half a period: at each tick a dead time ends just when the new one begins.
  Board b = locked(Board::duty(0.5, Chopping::complementary));
  b.board.modulator.dead_ticks = 15e6;
  auto rig = b.rig();
  for (int n = 1; n < 20; ++n) {
    ASSERT_EQ(run_to(rig, n * 15 * us), sim::Stop::end);
    EXPECT_EQ(rig.happened(Happening::tick), n / 2 + 1);
    EXPECT_FALSE(rig.plant().gates().high[0]);
    EXPECT_FALSE(rig.plant().gates().low[0]);
  }
  EXPECT_EQ(rig.plant().state().i[0], 0.0);
}

TEST(Coincidence, TickAndAPwmEdgeThatTheTimerRoundsOntoItLeaveNoGap) {
  Board b = locked(Board::duty(0.999));
  b.board.modulator.timer_ticks = 1e6;  // 29.97 us -> 30 us
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 1e-3, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::pwm_edge), 0);
  const double exact = -24.0 / b.R_tt() * std::expm1(-1e-3 / b.tau());
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-13 * exact);
}

TEST(Coincidence, TickAndComparator) {
  Board b = locked(Board::hysteresis(0.0, 0.25, Chopping::soft));
  const double i_5 = -24.0 / b.R_tt() * std::expm1(-150e-6 / b.tau());  // at the fifth tick
  b.timeline.clear();
  b.setpoint(0, i_5 - 0.25);
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, 150 * us - ns), sim::Stop::end);
  EXPECT_TRUE(rig.modulator().source_on());
  ASSERT_EQ(run_to(rig, 150 * us + ns), sim::Stop::end);
  EXPECT_FALSE(rig.modulator().source_on());
  EXPECT_EQ(rig.happened(Happening::tick), 6);
  EXPECT_EQ(rig.modulator().turn_ons(), 1);
}

TEST(Coincidence, TickAndSectorEdge) {
  for (const bool at_sample : {false, true}) {
    Board b = turning(Board::duty(0.5), 30 * us);
    b.board.commutate_at_sample = at_sample;
    b.setpoint(period, 0.25);
    auto rig = b.rig();
    ASSERT_EQ(run_to(rig, 30 * us + ns), sim::Stop::end);
    EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
    EXPECT_EQ(rig.happened(Happening::tick), 2);
    EXPECT_EQ(rig.telemetry().duty, 0.25);
    EXPECT_EQ(rig.plant().sector(), 1);
    // Commutation at the sample: rounding may put the edge just behind this one.
    ASSERT_EQ(run_to(rig, at_sample ? 60 * us : 31 * us), sim::Stop::end);
    EXPECT_EQ(source_leg(rig), 0);
    EXPECT_EQ(sink_leg(rig), 2);
  }
}

TEST(Coincidence, TickAndSectorEdgeAtTheStartBackwards) {
  // Exactly: on the edge at t = 0 and turning back, the tick of t = 0 falls on the edge.
  Board b = turning(Board::duty(0.5), 30 * us);
  b.start.angle_rad = 0.0;
  b.start.speed_rad_s = -100.0;
  auto rig = b.rig();
  ASSERT_EQ(run_to(rig, ns), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::sector_edge), 1);
  EXPECT_EQ(rig.happened(Happening::tick), 1);
  EXPECT_EQ(rig.plant().sector(), 5);
  EXPECT_EQ(source_leg(rig), 2);
  EXPECT_EQ(sink_leg(rig), 1);
}

TEST(Coincidence, TickAndCurrentZero) {
  Board b = locked(Board::duty(0.0, Chopping::hard));
  b.timeline.clear();
  b.setpoint(0, on_time_for_zero(b, 0.0, 30 * us) / (30 * us));
  auto rig = b.rig();
  LawChecker<> laws;
  ASSERT_EQ(run_to(rig, 30 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::tick), 2);
  EXPECT_TRUE(rig.plant().gates().high[0]);
  // Within rounding the current was zero at the tick: the second period is the first again.
  const double exact = 24.0 * ns / b.L_tt();
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-5 * exact);
  ASSERT_EQ(run_to(rig, 60 * us + ns, laws), sim::Stop::end);
  EXPECT_EQ(rig.happened(Happening::tick), 3);
  EXPECT_NEAR(rig.plant().state().i[0], exact, 1e-5 * exact);
  laws.expect_all();
}

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

// SPDX-License-Identifier: Apache-2.0
// Mounted Hall probes (model.md 10) at constant speed: every edge appears at the instant of its equation plus
// the delay, in both directions. The tests include probes 60 degrees apart, and glitches.
#include "sixstep/rig/probes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sixstep/control/hall.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double p = 8, w = 120.0;  // rad/s, mechanical
constexpr double deg_s = p * w * 180 / base::pi;

/// An external drive turns the rotor with the speed w or -w, and the bridge is off.
GeneralRig turned(const rig::ProbeGiven& probes, double sign, rig::Timeline timeline = {}) {
  GeneralSetup setup;
  setup.shaft.dynamometer = true;
  setup.start.speed_rad_s = sign * w;
  setup.probes = probes;
  Board board = Board::duty(0.0);
  board.drive.mode = control::Mode::off;
  if (probes.spaced_60) board.board.hall_arrangement = control::HallArrangement::degrees_60;
  board.timeline = std::move(timeline);
  return general_rig(setup, board);
}

struct Edge {
  double at_s;
  int sector;  // 0..5, the sector after the edge
};

/// The edges that a rotor passes from angle 0, forward or backward, and the sector after each edge. The
/// function uses only the definition of the probes.
std::vector<Edge> edges_of(const plant::HallPlacement& placed, double sign, double until_s) {
  std::vector<Edge> edges;
  const int count = placed.own_deg.empty() ? 1 : static_cast<int>(placed.own_deg.size());
  const auto own = [&](int n) {
    return placed.own_deg.empty() ? 0.0
                                  : placed.own_deg[static_cast<std::size_t>(((n % count) + count) % count)];
  };
  for (int n = -2000; n <= 2000; ++n) {
    const double place = 60.0 * n + placed.offset_deg + own(n);
    const double met = place + sign * placed.hysteresis_deg / 2;
    // Without the hysteresis, the first edge of a forward rotation is the first edge beyond 0. The first edge
    // of a backward rotation is the last edge at or below 0.
    if (sign > 0 ? place <= 0 : place > 0) continue;
    const double at_s = sign * met / deg_s;
    if (at_s < until_s) edges.push_back({at_s, (((sign > 0 ? n : n - 1) % 6) + 6) % 6});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.at_s < b.at_s; });
  return edges;
}

constexpr std::uint8_t codes_120[6] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};
constexpr std::uint8_t codes_60[6] = {0b110, 0b111, 0b011, 0b001, 0b000, 0b100};

/// Expects that the pins change within 2e-12 s of each edge, and at no other time.
void expect_edges(const rig::ProbeGiven& given, double sign) {
  GeneralRig rig = turned(given, sign);
  const double delay_s = static_cast<double>(given.delay_ticks) * 1e-12;
  const std::uint8_t* codes = given.spaced_60 ? codes_60 : codes_120;
  const std::vector<Edge> edges = edges_of(given.placement, sign, 0.05);
  ASSERT_GT(edges.size(), 40u);
  std::uint8_t before = rig.pins();
  for (const Edge& edge : edges) {
    const double t = edge.at_s + delay_s;
    ASSERT_EQ(run_to(rig, t - 2e-12), sim::Stop::end);
    ASSERT_EQ(rig.pins(), before) << "before " << t;
    ASSERT_EQ(run_to(rig, t + 2e-12), sim::Stop::end);
    ASSERT_EQ(rig.pins(), codes[edge.sector]) << "after " << t;
    before = rig.pins();
  }
}

TEST(Probes, SwitchWhereTheirEquationSays) {
  const std::vector<double> six = {0, 3, -2, 1, -4, 2};
  std::vector<double> all;
  for (int n = 0; n < 48; ++n) all.push_back(8 * std::sin(1.7 * n));
  for (const double sign : {1.0, -1.0})
    for (const double offset : {0.0, 4.0, -25.0, 90.0})
      for (const double hysteresis : {0.0, 2.0, 10.0})
        for (const auto& own : {std::vector<double>{}, six, all})
          expect_edges({.placement = {offset, hysteresis, own}}, sign);
}

TEST(Probes, AreLateByTheirDelay) {
  for (const double sign : {1.0, -1.0})
    expect_edges({.placement = {2.0, 1.0, {}}, .delay_ticks = 37'000'000}, sign);
}

// At 5600 electrical rad/s, a sector lasts 187 us. During a delay of 200 us, two edges are therefore pending
// at once.
TEST(Probes, KeepEdgesThatAreOnTheirWay) {
  rig::MountedProbes<double> probes({.delay_ticks = 200}, {});
  ASSERT_TRUE(probes.mounted());
  for (int n = 0; n < 5; ++n) probes.pass(plant::ProbeEdge::ahead, {100 + 10 * n, 0.25});
  EXPECT_EQ(probes.sector(0), 0);
  for (int n = 0; n < 5; ++n) {
    EXPECT_EQ(probes.next(), (sim::Instant{300 + 10 * n, 0.25}));
    EXPECT_FALSE(probes.show({300 + 10 * n, 0.0}));
    EXPECT_TRUE(probes.show({300 + 10 * n, 0.25}));
    EXPECT_EQ(probes.sector(0), n + 1);
  }
  EXPECT_EQ(probes.next(), sim::Instant::never());
}

TEST(Probes, SixtyDegreesApartShowTheirOwnCodes) {
  expect_edges({.placement = {3.0, 0.0, {}}, .spaced_60 = true}, 1.0);
  // Probes without mounting errors change at the sector edges. The chip decodes probes 60 degrees apart with
  // a separate table.
  const rig::MountedProbes<double> probes({.spaced_60 = true}, {});
  EXPECT_FALSE(probes.mounted());
  for (int sector = 0; sector < 6; ++sector) {
    EXPECT_EQ(probes.code(sector), codes_60[sector]);
    EXPECT_EQ(control::sector_of_hall(
                  control::as_120_degrees(control::HallArrangement::degrees_60, probes.code(sector))),
              sector);
  }
}

TEST(Probes, GlitchesTurnOneLineOver) {
  rig::Timeline timeline;
  for (const double t : {1e-3, 2e-3})
    timeline.push_back({sim::to_instant(t), rig::ActionKind::hall_glitch, 2.0});
  GeneralRig rig = turned({.placement = {1.0, 0.0, {}}}, 1.0, timeline);
  const auto code_at = [&](double t) {
    return codes_120[static_cast<int>(std::floor((t * deg_s - 1) / 60 + 6)) % 6];
  };
  for (const double t : {0.5e-3, 0.999e-3, 1.001e-3, 1.5e-3, 1.999e-3, 2.001e-3, 3e-3}) {
    ASSERT_EQ(run_to(rig, t), sim::Stop::end);
    const bool within = t > 1e-3 && t < 2e-3;
    EXPECT_EQ(rig.pins(), code_at(t) ^ (within ? 0b010 : 0)) << t;
  }
}

// The rotor oscillates across an edge. In either direction, the line changes only once, half the hysteresis
// after the edge.
TEST(Probes, HysteresisHoldsAgainstARotorThatTurnsBack) {
  GeneralSetup setup;
  setup.shaft.dynamometer = true;
  setup.start.speed_rad_s = w;
  setup.probes.placement.hysteresis_deg = 20;
  Board board = Board::duty(0.0);
  board.drive.mode = control::Mode::off;
  // The rotor turns forward by 75 degrees, back by 30, forward by 30, and back by 75.
  double t = 0, sign = 1;
  for (const double way : {75.0, 30.0, 30.0, 75.0}) {
    t += way / deg_s;
    sign = -sign;
    board.timeline.push_back({sim::to_instant(t), rig::ActionKind::shaft_speed, sign * w});
  }
  GeneralRig rig = general_rig(setup, board);
  std::vector<int> sectors;
  for (double at = 0; at < t; at += 1 / deg_s) {
    ASSERT_EQ(run_to(rig, at), sim::Stop::end);
    const int sector = control::sector_of_hall(rig.pins());
    if (sectors.empty() || sectors.back() != sector) sectors.push_back(sector);
  }
  // The line changes four times: at 70 degrees on the way from 0 to 75, at 50 on the way back to 45, at 70 on
  // the way to 75, and at 50 on the way back to 0. The rotor does not reach the edge at -10 degrees.
  EXPECT_EQ(sectors, (std::vector<int>{0, 1, 0, 1, 0}));
}

}  // namespace SIXSTEP_TEST_FILE

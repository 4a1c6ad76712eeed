// SPDX-License-Identifier: Apache-2.0
// Every wiring of three probes is identified. A log that cannot be used is refused with the reason.
#include "sixstep/analysis/identification/hall/identify.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sixstep/analysis/identification/hall/hall_edges.hpp"
#include "sixstep/analysis/identification/hall/rotor_path.hpp"
#include "sixstep/control/commutation.hpp"
#include "tests/analysis/identification/drilled.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::HallLog;
using analysis::HallWires;
using analysis::PinCodes;
using ::testing::HasSubstr;
using Code = std::uint8_t;

HallTruth with_voltages(HallTruth t) {
  t.voltages = analysis::RecordedVoltages::lines;
  t.noise_V = 0.005;
  return t;
}

constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

TEST(HallWires, EveryOrderOfCodesHasOneWayOfProbes120DegreesApart) {
  std::set<PinCodes> all;
  for (int order = 0; order < 6; ++order)
    for (Code inverted = 0; inverted < 8; ++inverted) {
      const HallWires wires{false, static_cast<rig::WireOrder>(order), inverted};
      const PinCodes codes = analysis::codes_behind(wires);
      all.insert(codes);
      const std::vector<HallWires> found = analysis::wires_behind(codes);
      EXPECT_EQ(std::count(found.begin(), found.end(), wires), 1);
      EXPECT_EQ(std::count_if(found.begin(), found.end(), [](const HallWires& w) { return !w.spaced_60; }),
                1);
      for (const HallWires& w : found) EXPECT_EQ(analysis::codes_behind(w), codes);
    }
  EXPECT_EQ(all.size(), 48u);
  EXPECT_TRUE(analysis::wires_behind({1, 1, 1, 1, 1, 1}).empty());
}

/// Probes 120 degrees apart never give the codes 000 and 111, if no line or every line is inverted. If these
/// codes never occur, the first wiring in the list has such probes.
TEST(HallWires, TheCodesThatNeverOccurAndTheSpacingAgree) {
  for (const bool spaced_60 : {false, true})
    for (int order = 0; order < 6; ++order)
      for (Code inverted = 0; inverted < 8; ++inverted) {
        const PinCodes codes =
            analysis::codes_behind({spaced_60, static_cast<rig::WireOrder>(order), inverted});
        const HallWires plainest = analysis::wires_behind(codes).front();
        const bool all_alike =
            std::any_of(codes.begin(), codes.end(), [](Code c) { return c == 0 || c == 7; });
        if (!all_alike) {
          EXPECT_FALSE(plainest.spaced_60);
          EXPECT_TRUE(plainest.inverted == 0 || plainest.inverted == 7) << int{plainest.inverted};
        } else if (spaced_60 && inverted == 0) {
          EXPECT_TRUE(plainest.spaced_60);
        }
      }
}

TEST(HallWires, TheGeneratorsProbesAreTheDrives) {
  for (const bool spaced_60 : {false, true}) {
    HallTruth t;
    t.spaced_60 = spaced_60;
    for (int sector = 0; sector < 6; ++sector)
      EXPECT_EQ(pin_code(t, sector), analysis::codes_behind({spaced_60, rig::WireOrder::abc,
                                                             0})[static_cast<std::size_t>(sector)]);
  }
}

/// The table of sectors is equal to the table in docs/reference/notation.md.
TEST(HallWires, StraightWiresGiveTheDrivesOwnTable) {
  const auto table = analysis::commutation_of(analysis::codes_behind({}));
  ASSERT_EQ(table.size(), 6u);
  for (const analysis::CodePair& row : table) {
    EXPECT_EQ(row.sector, control::sector_of_hall(row.code));
    EXPECT_EQ(row.pair, control::positive_pair(row.sector));
  }
  EXPECT_EQ(table[0].code, 1);
  EXPECT_EQ(table[0].pair, (control::Pair{control::Leg::c, control::Leg::a}));
}

/// The cases are 6 orders, 8 inversions, 2 spacings and both directions, with line voltages and terminal
/// voltages in turn. identify() finds the code of every sector, and its list of wirings contains the true
/// wiring.
TEST(Identify, EveryWiringIsFoundWithVoltages) {
  int n = 0;
  for (const bool spaced_60 : {false, true})
    for (int order = 0; order < 6; ++order)
      for (int inverted = 0; inverted < 8; ++inverted, ++n) {
        HallTruth t = with_voltages(drilled());
        t.seed = static_cast<std::uint64_t>(n);
        t.spaced_60 = spaced_60;
        t.inverted = inverted;
        t.backward = n % 3 == 0;
        t.offset_deg = n % 40 - 20.0;
        if (n % 2 == 1) t.voltages = analysis::RecordedVoltages::terminals;
        for (std::size_t k = 0; k < 3; ++k) t.probe_at_pin[k] = orders[order][k];
        const auto found = analysis::identify(drawn_log(t).log);
        ASSERT_TRUE(found) << to_string(found.problems()[0]);
        const auto& place = *found->place;
        const HallWires drawn{spaced_60, static_cast<rig::WireOrder>(order), static_cast<Code>(inverted)};
        EXPECT_EQ(std::count(place.wires.begin(), place.wires.end(), drawn), 1) << "case " << n;
        EXPECT_EQ(place.forward, !t.backward) << "case " << n;
        std::size_t edges = found->left_out + place.at_turns;
        for (const analysis::IdentifiedEdge& e : found->edges) edges += e.seen;
        EXPECT_EQ(edges, found->forward + found->backward) << "case " << n;
        EXPECT_NEAR(place.offset_deg.value, t.offset_deg, 0.75)
            << "case " << n;  // half the angle between two rows
        EXPECT_GT(place.probability, 0.9999) << "case " << n;
        EXPECT_EQ(place.wires.front(), analysis::wires_behind(place.codes).front());
      }
}

/// Each turn has a whole number of rows, so every edge is at the same position between two rows in each turn.
/// More turns therefore do not narrow the interval.
TEST(Identify, RowsInStepWithTheRotorLeaveTheirDoubt) {
  int held = 0, all = 0;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Draw draw(seed);
    HallLog log;  // 240 rows a turn, 1.5 degrees apart
    std::array<double, 6> own{};
    for (double& deg : own) deg = draw.between(-3.0, 3.0);
    double mean = 0.0;
    for (const double deg : own) mean += deg / 6.0;
    for (int row = 0; row < 240 * 40; ++row) {
      const double deg = 1.5 * row;
      int sector = static_cast<int>(deg / 60.0);
      while (deg >= 60.0 * (sector + 1) + own[static_cast<std::size_t>((sector + 1) % 6)]) ++sector;
      while (deg < 60.0 * sector + own[static_cast<std::size_t>(sector % 6)]) --sector;
      log.t_s.push_back(1e-3 * row);
      log.codes.push_back(static_cast<Code>(probe_code(sector, false)));
    }
    const auto found = analysis::identify(log);
    ASSERT_TRUE(found) << to_string(found.problems()[0]);
    for (std::size_t n = 0; n < 6; ++n, ++all) {
      held += found->edges[n].own_deg.holds(own[n] - mean);
      sum += found->edges[n].own_deg.half_width();
    }
  }
  EXPECT_GE(held, 0.9 * all);
  EXPECT_GT(sum / all, 0.3);
  EXPECT_LT(sum / all, 0.9);
}

/// A log without voltages shows which two codes never occur, but no rotor angle.
TEST(Identify, CodesAloneTellWhichOnesNeverOccur) {
  for (int inverted = 0; inverted < 8; ++inverted) {
    HallTruth t = drilled();
    t.inverted = inverted;
    const auto found = analysis::identify(drawn_log(t).log);
    ASSERT_TRUE(found) << to_string(found.problems()[0]);
    EXPECT_FALSE(found->place);
    EXPECT_EQ(found->mask, inverted == 0 || inverted == 7   ? 0
                           : inverted <= 2 || inverted == 4 ? inverted
                                                            : 7 - inverted);
    EXPECT_GT(found->mask_probability, 0.9999);
    EXPECT_EQ(found->jitter_deg.low, 0.0);
  }
}

/// The poles of an irregular magnet differ. Only edges over a whole mechanical turn show the difference.
TEST(Identify, EdgesOfEachPolePairOfTheShaft) {
  HallTruth t = with_voltages(drilled());
  t.turns = 42.0;
  t.pole_pairs = 7;
  t.scattered_deg = {0.0, 0.0, 3.0, 0.0, 0.0, -3.0, 0.0};
  const DrawnLog drawn = drawn_log(t);
  const auto found = analysis::identify(drawn.log, 7), by_six = analysis::identify(drawn.log);
  ASSERT_TRUE(found) << to_string(found.problems()[0]);
  ASSERT_EQ(found->edges.size(), 42u);
  double sum = 0.0;
  std::size_t high = 0, low = 0;
  for (const analysis::IdentifiedEdge& e : found->edges) {
    sum += e.own_deg.value;
    high += std::fabs(e.own_deg.value - 3.0) < 0.5;
    low += std::fabs(e.own_deg.value + 3.0) < 0.5;
    EXPECT_GE(e.seen, 5u);
  }
  EXPECT_NEAR(sum, 0.0, 1e-6);
  EXPECT_EQ(high, 6u);
  EXPECT_EQ(low, 6u);
  ASSERT_TRUE(by_six);
  EXPECT_GT(by_six->jitter_deg.value, 10 * found->jitter_deg.value);
  const auto rare = analysis::identify(drawn_log(with_voltages(drilled())).log, 7);
  ASSERT_FALSE(rare);
  EXPECT_THAT(to_string(rare.problems()[0]), HasSubstr("pole_pairs = 7 has 42 edges in a turn of the shaft"));
  const auto blind = analysis::identify(drawn_log(drilled()).log, 7);
  ASSERT_FALSE(blind);
  EXPECT_THAT(to_string(blind.problems()[0]), HasSubstr("pole_pairs = 7 needs voltages"));
}

/// A logic analyzer may export only the rows in which a line changes.
TEST(Identify, RowsThatAreChanges) {
  HallTruth t = drilled();
  t.own_deg = {2, -1, 0, 1, -2, 0};
  t.row_s /= 100.0;
  const HallLog dense = drawn_log(t).log;
  HallLog changes;
  for (std::size_t n = 0; n < dense.t_s.size(); ++n)
    if (n == 0 || dense.codes[n] != dense.codes[n - 1]) {
      changes.t_s.push_back(dense.t_s[n]);
      changes.codes.push_back(dense.codes[n]);
    }
  const auto found = analysis::identify(changes), from_all = analysis::identify(dense);
  ASSERT_TRUE(found && from_all);
  EXPECT_TRUE(found->rows_are_changes);
  EXPECT_FALSE(from_all->rows_are_changes);
  for (std::size_t n = 0; n < 6; ++n)
    EXPECT_NEAR(found->edges[n].own_deg.value, from_all->edges[n].own_deg.value, 0.02);
}

/// Spikes on a line, a bouncing edge and a lost contact do not change the identified motion.
TEST(Identify, GlitchesDoNotMoveTheWay) {
  const HallLog clean = drawn_log(drilled()).log;
  const auto edges = analysis::hall_edges(clean);
  ASSERT_TRUE(edges);
  HallLog spiky = clean;
  Draw draw(5);
  for (Code& code : spiky.codes)
    if (draw.chance(0.02)) code ^= static_cast<Code>(1 << draw.one_of(3));
  const auto found = analysis::hall_edges(spiky);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edges.size(), edges->edges.size());
  EXPECT_GT(found->glitches, 10u);
  EXPECT_EQ(found->mask, 0);
  for (std::size_t n = 0; n < edges->edges.size(); ++n)
    EXPECT_EQ(found->edges[n].boundary, edges->edges[n].boundary);
  HallLog off = clean;
  for (std::size_t n = 400; n < 700; ++n) off.codes[n] = 0;
  const auto parted = analysis::hall_edges(off);
  ASSERT_TRUE(parted) << to_string(parted.problems()[0]);
  EXPECT_EQ(std::count_if(parted->edges.begin(), parted->edges.end(), [](const auto& e) { return e.begins; }),
            2);
}

std::string told(const HallLog& log) {
  const auto found = analysis::identify(log);
  return found ? std::string("identified") : to_string(found.problems()[0]);
}

TEST(Identify, WhatIsNoLogIsToldWhy) {
  const HallLog good = drawn_log(drilled()).log;
  EXPECT_EQ(told(good), "identified");
  const auto changed = [&](auto change) {
    HallLog log = good;
    change(log);
    return told(log);
  };
  EXPECT_THAT(changed([](HallLog& l) { std::fill(l.codes.begin(), l.codes.end(), Code{5}); }),
              HasSubstr("never change: the rotor was at rest"));
  EXPECT_THAT(changed([](HallLog& l) {
                for (Code& c : l.codes) c |= 2;
              }),
              HasSubstr("hall2 = 1 in every row, while another line changes"));
  EXPECT_THAT(changed([](HallLog& l) {
                for (Code& c : l.codes) c &= 6;
              }),
              HasSubstr("hall3 = 0 in every row"));
  EXPECT_THAT(changed([](HallLog& l) {
                for (Code& c : l.codes) c = static_cast<Code>((c & 5) | (c >> 1 & 2));
              }),
              HasSubstr("hall1 and hall2 change together"));
  EXPECT_THAT(changed([](HallLog& l) { l.t_s.resize(200), l.codes.resize(200); }),
              HasSubstr("18 are needed, each of the six codes at least twice"));
  EXPECT_THAT(changed([](HallLog& l) { l.t_s.resize(1), l.codes.resize(1); }),
              HasSubstr("time = 1 rows are too few"));
  EXPECT_THAT(changed([](HallLog& l) { l.t_s[50] = l.t_s[49]; }), HasSubstr("in row 51 does not rise"));
  EXPECT_THAT(changed([](HallLog& l) { l.t_s[3] = NAN; }), HasSubstr("in row 4 does not rise"));
  EXPECT_THAT(changed([](HallLog& l) { l.codes[9] = 8; }),
              HasSubstr("hall = 8 in row 10 must be a code of three bits"));
  EXPECT_THAT(changed([](HallLog& l) { l.codes.pop_back(); }), HasSubstr("one value for each of"));
  EXPECT_THAT(changed([](HallLog& l) {
                HallLog thin;
                for (std::size_t n = 0; n < l.t_s.size(); n += 70)
                  thin.t_s.push_back(l.t_s[n]), thin.codes.push_back(l.codes[n]);
                l = thin;
              }),
              HasSubstr("sample faster"));
  HallLog volts = drawn_log(with_voltages(drilled())).log;
  EXPECT_EQ(told(volts), "identified");
  HallLog broken = volts;
  broken.u_V[1].pop_back();
  EXPECT_THAT(told(broken), HasSubstr("u_bc = "));
  broken = volts;
  broken.u_V[2][5] = INFINITY;
  EXPECT_THAT(told(broken), HasSubstr("u_ca = inf in row 6 is not a number"));
  broken = volts;
  Draw draw(1);
  for (auto& column : broken.u_V)
    for (double& u : column) u = normal(draw);
  EXPECT_THAT(told(broken), HasSubstr("u_ab, u_bc, u_ca do not follow the Hall lines"));
}

}  // namespace SIXSTEP_TEST_FILE

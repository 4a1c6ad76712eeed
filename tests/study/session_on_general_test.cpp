// SPDX-License-Identifier: Apache-2.0
// A session runs on the general kernel. For each reason to use this kernel, the session has the bits of the
// uninterrupted run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/hall.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/compile/general_plant.hpp"
#include "tests/support/general_scenarios.hpp"
#include "tests/support/product_scenarios.hpp"
#include "tests/support/sessions.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

std::vector<Scenario> drives() {
  Scenario open_loop = maxon_scenario(Mode::duty, 0.5);
  open_loop.duration_s = 12e-3;
  Scenario flashed = product_scenario(Mode::speed, 100.0);
  Scenario fixed = cascade(12e-3);
  fixed.control.arithmetic = Arithmetic::q31;
  flashed.duration_s = 12e-3;
  return {open_loop, cascade(12e-3), flashed, fixed};
}

TEST(SessionOnGeneral, SlicesHaveTheBitsOfTheUncutRun) {
  for (const AsksForGeneral& ask : asks_for_general)
    for (Scenario s : drives()) {
      SCOPED_TRACE(ask.what);
      ask.make(s);
      ASSERT_TRUE(needs_general_plant(s));
      std::vector<double> rows[2];
      std::vector<double>* into = rows;
      const Listeners listeners{
          .on_record = [&](Row row) { into->insert(into->end(), row.begin(), row.end()); }};
      const Outcome whole = outcome(s, listeners);
      into = rows + 1;
      const Outcome parts = sliced(s, listeners);
      EXPECT_EQ(parts.digest, whole.digest);
      EXPECT_EQ(parts.segments, whole.segments);
      ASSERT_TRUE(parts.energy && whole.energy);
      EXPECT_EQ(parts.energy->supplied, whole.energy->supplied);
      EXPECT_EQ(parts.energy->electrical_residual, whole.energy->electrical_residual);
      ASSERT_EQ(rows[0].size(), rows[1].size());
      for (std::size_t n = 0; n < rows[0].size(); ++n)  // NaN where a column does not apply
        ASSERT_TRUE(rows[0][n] == rows[1][n] || (rows[0][n] != rows[0][n] && rows[1][n] != rows[1][n])) << n;
    }
}

struct LineChange {
  double t_s = 0.0;
  std::uint8_t lines = 0;  ///< lines that change
};

/// Changes of the Hall lines of a rotor that turns at constant speed. They are the edges of the sectors, late
/// by the delay, and both ends of each glitch of the timeline.
std::vector<LineChange> line_changes(const Scenario& s, double first_angle_rad) {
  std::vector<LineChange> out;
  const double electrical_rad_s = 8 * s.load.dynamometer_rad_s[0],
               at = 8 * first_angle_rad / base::sector_rad;
  for (int edge = static_cast<int>(std::floor(at)) + 1;; ++edge) {
    const double t_s = (edge - at) * base::sector_rad / electrical_rad_s + s.sensors.hall_delay_s;
    if (t_s > s.duration_s) break;
    out.push_back(
        {t_s, static_cast<std::uint8_t>(plant::hall_code(edge % 6) ^ plant::hall_code((edge + 5) % 6))});
  }
  for (const rig::Action& action : compile(s)->timeline)
    if (action.kind == rig::ActionKind::hall_glitch)
      out.push_back({action.at.seconds(), static_cast<std::uint8_t>(8 >> static_cast<int>(action.value))});
  std::sort(out.begin(), out.end(), [](const LineChange& a, const LineChange& b) { return a.t_s < b.t_s; });
  return out;
}

TEST(SessionOnGeneral, FindsEachChangeOfDelayedAndDisturbedHallLines) {
  for (const Mode mode : {Mode::duty, Mode::current}) {
    Scenario s = product_scenario(mode, 0.2);  // a trip does not end its run
    s.sensors.hall_stable_samples = 2;
    s.duration_s = 8e-3;
    s.load.dynamometer_times_s = {0.0};
    s.load.dynamometer_rad_s = {210.0};
    s.sensors.hall_delay_s = 37e-6;  // more than a PWM period
    s.sensors.hall_glitches_Hz = 5e3;
    s.sensors.hall_glitch_s = 0.7e-6;  // far shorter than a period
    Session session = opened(s);
    const auto hall = static_cast<std::size_t>(ColumnId::hall),
               angle = static_cast<std::size_t>(ColumnId::angle);
    auto code = static_cast<std::uint8_t>(session.present().signals[hall]);
    const std::vector<LineChange> expected = line_changes(s, session.present().signals[angle]);
    ASSERT_GT(expected.size(), 70U);
    for (const LineChange& change : expected) {
      ASSERT_TRUE(session.advance_to_hall_edge(1.0));
      EXPECT_NEAR(session.present().t_s, change.t_s, 2e-12);
      code ^= change.lines;
      EXPECT_EQ(session.present().signals[hall], code) << change.t_s;
    }
    EXPECT_FALSE(session.advance_to_hall_edge(1.0));  // none is left until the end
    EXPECT_EQ(closed(session).digest, outcome(s).digest);
  }
}

TEST(SessionOnGeneral, ShowsTheLoadsSideAtTheInstantAskedFor) {
  Scenario s = cascade();
  s.load.gear = 2;
  s.load.stiffness_Nm_rad = 2;
  s.load.inertia_kg_m2 = 1e-5;
  s.record.grid_s = 7.301e-6;  // never on a PWM edge
  std::vector<std::vector<double>> rows;
  outcome(s, {.on_record = [&](Row row) { rows.emplace_back(row.begin(), row.end()); }});
  const auto indices = record_indices(s);
  ASSERT_TRUE(indices);
  Session session = opened(s);
  for (std::size_t n = 1; n + 1 < rows.size(); ++n) {
    session.advance(static_cast<double>(n) * s.record.grid_s.value());
    for (std::size_t c = 0; c < indices->size(); ++c)
      if (rows[n][c] == rows[n][c]) {
        const double scale = 1e-12 * (1 + std::fabs(rows[n][c]));
        ASSERT_NEAR(session.present().signals[(*indices)[c]], rows[n][c], scale) << n << " " << c;
      }
  }
}

At broken_wire() {
  At at;
  at.motor.broken_wire = Wire::b;
  return at;
}

TEST(SessionOnGeneral, WhatItWasToldReplaysFromItsScenario) {
  for (Scenario s : drives()) {
    s.load.fan_Nm_s2 = 1e-7;
    Session session = opened(s);
    session.advance(3.21e-3);
    At crossed;
    crossed.bridge.phases = AtOrder::bac;
    crossed.sensors.hall_lines = AtOrder::acb;
    ASSERT_TRUE(session.change(crossed));
    session.advance(6.5e-3);
    const Session saved = session;
    ASSERT_TRUE(session.change(broken_wire()));
    const Outcome lived = run_out(session);
    EXPECT_EQ(outcome(session.scenario()).digest, lived.digest);
    Session again = saved;
    const Outcome whole = run_out(again);
    EXPECT_NE(whole.digest, lived.digest) << "the copy was told of no broken wire";
    EXPECT_EQ(outcome(again.scenario()).digest, whole.digest);
  }
}

TEST(SessionOnGeneral, WhatOnlyThatKernelHasIsRefusedOnTheOtherWithTheWayToGetIt) {
  Scenario s = cascade();
  Session lean = opened(s);
  lean.advance(2e-3);
  const auto refused = lean.change(broken_wire());
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.problems()[0]), ::testing::HasSubstr("bridge.phases = \"abc\""));
  EXPECT_EQ(run_out(lean).digest, outcome(s).digest) << "nothing has changed";

  At straight;
  straight.bridge.phases = AtOrder::abc;
  s.at.push_back(straight);
  Session general = opened(s);
  general.advance(2e-3);
  ASSERT_TRUE(general.change(broken_wire()));
  const Outcome lived = run_out(general);
  EXPECT_EQ(outcome(general.scenario()).digest, lived.digest);
}

TEST(SessionOnGeneral, ClosedBeforeWhatAskedForTheKernelItStaysThere) {
  Scenario s = cascade();
  At at = broken_wire();
  at.time_s = 7e-3;
  s.at.push_back(at);
  Session session = opened(s);
  session.advance(4e-3);
  const Outcome lived = closed(session);
  EXPECT_LT(session.scenario().duration_s, 5e-3);
  EXPECT_TRUE(needs_general_plant(session.scenario()));
  EXPECT_EQ(outcome(session.scenario()).digest, lived.digest);
}

}  // namespace SIXSTEP_TEST_FILE

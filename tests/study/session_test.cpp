// SPDX-License-Identifier: Apache-2.0
// Slices, readings and copies of a session do not change a bit. A scenario with the session's changes repeats
// the session's run.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/scenario/choices.hpp"
#include "tests/support/product_scenarios.hpp"
#include "tests/support/sessions.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

Scenario late_and_sampled_in_the_middle() {
  Scenario s = cascade();
  s.pwm.sample = SampleAt::middle;
  s.pwm.alignment = Alignment::centre;
  s.pwm.commutation = CommutationAt::sample;
  s.bridge.dead_time_s = 1e-6;
  s.supply.resistance_ohm = 0.1;
  s.supply.capacitance_F = 1e-3;
  return s;
}

Scenario flashed() {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.sensors.current_noise_A = 0.01;
  s.protection.brake_current_A = 4.0;
  return s;
}

Scenario full_duty() {
  Scenario s = maxon_scenario(Mode::duty, 1.0);
  s.duration_s = 8e-3;
  return s;
}

std::vector<Scenario> each() {
  return {hysteresis(), cascade(), late_and_sampled_in_the_middle(), flashed(), full_duty()};
}

double told(Session& session, const At& at) {
  const auto when = session.change(at);
  if (!when) ADD_FAILURE() << to_string(when.problems()[0]);
  return when ? *when : -1.0;
}

At gains(double settle_s) {
  At at;
  at.control.current.settle_s = settle_s;
  return at;
}

/// Returns whether a session opens. If the arithmetic cannot represent the drive, both a run and a session
/// must refuse the scenario.
bool can_run(const Scenario& s) {
  const auto session = Session::open(s);
  EXPECT_EQ(bool(session), bool(run(s)));
  return bool(session);
}

TEST(Session, SlicesHaveTheBitsOfTheUncutRunInEveryFirmwareAndArithmetic) {
  int examined = 0;
  for (Scenario s : each())
    for (const auto& arithmetic : arithmetic_choices) {
      s.control.arithmetic = arithmetic.value;
      if (!can_run(s)) continue;
      ++examined;
      ask(s, measure(MetricKind::rms, Signal::current));
      ask(s, measure(MetricKind::maximum, Signal::speed));
      const Outcome whole = outcome(s), parts = sliced(s);
      SCOPED_TRACE(std::string(base::word(mode_choices, s.control.mode)) + " " +
                   std::string(arithmetic.word));
      EXPECT_EQ(parts.digest, whole.digest);
      EXPECT_EQ(parts.segments, whole.segments);
      EXPECT_EQ(parts.simulated_s, whole.simulated_s);
      for (std::size_t n = 0; n < whole.comparisons.size(); ++n)
        EXPECT_EQ(parts.comparisons[n].measured, whole.comparisons[n].measured);
      for (std::size_t n = 0; n < whole.events.size(); ++n)
        EXPECT_EQ(parts.events[n].count, whole.events[n].count) << whole.events[n].event;
    }
  EXPECT_GE(examined, 24);
}

TEST(Session, SkippingChangesNothingAndReadingGoesOnAfterIt) {
  for (const Scenario& s : each()) {
    auto read = Session::open(s), skipped = Session::open(s);
    ASSERT_TRUE(read && skipped);
    for (int k = 1; k <= 20; ++k) {
      const double t_s = s.duration_s * k / 23.0;
      read->advance(t_s);
      skipped->skip(t_s);
      EXPECT_EQ(skipped->now_s(), read->now_s());
    }
    EXPECT_EQ(skipped->present().t_s, 0.0);
    const double later_s = s.duration_s * 21.5 / 23.0;
    read->advance(later_s);
    skipped->advance(later_s);
    EXPECT_EQ(skipped->present().t_s, read->present().t_s);
    for (std::size_t c = 0; c < column_count; ++c)
      EXPECT_TRUE(std::isnan(read->present().signals[c]) ||
                  skipped->present().signals[c] == read->present().signals[c])
          << c;
    skipped->skip(s.duration_s);
    read->advance(s.duration_s);
    EXPECT_EQ(skipped->close()->digest, read->close()->digest);
  }
}

TEST(Session, ListenersHearTheSame) {
  for (const Scenario& s : each()) {
    std::vector<double> whole, parts;
    std::vector<double>* into = &whole;
    const Listeners listeners{
        .on_record = [&](Row row) { into->insert(into->end(), row.begin(), row.end()); },
        .on_event = [&](Row row) { into->insert(into->end(), row.begin(), row.end()); }};
    outcome(s, listeners);
    into = &parts;
    sliced(s, listeners);
    ASSERT_EQ(parts.size(), whole.size());
    for (std::size_t n = 0; n < whole.size(); ++n)  // NaN where a column does not apply
      ASSERT_TRUE(parts[n] == whole[n] || (parts[n] != parts[n] && whole[n] != whole[n])) << n;
  }
}

/// At instants between any two events, the session's values are equal to the grid record of the uninterrupted
/// run.
TEST(Session, ShowsTheInstantAskedForWithoutCuttingASegment) {
  Scenario s = cascade();
  s.record.grid_s = 7.301e-6;  // never on a PWM edge
  std::vector<std::vector<double>> rows;
  outcome(s, {.on_record = [&](Row row) { rows.emplace_back(row.begin(), row.end()); }});
  Session session = opened(s);
  const auto columns = record_indices(s);
  ASSERT_TRUE(columns);
  for (const std::vector<double>& row : rows) {
    session.advance(row[0]);
    if (row[0] == 0.0) continue;
    ASSERT_NEAR(session.present().t_s, row[0], 1e-12);
    for (std::size_t n = 1; n < row.size(); ++n) {
      const std::size_t c = (*columns)[n];
      ASSERT_EQ(session.present().signals[c], row[n]) << all_columns()[c].name << " at " << row[0];
    }
  }
}

TEST(Session, ShowsTheStartBeforeAnythingIsDone) {
  Scenario s = cascade();
  s.initial.speed_rad_s = 50.0;
  const Session session = opened(s);
  EXPECT_EQ(session.present().t_s, 0.0);
  EXPECT_EQ(session.present().signals[static_cast<std::size_t>(ColumnId::speed)], 50.0);
  EXPECT_EQ(session.present().signals[static_cast<std::size_t>(ColumnId::bus_V)], 24.0);
  EXPECT_FALSE(session.over());
}

TEST(Session, ACopyIsASavedState) {
  for (const Scenario& s : each()) {
    Session session = opened(s);
    session.advance(3.1e-3);
    Session saved = session, changed = session;
    At load;
    load.load.torque_Nm = 0.05;
    told(changed, load);
    session.advance(5e-3);
    const std::uint64_t of_saved = closed(saved).digest;
    EXPECT_EQ(of_saved, outcome(saved.scenario()).digest);
    const auto rest = [](Session& one) {
      one.advance(1.0);
      return closed(one).digest;
    };
    EXPECT_EQ(rest(session), outcome(s).digest);
    EXPECT_NE(rest(changed), outcome(s).digest);
    EXPECT_EQ(rest(changed), outcome(changed.scenario()).digest);
  }
}

/// In open loop at full duty, the rig skips ticks, so its polynomials extend far ahead. A change during such
/// a segment must still act.
TEST(Session, AChangeAtSteadyDutyIsSeen) {
  for (const double after_s : {0.0, 1e-3, 3.33e-3}) {
    Session session = opened(full_duty());
    session.advance(after_s);
    At at;
    at.reference = Reference{.value = 0.2};
    const double when = told(session, at);
    EXPECT_GE(when, after_s);
    EXPECT_LT(when, after_s + 1e-3);
    session.advance(when + 1e-4);
    EXPECT_EQ(session.present().signals[static_cast<std::size_t>(ColumnId::duty)], 0.2);
    session.advance(1.0);
    EXPECT_EQ(closed(session).digest, outcome(session.scenario()).digest);
  }
}

TEST(Session, WhatItWasToldReplaysInEveryFirmwareAndArithmetic) {
  for (Scenario s : each())
    for (const auto& arithmetic : arithmetic_choices) {
      s.control.arithmetic = arithmetic.value;
      if (!can_run(s)) continue;
      SCOPED_TRACE(std::string(base::word(mode_choices, s.control.mode)) + " " +
                   std::string(arithmetic.word));
      Session session = opened(s);
      At at;
      at.load.torque_Nm = 0.02;
      at.supply.voltage_V = 23.0;
      session.advance(1.234e-3);
      told(session, at);
      session.advance(2.5e-3);
      At dead;
      dead.bridge.dead_time_s = 2e-6;
      dead.pwm.chopping = AtChopping::complementary;
      told(session, dead);
      session.advance(3.456e-3);
      (void)session.change(gains(1.5e-3));  // refused, because a hysteresis controller has no gains
      session.advance(4e-3);
      session.advance(s.duration_s);
      EXPECT_TRUE(session.over());
      const Outcome out = closed(session), again = outcome(session.scenario());
      EXPECT_EQ(again.digest, out.digest);
      EXPECT_EQ(again.segments, out.segments);
      EXPECT_NE(out.digest, outcome(s).digest);
    }
}

TEST(Session, EndsEarlyAsAScenarioOfItsOwn) {
  for (Scenario s : each()) {
    s.load.times_s = {0.0, 6e-3};
    s.load.torques_Nm = {0.0, 0.01};
    Requirement late;
    late.measure = measure(MetricKind::mean, Signal::speed);
    late.measure.from_s = 5e-3;
    late.max = 1e9;
    Requirement early = late;
    early.measure.from_s = 1e-3;
    s.require = {late, early};
    Session session = opened(s);
    session.advance(3.3e-3);
    At at;
    at.load.torque_Nm = 0.03;
    told(session, at);
    session.advance(4.4e-3);
    const Outcome out = closed(session), again = outcome(session.scenario());
    EXPECT_EQ(out.simulated_s, session.scenario().duration_s);
    EXPECT_LT(out.simulated_s, 5.5e-3);
    EXPECT_EQ(again.digest, out.digest);
    ASSERT_EQ(out.verdicts.size(), 1u);
    EXPECT_EQ(out.verdicts[0].measured, again.verdicts[0].measured);
  }
}

TEST(Session, FiguresOfAChangedReferenceAreThoseOfTheReplay) {
  Scenario s = cascade();
  Requirement r;
  r.measure = measure(MetricKind::settling_time, Signal::speed);
  r.max = 1.0;
  s.require = {r};
  Session session = opened(s);
  session.advance(4e-3);
  At at;
  at.reference = Reference{.value = 90.0};
  told(session, at);
  session.advance(1.0);
  const Outcome out = closed(session), again = outcome(session.scenario());
  EXPECT_EQ(out.digest, again.digest);
  EXPECT_EQ(out.verdicts[0].measured, again.verdicts[0].measured);
}

TEST(Session, WhatIsRefusedChangesNothing) {
  Scenario s = cascade();
  s.control.arithmetic = Arithmetic::q15;
  Session session = opened(s);
  session.advance(3e-3);
  At vast, both, none, faster, mode;
  vast.control.current.kp = 1e9;
  vast.control.current.ki = 1e8;
  both.control.current.d1 = 1.0;
  both.control.current.d0 = -0.9;
  both.control.current.settle_s = 1e-3;
  faster.reference = Reference{.value = 1e5};  // exceeds the scaling
  mode.control.mode = AtMode::current;         // without a reference in A
  const struct {
    const At& at;
    const char* where;
  } refused[] = {{vast, "at[0].control.arithmetic"},
                 {both, "at[0].control.current.d1"},
                 {none, "at[0].time_s"},
                 {faster, "control.arithmetic"},
                 {mode, "at[0].control.mode"}};
  for (const auto& [at, where] : refused) {
    const auto when = session.change(at);
    ASSERT_FALSE(when) << where;
    EXPECT_EQ(when.problems()[0].where, where);
    EXPECT_FALSE(when.problems()[0].cure.empty());
  }
  session.advance(1.0);
  EXPECT_EQ(closed(session).digest, outcome(s).digest);
}

/// Under a limit, the largest reference of the run determines the scaling of the current. A larger reference
/// would change the drive from the start of the run, so it is refused.
TEST(Session, TheLimitsThatWereFeltStay) {
  Scenario s = maxon_scenario(Mode::current, 4.0);
  s.control.limits.speed_rad_s = 300.0;
  s.control.current.settle_s = 1e-3;
  Session session = opened(s);
  session.advance(3e-3);
  At at;
  at.reference = Reference{.value = 6.0};
  EXPECT_FALSE(session.change(at));
  At largest;
  largest.time_s = 19e-3;
  largest.reference = Reference{.value = 6.0};
  s.at = {largest};
  Session wide = opened(s);
  wide.advance(3e-3);
  told(wide, at);
  wide.advance(1.0);
  EXPECT_EQ(closed(wide).digest, outcome(wide.scenario()).digest);
}

TEST(Session, AsksOncePerPeriodWhetherItIsDone) {
  Session session = opened(full_duty());
  const auto speed = static_cast<std::size_t>(ColumnId::speed);
  EXPECT_TRUE(session.advance_until(1.0, [&](const Present& p) { return p.signals[speed] > 100.0; }));
  EXPECT_GT(session.present().signals[speed], 100.0);
  EXPECT_LT(session.present().signals[speed], 110.0);
}

TEST(Session, NothingCanBeToldOnceItIsOver) {
  Session session = opened(cascade());
  EXPECT_FALSE(session.advance(1.0));
  EXPECT_TRUE(session.over());
  EXPECT_FALSE(session.change(gains(2e-3)));
  EXPECT_EQ(closed(session).digest, outcome(cascade()).digest);
}

}  // namespace SIXSTEP_TEST_FILE

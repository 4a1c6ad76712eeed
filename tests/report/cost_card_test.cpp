// SPDX-License-Identifier: Apache-2.0
// Tests the cost card of a run. Its counts are compared with the modulator's counts, and its loss is compared
// with the figure of the same name.
#include "report/cost_card.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "report/figures.hpp"
#include "report/kept_rows.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using namespace sixstep;
using sixstep::testing::ask;
using sixstep::testing::maxon_scenario;
using sixstep::testing::measure;
using ::testing::HasSubstr;
using ::testing::Not;

/// The rotor is locked at a constant duty, so the drive uses one pair all the time.
study::Scenario held_at(double duty, double duration_s) {
  study::Scenario s = maxon_scenario(control::Mode::duty, duty);
  s.duration_s = duration_s;
  s.load.locked = true;
  return s;
}

struct Ran {
  study::Outcome outcome;
  study::Trace trace;
};
Ran ran(const study::Scenario& s) {
  KeptRows kept(s);
  auto outcome = study::run(s, {.on_event = [&](study::Row row) { kept.add(row); }});
  if (!outcome) {
    ADD_FAILURE() << outcome.problems().front().limit;
    return {};
  }
  return {*outcome, kept.trace()};
}

TEST(CostCard, of_a_pair_one_switch_is_turned_on_once_a_period_and_its_partner_once) {
  for (const double periods : {3333.0, 3333.5, 666.0}) {
    const study::Scenario s = held_at(0.2, periods * 30e-6);
    const Ran run = ran(s);
    const auto counts = turn_on_counts(run.trace);
    ASSERT_TRUE(counts);
    EXPECT_EQ((*counts)[0], std::ceil(periods)) << "the first one is at the start";
    EXPECT_EQ((*counts)[0], run.outcome.turn_ons);
    EXPECT_NEAR(switching_frequency_Hz(run.outcome) * s.duration_s, static_cast<double>((*counts)[0]), 1e-6);
    EXPECT_EQ(std::accumulate(counts->begin(), counts->end(), 0LL), run.outcome.turn_ons + 1);
  }
}

TEST(CostCard, of_three_legs_the_upper_switches_are_those_of_the_frequency) {
  study::Scenario s = maxon_scenario(control::Mode::current, 3.0);
  s.control.drive = study::FirmwareKind::field;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.delay_periods = 1;
  s.load.inertia_kg_m2 = 1;
  const Ran run = ran(s);
  const auto counts = turn_on_counts(run.trace);
  ASSERT_TRUE(counts);
  EXPECT_GT(run.outcome.turn_ons, 600);
  EXPECT_EQ((*counts)[0] + (*counts)[2] + (*counts)[4], run.outcome.turn_ons);
}

TEST(CostCard, a_switch_that_stays_on_is_no_chopping) {
  const Ran on = ran(held_at(1.0, 0.01));
  EXPECT_EQ(switching_frequency_Hz(on.outcome), 0.0);
  EXPECT_EQ(switching_words(on.outcome, on.trace), "no chopping; 2 turn-ons of all six");
  study::Scenario off = maxon_scenario(control::Mode::off, 0.0);
  const Ran never_on = ran(off);
  EXPECT_EQ(switching_words(never_on.outcome, never_on.trace), "none: no switch was turned on");
}

TEST(CostCard, of_rows_that_are_the_last_part_says_so) {
  Ran run = ran(held_at(0.2, 0.02));
  run.trace.whole = {{0.015, 1.0}};
  const auto counts = turn_on_counts(run.trace);
  EXPECT_NEAR(static_cast<double>((*counts)[0]), 0.005 / 30e-6, 1.0);
  EXPECT_THAT(switching_words(run.outcome, run.trace), HasSubstr(" of all six in the last 5.000\u00a0ms"));
  for (std::vector<double>& column : run.trace.values)
    if (&column != &run.trace.values.front()) column.assign(column.size(), 0.0);
  EXPECT_THAT(switching_words(run.outcome, run.trace),
              ::testing::MatchesRegex("chopped at <b>33.*on average; no turn-on in the last 5.000\u00a0ms"));
}

TEST(CostCard, switching_stands_besides_with_the_figures_energy) {
  study::Scenario s = held_at(0.2, 0.02);
  EXPECT_THAT(cost_content(ran(s).outcome, {}), Not(HasSubstr("besides")));
  s.bridge.gate_current_A = 0.1;
  s.bridge.gate_source_charge_C = 5e-9;
  s.bridge.gate_drain_charge_C = 15e-9;
  ask(s, measure(study::MetricKind::switching_loss, study::Signal::current));
  const Ran run = ran(s);
  const double joule = run.outcome.comparisons[0].measured * s.duration_s;
  EXPECT_GT(joule, 1e-3);
  EXPECT_THAT(cost_content(run.outcome, run.trace),
              HasSubstr("Switching<br><small>not included</small></th><td class=\"num\">" +
                        computed(joule, "J") + "</td>"));
}

}  // namespace SIXSTEP_TEST_FILE

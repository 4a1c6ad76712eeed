// SPDX-License-Identifier: Apache-2.0
// One page shows several runs, or one run and the log of a board.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "files/scenario_on_disk.hpp"
#include "report/comparison.hpp"
#include "report/comparison_data.hpp"
#include "report/html.hpp"
#include "report/packed_rows.hpp"
#include "report/parameters.hpp"
#include "report/scenario_differences.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "tests/report/synthetic_run.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using sixstep_tests::synthetic_run;
using sixstep_tests::SyntheticRun;
using ::testing::HasSubstr;

/// A run with three rows at events and a grid of two rows. Its current jumps in the middle.
SyntheticRun ramp_run(double height) {
  SyntheticRun run = synthetic_run(0.001);
  run.trace.columns = {{"t_s", "s", "", ""}, {"i_m_A", "A", "", ""}};
  run.trace.values = {{0, 0.25 * height, 1}, {0, height, 0}};
  return run;
}
sixstep::study::Trace grid_of(double first, double second) {
  sixstep::study::Trace trace;
  trace.columns = {{"t_s", "s", "", ""}, {"i_m_A", "A", "", ""}};
  trace.values = {{0, 0.5}, {first, second}};
  return trace;
}

TEST(Comparison, draws_each_run_on_its_own_rows_and_subtracts_on_the_common_grid) {
  const SyntheticRun one = ramp_run(1), two = ramp_run(2);
  const auto grid_one = grid_of(0.125, 0.75), grid_two = grid_of(0.625, 0.5);
  const std::vector<ComparedRun> runs{{"one", one.scenario, &one.outcome, one.trace, grid_one},
                                      {"two", two.scenario, &two.outcome, two.trace, grid_two}};
  const auto data = nlohmann::json::parse(comparison_data(runs));
  ASSERT_EQ(data["charts"].size(), 2u);
  const auto& over = data["charts"][0]["curves"];
  ASSERT_EQ(over.size(), 2u);
  EXPECT_NE(over[0]["axis"], over[1]["axis"]);
  const std::vector<float> rises{0, 2, 0}, between{0.5f, -0.25f};
  EXPECT_EQ(over[1]["data"], base64(std::span<const float>(rises)));
  const auto& less = data["charts"][1];
  EXPECT_EQ(less["id"], "motor-current-difference");
  EXPECT_EQ(less["curves"][0]["label"], "2 − 1");
  EXPECT_EQ(less["curves"][0]["data"], base64(std::span<const float>(between)));
  const std::vector<double> instants{0, 0.5};
  EXPECT_EQ(data["axes"][less["curves"][0]["axis"].get<std::size_t>()],
            base64(std::span<const double>(instants)));
}

TEST(Comparison, the_grid_counts_whole_periods_and_stays_drawable) {
  auto scenario = synthetic_run(0.001).scenario, other = scenario;
  scenario.duration_s = 0.02;
  other.duration_s = 0.02;
  other.pwm.period_s = 50e-6;
  EXPECT_EQ(common_grid_s({&scenario, &other}), 30e-6);
  scenario.duration_s = 0.5;  // 16667 periods of 30 us are more than 15000
  EXPECT_EQ(common_grid_s({&scenario, &other}), 60e-6);
}

TEST(Comparison, names_the_keys_that_differ_and_no_others) {
  auto one = synthetic_run(0.001).scenario, two = one;
  two.title = "another title";
  two.record.grid_s = 1.0;
  EXPECT_TRUE(differences({&one, &two}).empty());
  two.control.current.settle_s = 2e-3;
  two.supply.sinks = false;
  two.sheet.resistance_ohm->value = 1.5;
  const auto found = differences({&one, &two});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].key, "motor_override.resistance_ohm");
  EXPECT_THAT(found[0].values, ::testing::ElementsAre("1.03\u00a0ohm", "1.5\u00a0ohm"));
  EXPECT_EQ(found[1].key, "supply.sinks");
  EXPECT_EQ(found[2].key, "control.current.settle_s");
  EXPECT_THAT(found[2].values, ::testing::ElementsAre("–", "0.002\u00a0s"));
}

TEST(Comparison, names_what_an_event_changes) {
  auto one = synthetic_run(0.001).scenario, two = one;
  two.extends = {"one.toml"};
  two.at.resize(1);
  two.at[0].time_s = 5e-4;
  two.at[0].supply.voltage_V = 12.0;
  const auto found = differences({&one, &two});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].key, "at[0].time_s");
  EXPECT_EQ(found[1].key, "at[0].supply.voltage_V");
  EXPECT_THAT(found[1].values, ::testing::ElementsAre("–", "12 V"));
}

TEST(Comparison, a_boards_log_has_its_columns_and_no_verdict) {
  const SyntheticRun one = synthetic_run(0.002);
  sixstep::analysis::TraceComparison current;
  current.column = {"i_m_A", "A", "", ""};
  current.rows = 12;
  current.rms = 0.125;
  const std::string html =
      render_comparison({.runs = {{"one", one.scenario, &one.outcome, one.trace, one.trace},
                                  {"b<i>.csv", one.scenario, nullptr, one.trace, one.trace}},
                         .laid_over = {current},
                         .shift_s = 3e-5,
                         .command = "sixstep run one.toml --compare b.csv --html x.html",
                         .version = "0.1.0"});
  EXPECT_THAT(html, HasSubstr("A board's log over its simulation"));
  EXPECT_THAT(html, HasSubstr("b&lt;i&gt;.csv<small class=\"aside\">recorded on a board</small>"));
  EXPECT_THAT(
      html,
      HasSubstr("<code>i_m_A</code></th><td class=\"num\">12</td><td class=\"num\">125.0\u00a0mA</td>"));
  EXPECT_THAT(html, HasSubstr("moved by 30.00\u00a0µs"));
}

TEST(Comparison, foreign_text_stays_text_and_figures_stand_side_by_side) {
  SyntheticRun one = synthetic_run(0.002), two = synthetic_run(0.002);
  two.scenario.title = "<b>bold</b>";
  two.outcome.verdicts[1].ok = false;
  two.outcome.verdicts[1].measured = 2 * one.outcome.verdicts[1].measured;
  const std::string html =
      render_comparison({.runs = {{"one", one.scenario, &one.outcome, one.trace, one.trace},
                                  {"two", two.scenario, &two.outcome, two.trace, two.trace}},
                         .command = "sixstep run one.toml two.toml --html x.html",
                         .version = "0.1.0"});
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;bold&lt;/b&gt;"));
  EXPECT_THAT(
      html,
      HasSubstr(
          "<td class=\"num bad\">10.83\u00a0A <b>✗ not met</b><small class=\"aside\">+100\u00a0%</small>"));
  EXPECT_THAT(html, HasSubstr("No difference that changes a run."));
}

sixstep::study::Scenario shipped(const std::string& name) {
  auto s = files::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/" + name + ".toml");
  EXPECT_TRUE(s) << name;
  return s ? *s : sixstep::study::Scenario();
}

/// Doubles the n-th single number of a scenario that is not 0. Numbers in lists are not counted.
class Doubled final : public sixstep::base::Visitor {
 public:
  explicit Doubled(int n) : left_(n) {}
  std::string key;

 private:
  void visit_value(std::string_view name, const sixstep::base::ValueMember& member,
                   const sixstep::base::About&) override {
    double* x = nullptr;
    if (const auto* plain = std::get_if<double*>(&member)) x = *plain;
    if (const auto* optional = std::get_if<std::optional<double>*>(&member))
      x = (*optional)->has_value() ? &***optional : nullptr;
    if (!x || *x == 0.0 || left_-- != 0) return;
    *x *= 2;
    key = name;
  }
  void visit_table(std::string_view name, sixstep::base::TableMember& member,
                   const sixstep::base::About&) override {
    if (member.is_there() && name != "motor_override" && name != "record") member.walk(*this);
  }
  int left_;
};

/// Each number of a scenario affects the run. If two scenarios differ in one number, their set-up sections
/// must therefore differ.
TEST(SetUp, states_each_number_of_a_scenario) {
  for (const char* name :
       {"thesis/7.5-position", "gallery/sensorless-noise", "gallery/resolver-skew", "gallery/battery-sag",
        "gallery/one-shunt", "gallery/losses-20-khz", "gallery/linear-motor"}) {
    const sixstep::study::Scenario s = shipped(name);
    const std::string told = setup_section(s);
    int n = 0;
    for (;; ++n) {
      sixstep::study::Scenario other = s;
      Doubled doubled(n);
      describe(doubled, other);
      if (doubled.key.empty()) break;
      if (doubled.key == "duration_s") continue;
      EXPECT_NE(setup_section(other), told) << name << ": " << doubled.key;
    }
    EXPECT_GT(n, 20) << name;
  }
}

TEST(SetUp, of_two_scenarios_that_differ_differs) {
  const std::pair<const char*, const char*> pairs[] = {{"wind-up", "wind-up-none"},
                                                       {"position-step", "position-profile"},
                                                       {"salient-q", "salient-beside"},
                                                       {"hall-glitch", "hall-glitches"}};
  for (const auto& [one, two] : pairs)
    EXPECT_NE(setup_section(shipped(std::string("gallery/") + one)),
              setup_section(shipped(std::string("gallery/") + two)))
        << one;
}

TEST(SetUp, states_what_a_run_is_about) {
  const auto of = [](const char* name) { return setup_section(shipped(std::string("gallery/") + name)); };
  EXPECT_THAT(of("hall-glitch"), HasSubstr("sensors.hall_stable_samples = 3"));
  EXPECT_THAT(of("hall-glitch"), HasSubstr("Coulomb friction 20\u00a0mNm"));
  EXPECT_THAT(of("wind-up"), HasSubstr("<br>control.speed.anti_windup = 0<br>"));
  EXPECT_EQ(of("encoder-missed").find("at[1].reference"), std::string::npos)
      << "its setpoint is in the sentence";
  EXPECT_THAT(of("wind-up"), HasSubstr("control.speed.form = positional<br>"));
  EXPECT_THAT(of("one-shunt"), HasSubstr("settled after 1\u00a0µs"));
  EXPECT_THAT(of("stiction"), HasSubstr("breaks loose at"));
}

}  // namespace SIXSTEP_TEST_FILE

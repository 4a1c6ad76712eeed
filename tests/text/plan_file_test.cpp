// SPDX-License-Identifier: Apache-2.0
// Tests plans from files and from words on the command line. The plan contains their values. The scenario of
// each run is equal to a file that is written for this run.
#include "text/plan/plan_file.hpp"

#include <gmock/gmock.h>

#include "sixstep/analysis/verify/robust.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "text/plan/planned_scenarios.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char scenario[] = R"(motor = "maxon-251601"
duration_s = 2e-3
[control]
mode = "duty"
[reference]
value = 1
[load]
locked = true
[[spread]]
key = "motor_override.resistance_ohm"
relative = 0.1
[[compare]]
metric = "final"
signal = "current"
value = 23.3
source = "U/R"
)";

TEST(PlanWords, AreEndsAndNumbersOrValuesInTheKeysUnit) {
  const base::Result<analysis::Axis> range = axis_of("pwm.period_s=20us:0.1 ms:9:log");
  ASSERT_TRUE(range);
  EXPECT_EQ(range->key, "pwm.period_s");
  EXPECT_EQ(range->from, 20e-6);
  EXPECT_EQ(range->to, 100e-6);
  EXPECT_EQ(range->points, 9u);
  EXPECT_EQ(range->spacing, analysis::Spacing::logarithmic);
  EXPECT_THAT(axis_of("bridge.dead_time_s=0.2us,1e-6,1 us")->values, ElementsAre("2e-07", "1e-6", "1e-06"));
  EXPECT_THAT(axis_of("pwm.chopping=soft,hard")->values, ElementsAre("soft", "hard"));
  EXPECT_THAT(axis_of("supply.voltage_V=12")->values, ElementsAre("12"));
}

TEST(PlanWords, NameKeysOfListsAndOfLinearMotorsInTheirUnits) {
  EXPECT_EQ(axis_of("at[0].load.torque_Nm=10 mNm:1 Nm:3")->from, 10e-3);
  EXPECT_EQ(axis_of("load.force_N=1 N:2 kN:3")->to, 2000);
  EXPECT_EQ(*unit_of_key("at[0].load.torque_Nm"), "N m");
  EXPECT_EQ(*unit_of_key("load.force_N"), "N");
  EXPECT_EQ(*unit_of_key("load.torque_Nm"), "N m");
  EXPECT_FALSE(unit_of_key("force_N"));
}

TEST(PlanWords, ThatAreNoneSayWhy) {
  for (const auto& [words, told] : {std::pair{"supply.voltge_V=1:2:3", "did you mean supply.voltage_V?"},
                                    std::pair{"supply.voltage_V=1 A:2 A:3", "A"},
                                    std::pair{"supply.voltage_V=1:2:2.5", "is not a number of points"},
                                    std::pair{"supply.voltage_V=1:2:1", "is not a number of points"},
                                    std::pair{"supply.voltage_V=1:2:3:4:5", "has more than"},
                                    std::pair{"supply.voltage_V=", "does not name a key and its values"},
                                    std::pair{"=1", "does not name a key and its values"}}) {
    const base::Result<analysis::Axis> axis = axis_of(words);
    ASSERT_FALSE(axis) << words;
    EXPECT_THAT(to_string(axis.problems().front()), HasSubstr(told));
    EXPECT_EQ(axis.problems().front().where, words);
  }
}

TEST(PlanFile, IsToldFromAScenario) {
  EXPECT_TRUE(is_plan("scenario = \"a.toml\"\n"));
  EXPECT_FALSE(is_plan(scenario));
  EXPECT_FALSE(is_plan("scenario = \"a\"\nmotor = \"b\"\n"));
  EXPECT_FALSE(is_plan("scenario = "));
  EXPECT_FALSE(is_plan(""));
}

TEST(PlanFile, HoldsWhatItSays) {
  const base::Result<PlanFile> file = read_plan_text("p.toml", R"(title = "t"
scenario = "a.toml"
sampling = "sobol"
points = 32
drives = 4
seed = 7
sheet_tolerances = true
[[vary]]
key = "pwm.period_s"
from = "20 us"
to = 1e-4
spacing = "log"
[[vary]]
key = "pwm.chopping"
values = ["soft", "hard"]
[[vary]]
key = "bridge.dead_time_s"
values = [0, "0.2 us"]
strays = true
)");
  ASSERT_TRUE(file) << to_string(file.problems().front());
  EXPECT_EQ(file->title, "t");
  EXPECT_EQ(file->scenario, "a.toml");
  EXPECT_TRUE(file->sheet_tolerances);
  const analysis::Plan wanted{
      .axes = {{.key = "pwm.period_s",
                .values = {},
                .from = 20e-6,
                .to = 1e-4,
                .spacing = analysis::Spacing::logarithmic},
               {.key = "pwm.chopping", .values = {"\"soft\"", "\"hard\""}},
               {.key = "bridge.dead_time_s", .values = {"0", "2e-07"}, .strays = true}},
      .sampling = analysis::Sampling::sobol,
      .points = 32,
      .drives = 4,
      .seed = 7};
  EXPECT_EQ(file->plan, wanted);
}

TEST(PlanFile, IsTheSamePlanHoweverItsValuesAreSpelled) {
  const auto identity = [](std::initializer_list<const char*> axes) {
    analysis::Plan plan;
    for (const char* axis : axes) plan.axes.push_back(*axis_of(axis));
    return plan_identity(plan);
  };
  const std::string one = identity({"pwm.period_s=20us,30us"});
  for (const char* same :
       {"pwm.period_s=20e-6,30e-6", "pwm.period_s=0.02 ms,0.00003", "pwm.period_s=2.0e-5,3e-05"})
    EXPECT_EQ(identity({same}), one) << same;
  for (const char* other : {"pwm.period_s=20us,31us", "pwm.period_s=30us,20us", "pwm.period_s=20us,30us,30us",
                            "pwm.period_s=20us:30us:2"})
    EXPECT_NE(identity({other}), one) << other;
  EXPECT_EQ(identity({"pwm.chopping=soft,hard"}), identity({"pwm.chopping=\"soft\",\"hard\""}));
  EXPECT_EQ(identity({"supply.voltage_V=24,12"}), identity({"supply.voltage_V=24.0,1.2e1"}));
  EXPECT_NE(identity({"sensors.seed=9007199254740993,1"}), identity({"sensors.seed=9007199254740992,1"}))
      << "whole numbers have more digits than a double";
}

TEST(PlanFile, IsTheSamePlanWhereEachRunIs) {
  analysis::Plan plan{.axes = {{.key = "pwm.period_s", .values = {}, .from = 1, .to = 2, .points = 3}},
                      .points = 5};
  const auto differs = [&](const analysis::Plan& other) {
    return plan_identity(plan) != plan_identity(other);
  };
  analysis::Plan other = plan;
  other.points = 6;  // a grid ignores the number of points
  EXPECT_FALSE(differs(other));
  other = plan;
  other.axes[0].points = 4;
  EXPECT_TRUE(differs(other));
  other = plan;
  other.axes[0].strays = true;
  EXPECT_TRUE(differs(other));
  other = plan;
  other.drives = 2;
  EXPECT_TRUE(differs(other)) << "run 1 is then the second drive of the first point";
  plan.sampling = analysis::Sampling::sobol;
  other = plan;
  other.points = 6;
  EXPECT_FALSE(differs(other)) << "the sequence goes on";
  plan.sampling = analysis::Sampling::latin_hypercube;
  other = plan;
  other.points = 6;
  EXPECT_TRUE(differs(other));
  plan = {.axes = {}, .drives = 5};
  other = {.axes = {}, .drives = 50};
  EXPECT_FALSE(differs(other)) << "a longer series begins as a shorter one";
}

PlannedScenarios planned(analysis::Plan plan) { return {{"a.toml", scenario, {}, false}, std::move(plan)}; }

TEST(PlannedScenarios, AreThoseOfAFileWithTheValueInIt) {
  const PlannedScenarios plan = planned({.axes = {{.key = "supply.voltage_V", .values = {"12", "24"}}}});
  ASSERT_EQ(plan.check(), base::Problems{});
  for (std::size_t n = 0; n < 2; ++n) {
    const base::Result<study::Scenario> by_hand = read_scenario_text(
        "a.toml", scenario, {.overrides = {{"supply.voltage_V", n == 0 ? "12" : "24"}}, .resolve = {}});
    EXPECT_EQ(study::run(plan.run(n)->scenario)->digest, study::run(*by_hand)->digest);
  }
}

TEST(PlannedScenarios, AreTheSeriesDrivesAtEachPoint) {
  const PlannedScenarios plan =
      planned({.axes = {{.key = "supply.voltage_V", .values = {"12", "24"}}}, .drives = 3, .seed = 5});
  const study::Scenario at_24 =
      *read_scenario_text("a.toml", scenario, {.overrides = {{"supply.voltage_V", "24"}}, .resolve = {}});
  const study::Scenario drive = study::varied(at_24, 5, 1);
  const base::Result<analysis::PlannedRun> run = plan.run(4);
  EXPECT_EQ(study::run(run->scenario)->digest, study::run(drive)->digest);
  ASSERT_EQ(run->strayed.size(), 1u);
  EXPECT_EQ(run->strayed[0].key, "motor_override.resistance_ohm");
  EXPECT_EQ(run->strayed[0].value, drive.sheet.resistance_ohm->value);
}

TEST(PlannedScenarios, RefuseWhatNoRunCouldHave) {
  const auto told = [](analysis::Axis axis) {
    const base::Problems problems = planned({.axes = {std::move(axis)}}).check();
    return problems.empty() ? std::string("nothing") : to_string(problems.front());
  };
  EXPECT_THAT(told({.key = "supply.voltge_V", .values = {"1"}}), HasSubstr("voltge_V"));
  EXPECT_THAT(told({.key = "require[0].max", .values = {"1"}}), HasSubstr("must be the same in all runs"));
  EXPECT_THAT(told({.key = "pwm.chopping", .values = {"soft"}, .strays = true}),
              HasSubstr("is not a number, but strays = true requires numbers"));
  EXPECT_THAT(told({.key = "pwm.period_s", .values = {"3e-5"}, .strays = true}),
              HasSubstr("may not differ from drive to drive"));
  EXPECT_EQ(told({.key = "supply.voltage_V", .values = {"-1", "24"}}), "nothing")
      << "one of its ends can be run";
}

TEST(PlannedScenarios, StrayInThePlacesOfHallEdges) {
  const std::string hall = std::string(scenario) + "\n[sensors]\nrotor = \"hall\"\n";
  const auto edges = [](const base::Result<study::Scenario>& s) {
    return std::count_if(s->spread.begin(), s->spread.end(), [](const study::Spread& spread) {
      return spread.key.starts_with("sensors.hall_edges_deg[") && spread.absolute == 3.0;
    });
  };
  EXPECT_EQ(edges(PlannedScenarios({"a.toml", hall, {}, true}, {.axes = {}, .drives = 2}).nominal()), 6);
  const auto ideal = PlannedScenarios({"a.toml", scenario, {}, true}, {.axes = {}, .drives = 2}).nominal();
  EXPECT_EQ(edges(ideal), 0);
  EXPECT_THAT(analysis::tolerances_not_drawn(*ideal), HasSubstr("Hall edges"));
  EXPECT_EQ(analysis::tolerances_not_drawn(
                *PlannedScenarios({"a.toml", hall, {}, true}, {.axes = {}, .drives = 2}).nominal()),
            "");
}

TEST(PlannedScenarios, StrayInWhatASheetDoesNotPromise) {
  for (const char* mode : {"duty", "current"}) {
    const PlannedScenarios plan(
        {"a.toml", scenario, {.overrides = {{"control.mode", mode}}, .resolve = {}}, true},
        {.axes = {}, .drives = 2});
    const base::Result<study::Scenario> nominal = plan.nominal();
    ASSERT_TRUE(nominal) << to_string(nominal.problems()[0]);
    std::vector<std::string> keys;
    for (const study::Spread& spread : nominal->spread) keys.push_back(spread.key);
    EXPECT_THAT(keys, ElementsAre("motor_override.resistance_ohm", "motor_override.inductance_mH",
                                  "motor_override.torque_constant_mNm_A"))
        << mode;
    EXPECT_EQ(nominal->spread[0].relative, 0.1) << "what the file says stays";
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

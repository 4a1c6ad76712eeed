// SPDX-License-Identifier: Apache-2.0
// Tests scenarios that extend other scenarios: the values in effect, and the position of each mistake.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/text/scenario_folder.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;

const std::string head = "motor = \"maxon-251601\"\nduration_s = 0.02\n";

class Family : public ScenarioFolder {};

TEST_F(Family, WhatThisFileSaysWinsAndTheRestIsTheBases) {
  write("base.toml",
        head +
            "title = \"base\"\n[supply]\nvoltage_V = 12\nresistance_ohm = 0.1\ncapacitance_F = 1e-3\n"
            "[control]\nmode = \"current\"\n[reference]\nvalue = 5\n");
  const auto s =
      read("extends = \"base.toml\"\ntitle = \"mine\"\nsupply.voltage_V = 36\n[reference]\nvalue = 3\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->title, "mine");
  EXPECT_EQ(s->supply.voltage_V, 36.0);
  EXPECT_EQ(s->supply.resistance_ohm, 0.1);
  EXPECT_EQ(s->control.mode, sixstep::control::Mode::current);
  EXPECT_EQ(s->reference.value, 3.0);
  // The command line overrides the values of all files.
  const auto set = read("extends = \"base.toml\"\nsupply.voltage_V = 36\n",
                        {.overrides = {{"supply.voltage_V", "48"}, {"reference.value", "1"}}});
  ASSERT_TRUE(set);
  EXPECT_EQ(set->supply.voltage_V, 48.0);
  EXPECT_EQ(set->reference.value, 1.0);
}

TEST_F(Family, OfSeveralBasesTheLaterIsStronger) {
  write("a.toml",
        head + "supply.voltage_V = 10\npwm.period_s = 1e-5\n[[require]]\nmetric = \"max\"\nmax = 1\n");
  write("b.toml", "supply.voltage_V = 20\n[[require]]\nmetric = \"max\"\nmax = 2\n");
  const auto s = read("extends = [\"a.toml\", \"b.toml\"]\n[[require]]\nmetric = \"max\"\nmax = 3\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->supply.voltage_V, 20.0);
  EXPECT_EQ(s->pwm.period_s, 1e-5);
  // The entries of lists of tables are appended, in the order of the files. An empty list removes the entries
  // of the bases.
  ASSERT_EQ(s->require.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(*s->require[n].max, static_cast<double>(n) + 1);
  const auto none = read("extends = [\"a.toml\", \"b.toml\"]\nrequire = []\n");
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->require.empty());
}

TEST_F(Family, ValuesInBracketsAndBracesAreReplacedWhole) {
  write("base.toml",
        head +
            "motor_override.resistance_ohm = { value = 1.1, frame = \"phase\", source = \"old\" }\n"
            "[control]\nmode = \"current\"\n[reference]\nshape = \"steps\"\ntimes_s = [0, 0.01]\nvalues = "
            "[1, 2]\n");
  const auto s = read(
      "extends = \"base.toml\"\nmotor_override.resistance_ohm = { value = 2, frame = \"terminal\" }\n"
      "[reference]\ntimes_s = [0]\nvalues = [7]\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->sheet.resistance_ohm->frame, "terminal");
  EXPECT_NE(s->sheet.resistance_ohm->source, "old");
  EXPECT_THAT(s->reference.values, ElementsAre(7.0));
}

// A table in braces in a base has the same effect as a table under a heading. It replaces the values of
// weaker bases.
TEST_F(Family, ABaseInBracesIsJoinedLikeOneUnderAHeading) {
  const std::string common = head + "control.mode = \"speed\"\nreference.value = 100\n";
  const std::string child = "[load]\ntorque_Nm = 0.02\n[control.speed]\ntorque_limit_Nm = 0.1\n";
  write("headings.toml",
        common + "[load]\ntorque_Nm = 0.01\nviscous_Nm_s = 1e-6\n[control.speed]\nsettle_s = 0.05\n");
  write("braces.toml",
        common + "control.speed = { settle_s = 0.05 }\nload = { torque_Nm = 0.01, viscous_Nm_s = 1e-6 }\n");
  const auto under = read("extends = \"headings.toml\"\n" + child);
  const auto braces = read("extends = \"braces.toml\"\n" + child);
  ASSERT_TRUE(under) << to_string(under.problems()[0]);
  ASSERT_TRUE(braces) << to_string(braces.problems()[0]);
  EXPECT_EQ(scenario_text(*braces), scenario_text(*under));
  EXPECT_EQ(braces->load.torque_Nm, 0.02);
  EXPECT_EQ(braces->load.viscous_Nm_s, 1e-6);
  EXPECT_EQ(*braces->control.speed.settle_s, 0.05);

  write("weaker.toml", "[load]\ncoulomb_Nm = 0.001\n");
  EXPECT_EQ(read("extends = [\"weaker.toml\", \"headings.toml\"]\n" + child)->load.coulomb_Nm, 0.001);
  const auto cut = read("extends = [\"weaker.toml\", \"braces.toml\"]\n" + child);
  ASSERT_TRUE(cut) << to_string(cut.problems()[0]);
  EXPECT_EQ(scenario_text(*cut), scenario_text(*braces));
}

TEST_F(Family, EmptyBracesDropATableOfTheBases) {
  write("far.toml", head + "[load]\ntorque_Nm = 0.01\nviscous_Nm_s = 1e-6\n");
  write("base.toml",
        "extends = \"far.toml\"\n[load]\ntorque_Nm = 0.05\n[control]\nmode = \"speed\"\n"
        "current = { settle_s = 1e-3 }\n[control.speed]\nsettle_s = 0.02\n[reference]\nvalue = 100\n");
  const auto s = read("extends = \"base.toml\"\nload = {}\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_EQ(s->load.torque_Nm, 0.0);
  EXPECT_EQ(s->load.viscous_Nm_s, 0.0) << "nor does a farther base's come through";
  const auto of_two = read("extends = [\"far.toml\", \"base.toml\"]\nload = {}\n");
  ASSERT_TRUE(of_two);
  EXPECT_EQ(of_two->load.viscous_Nm_s, 0.0);
  // A loop can be removed, although its table would need more keys. The other tables remain.
  const auto current = read("extends = \"base.toml\"\n[control]\nmode = \"current\"\nspeed = {}\n");
  ASSERT_TRUE(current) << to_string(current.problems()[0]);
  EXPECT_EQ(current->load.torque_Nm, 0.05);
  EXPECT_EQ(*current->control.current.settle_s, 1e-3);
  // An empty table in the middle file removes the values of the files below. The file above may set new
  // values.
  write("middle.toml", "extends = \"base.toml\"\nload = {}\n");
  const auto anew = read("extends = \"middle.toml\"\n[load]\ntorque_Nm = 0.02\n");
  ASSERT_TRUE(anew);
  EXPECT_EQ(anew->load.torque_Nm, 0.02);
  EXPECT_EQ(anew->load.viscous_Nm_s, 0.0);
}

TEST_F(Family, NamesInABaseAreLookedForBesideIt) {
  write("bases/r.csv", "0,1\n0.01,2\n");
  write("bases/common.toml", head + "control.mode = \"current\"\n");
  write("bases/b.toml", "extends = \"common.toml\"\n[reference]\nshape = \"csv\"\nfile = \"r.csv\"\n");
  const auto s = read("extends = \"bases/b.toml\"\n");
  ASSERT_TRUE(s) << to_string(s.problems()[0]);
  EXPECT_THAT(s->reference.values, ElementsAre(1.0, 2.0));
  // The written scenario is self-contained: it can be read without its base and without the other file.
  const auto again = files::read_scenario_text("elsewhere.toml", scenario_text(*s));
  ASSERT_TRUE(again);
  EXPECT_EQ(scenario_text(*again), scenario_text(*s));
}

TEST_F(Family, EachMistakeIsToldInTheFileThatHoldsIt) {
  write("base.toml", head + "[supply]\nvoltage_V = -3\n[pwm]\nchoping = \"hard\"\n[[require]]\nmax = 1\n");
  EXPECT_THAT(
      complaints("extends = \"base.toml\"\n[load]\nlocked = 1\n[[require]]\nmetric = \"maximum\"\nmax = 1\n"),
      ElementsAre(
          "x.toml:3:10: load.locked = 1 must be true or false; it means: whether the rotor is held",
          ::testing::AllOf(
              ::testing::StartsWith("x.toml:5:10: require.metric = \"maximum\" is not one of the "),
              ::testing::EndsWith("did you mean \"max\"?")),
          "base.toml:4:13: supply.voltage_V = -3 must be above 0; it means: voltage of the source, in V",
          "base.toml:6:1: pwm.choping is not a key here; did you mean chopping?",
          ::testing::StartsWith("base.toml:7:1: require.metric is missing")));
  // If two files contradict each other, the message also names the position.
  write("gains.toml", head + "[control]\nmode = \"current\"\n[control.current]\nd1 = 4.5\nd0 = -4\n");
  EXPECT_THAT(
      complaints("extends = \"gains.toml\"\n[control.current]\nsettle_s = 1e-3\n"),
      ElementsAre(::testing::StartsWith("gains.toml:6:6: control.current.d1 = 4.5 contradicts settle_s")));
}

TEST_F(Family, ANameThatLeadsNowhereOrInACircleIsTold) {
  EXPECT_THAT(
      complaints("extends = \"none.toml\"\n" + head),
      ElementsAre(
          "x.toml:1:11: extends = \"none.toml\" names none.toml, which cannot be read: No such file or "
          "directory; check the path and your permission to read the file"));
  EXPECT_THAT(
      complaints("extends = \"x.toml\"\n" + head),
      ElementsAre(
          "x.toml:1:11: extends = \"x.toml\" names a file that extends this file; put the common keys into a third file"));
  write("a.toml", "extends = [\"b.toml\"]\n");
  write("b.toml", "extends = [\"./bases/../a.toml\"]\n");
  EXPECT_THAT(complaints("extends = \"a.toml\"\n" + head),
              ElementsAre(::testing::StartsWith(
                  "b.toml:1:12: extends = \"./bases/../a.toml\" names a file that extends this file")));
  write("syntax.toml", "duration_s = 20 ms\n");
  EXPECT_THAT(complaints("extends = \"syntax.toml\"\n"),
              ElementsAre(::testing::StartsWith("syntax.toml:1:17: ")));
  EXPECT_THAT(
      complaints("extends = 3\n" + head),
      ElementsAre(
          "x.toml:1:11: extends = 3 must be a list of words; write words in brackets: [\"a\", \"b\"]"));
  EXPECT_THAT(
      complaints(head, {.overrides = {{"extends", "a.toml"}}}),
      ElementsAre(
          "--set extends = a.toml cannot be set: the files are joined before --set; write extends in the scenario file"));
  // Each of twenty files names two files, which would be a million files without a limit.
  for (int n = 0; n < 20; ++n)
    write(fmt::format("d{}.toml", n), fmt::format("extends = [\"d{0}.toml\", \"d{0}.toml\"]\n", n + 1));
  write("d20.toml", head);
  const std::vector<std::string> told = complaints("extends = \"d0.toml\"\n");
  ASSERT_FALSE(told.empty());
  EXPECT_THAT(told.front(), ::testing::HasSubstr("extends more than 64 files"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// The message about a wrong file, word for word: position, value, limit and remedy.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "files/scenario_on_disk.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class WrongInput : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  /// The messages about a file, each without the path of the folder.
  std::vector<std::string> complaints(const std::string& text, const files::ReadOptions& options = {}) {
    const base::Result<study::Scenario> result = files::read_scenario(write("x.toml", text), options);
    if (result) return {};
    std::vector<std::string> told;
    for (const base::Problem& problem : result.problems()) {
      std::string line = to_string(problem);
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
        line.erase(at, prefix.size());
      told.push_back(line);
    }
    return told;
  }
  std::filesystem::path folder_;
};

const std::string head = "motor = \"maxon-251601\"\nduration_s = 0.02\n";

TEST_F(WrongInput, AGoodFileIsToldNothing) { EXPECT_THAT(complaints(head), ElementsAre()); }

TEST_F(WrongInput, AMotorTakenForAScenarioIsToldInOneSentence) {
  EXPECT_THAT(
      complaints("name = \"mine\"\npole_pairs = 4\nresistance_ohm = 0.5\n"),
      ElementsAre(
          "x.toml:1:1: is a motor file, not a scenario; write a scenario for this motor with: sixstep new first --motor x.toml"));
  EXPECT_THAT(complaints("pole_pairs = 4\n" + head),  // a scenario with a motor's key in the wrong place
              ElementsAre(HasSubstr("x.toml:1:1: pole_pairs is not a key here")));
}

TEST_F(WrongInput, AScenarioTakenForAMotorIsToldInOneSentence) {
  write("y.toml", head);
  EXPECT_THAT(
      complaints("motor = \"y.toml\"\nduration_s = 0.02\n"),
      ElementsAre("y.toml:1:1: is a scenario, not a motor file; name the scenario's motor, maxon-251601"));
  write("z.toml", "duration_s = 0.02\n");
  EXPECT_THAT(complaints("motor = \"z.toml\"\nduration_s = 0.02\n"),
              ElementsAre(HasSubstr("is a scenario, not a motor file; name a motor file")));
}

TEST_F(WrongInput, WhatIsNoUtf8IsTold) {
  EXPECT_THAT(complaints("title = \"\xe9t\xe9\"\n" + head),
              ElementsAre(HasSubstr("save the file as text in UTF-8")));
}

TEST_F(WrongInput, UnknownKeyIsAnsweredWithTheNearest) {
  EXPECT_THAT(complaints(head + "[supply]\nvoltge_V = 24\n"),
              ElementsAre("x.toml:4:1: supply.voltge_V is not a key here; did you mean voltage_V?"));
  EXPECT_THAT(complaints(head + "[suply]\nvoltage_V = 24\n"),
              ElementsAre("x.toml:3:2: suply is not a key here; did you mean supply?"));
}

TEST_F(WrongInput, WrongUnitIsToldAsSuch) {
  EXPECT_THAT(
      complaints(head + "[supply]\nvoltage_mV = 24000\n"),
      ElementsAre(
          "x.toml:4:1: supply.voltage_mV is not a key here; write the key as voltage_V and give the value in the key's unit: 1 mV = 0.001 V"));
  EXPECT_THAT(
      complaints(head + "[supply]\nvoltage = 24\n"),
      ElementsAre(
          "x.toml:4:1: supply.voltage lacks its unit; write the key as voltage_V and give the value in the key's unit"));
}

TEST_F(WrongInput, TextWhereANumberBelongs) {
  EXPECT_THAT(
      complaints("motor = \"maxon-251601\"\nduration_s = \"20 mm\"\n"),
      ElementsAre(
          "x.toml:2:14: duration_s = \"20 mm\" has the unit mm, which cannot be converted to s; units that fit: s, ms, us or min"));
  EXPECT_THAT(
      complaints(head + "[supply]\nvoltage_V = \"a lot\"\n"),
      ElementsAre(
          "x.toml:4:13: supply.voltage_V = \"a lot\" must be a number, in V, or a number with its unit in "
          "quotes; it means: voltage of the source, in V"));
}

TEST_F(WrongInput, NotANumberAndInfinityAreRefused) {
  EXPECT_THAT(
      complaints(head + "[initial]\nspeed_rad_s = nan\nangle_rad = inf\n"),
      ElementsAre(
          "x.toml:4:15: initial.speed_rad_s = nan must be a finite number; it means: mechanical speed "
          "at the start, in rad/s",
          "x.toml:5:13: initial.angle_rad = inf must be a finite number; it means: mechanical angle "
          "at the start, in rad"));
}

TEST_F(WrongInput, DurationZero) {
  EXPECT_THAT(
      complaints("motor = \"maxon-251601\"\nduration_s = 0\n"),
      ElementsAre(
          "x.toml:2:14: duration_s = 0 must be above 0 and at most 9000000; it means: simulated time, in s"));
}

TEST_F(WrongInput, MissingRequiredKeysPointAtTheirTable) {
  EXPECT_THAT(
      complaints("title = \"x\"\n[[require]]\nmax = 1\n"),
      ElementsAre(
          "x.toml:1:1: motor is missing; write motor = ..: motor file: a path, or a name that is searched beside "
          "the scenario, in the data folder and in the built-in list",
          "x.toml:1:1: duration_s is missing; write duration_s = ..: simulated time, in s",
          "x.toml:2:1: require.metric is missing; write metric = ..: name of the figure that is computed from the signal"));
}

TEST_F(WrongInput, MissingMotor) {
  EXPECT_THAT(
      complaints("motor = \"maxon-25161\"\nduration_s = 0.02\n"),
      ElementsAre("x.toml:1:9: motor = \"maxon-25161\" is neither maxon-25161 nor maxon-25161.toml nor a "
                  "built-in motor; did you mean \"maxon-251601\"?"));
}

TEST_F(WrongInput, NegativeInductanceInTheMotorsOwnFile) {
  write("m.toml", R"(name = "m"
pole_pairs = 4
nominal_voltage_V = 24
resistance_ohm = { value = 1, frame = "terminal" }
inductance_mH = { value = -0.5, frame = "phase" }
inertia_gcm2 = 100
)");
  EXPECT_THAT(
      complaints("motor = \"m\"\nduration_s = 0.02\n"),
      ElementsAre("m.toml:5:27: inductance_mH.value = -0.5 must be above 0; it means: winding inductance, "
                  "between two terminals or of one phase of the star (L - M), in mH"));
}

TEST_F(WrongInput, FrameMustBeOneOfTheKeysOwn) {
  write("m.toml",
        "name = \"m\"\npole_pairs = 4\nresistance_ohm = { value = 1, frame = \"phase\" }\n"
        "inductance_mH = { value = 1, frame = \"star\" }\ninertia_gcm2 = { value = 1, frame = \"phase\" }\n");
  EXPECT_THAT(
      complaints("motor = \"m\"\nduration_s = 0.02\n"),
      ElementsAre(
          "m.toml:4:38: inductance_mH.frame = \"star\" must be \"terminal\" or \"phase\"; write "
          "frame = with the points between which the sheet measures the value",
          "m.toml:5:37: inertia_gcm2.frame = \"phase\" is not needed; remove frame: this value has only one meaning"));
}

TEST_F(WrongInput, FlatWidthOfHalfATurn) {
  EXPECT_THAT(
      complaints(head + "[motor_override]\nflat_deg = 180\n"),
      ElementsAre("x.toml:4:12: motor_override.flat_deg = 180 must lie strictly between 0 and 180; an ideal "
                  "six-step motor has 120"));
}

TEST_F(WrongInput, WordsAreAnsweredWithTheNearest) {
  EXPECT_THAT(
      complaints(head + "[pwm]\nalignment = \"center\"\nchopping = 3\n"),
      ElementsAre(
          "x.toml:4:13: pwm.alignment = \"center\" must be \"edge\" or \"centre\"; did you mean "
          "\"centre\"?",
          "x.toml:5:12: pwm.chopping = 3 must be \"soft\", \"hard\" or \"complementary\"; see: sixstep "
          "help pwm.chopping"));
}

TEST_F(WrongInput, OfManyWordsOnlyTheNearestIsTold) {
  EXPECT_THAT(
      complaints(head + "[[require]]\nmetric = \"settling_time\"\nsignal = \"u_ab\"\nmax = 1\n" +
                 "[[require]]\nmetric = \"maen\"\nsignal = \"colour\"\nmax = 1\n"),
      ElementsAre(::testing::AllOf(::testing::StartsWith(
                                       "x.toml:4:10: require.metric = \"settling_time\" is not one of the "),
                                   ::testing::EndsWith(" allowed words; did you mean \"settling_time_s\"?")),
                  ::testing::HasSubstr("; did you mean \"u_ab_V\"?"),
                  ::testing::HasSubstr("; did you mean \"mean\"?"),
                  ::testing::HasSubstr("; see: sixstep help require.signal")));
}

TEST_F(WrongInput, ReferenceInAnotherModesUnit) {
  EXPECT_THAT(
      complaints(head + "[control]\nmode = \"speed\"\n[reference]\nvalue = 955\nunit = \"rpm\"\n"),
      ElementsAre(
          "x.toml:7:8: reference.unit = \"rpm\" is not the unit of mode \"speed\"; give the reference in \"rad/s\", or the number with its unit, as \"100 rpm\", or change control.mode"));
  EXPECT_THAT(complaints(head + "[control]\nmode = \"current\"\n[reference]\nvalue = 9\nunit = \"rad/s\"\n"),
              ElementsAre("x.toml:7:8: reference.unit = \"rad/s\" is not the unit of mode \"current\"; "
                          "set control.mode = \"speed\", or give the reference in \"A\""));
}

TEST_F(WrongInput, ContradictoryGainsAreToldOnceAndWhere) {
  EXPECT_THAT(
      complaints(head + "[control]\nmode = \"current\"\n[control.current]\nsettle_s = 1e-3\ndamping = 0.9\n"
                        "d1 = 4.5\nd0 = -4.04\n"),
      ElementsAre(
          "x.toml:8:6: control.current.d1 = 4.5 contradicts settle_s and damping, which compute the gains; remove all forms of the gains except one: d1 and d0, kp with ki or ki_per_s, or settle_s and damping"));
}

TEST_F(WrongInput, EverythingAtOnceInTheOrderOfTheLines) {
  EXPECT_THAT(complaints("motor = 3\nduration_s = -1\n[pwm]\nperiod_s = 0\n[load]\nlocked = 1\ntimes_s = "
                         "3\n[bridge]\ndevice = \"thyristor\"\n")
                  .size(),
              6U);
}

TEST_F(WrongInput, SyntaxIsToldWithItsPlace) {
  EXPECT_THAT(
      complaints("motor = \"maxon-251601\"\nduration_s = 20 ms\n"),
      ElementsAre(
          "x.toml:2:17: Error while parsing key-value pair: expected a comment or whitespace, saw 'm'; end the line after the value; the key contains the unit"));
}

/// An earlier version of the parser assumed that a name starts after a bracket.
TEST_F(WrongInput, ABracketWithoutANameIsToldAsSyntax) {
  for (const char* line : {"[# no name", "[", "[[", "[=", "a = {# no name", "a = {,"})
    EXPECT_THAT(complaints(head + line), ElementsAre(HasSubstr("x.toml:3:"))) << line;
}

TEST_F(WrongInput, AWrongDurationIsToldAlone) {
  EXPECT_THAT(
      complaints("motor = \"maxon-251601\"\nduration_s = \"long\"\n[reference]\nshape = \"steps\"\n"
                 "times_s = [0, 1]\nvalues = [1, 2]\n[[require]]\nmetric = \"mean\"\nto_s = 1\nmax = 1\n")
          .size(),
      1U);
}

TEST_F(WrongInput, PercentIsNoDuty) {
  EXPECT_THAT(
      complaints(head + "[control]\nmode = \"duty\"\n[reference]\nvalue = 50\n"),
      ElementsAre(
          "x.toml:6:9: reference.value = 50 must lie from -1 to 1 in duty mode; write 0.5 for 50 %: a duty is the fraction of the period in which the switch is on, with a sign"));
}

TEST_F(WrongInput, NoLoopSettlesWithinTwoSamples) {
  const std::string loop =
      head + "[control]\nmode = \"current\"\n[control.current]\ndamping = 0.9\nsettle_s = ";
  EXPECT_THAT(
      complaints(loop + "59e-6\n"),
      ElementsAre(
          "x.toml:7:12: control.current.settle_s = 5.9e-05 is shorter than two control periods, in which no loop can settle; write at least 6e-05, better 10 periods, 0.0003; or shorten pwm.period_s"));
  EXPECT_THAT(complaints(loop + "60e-6\n"), ElementsAre());
}

TEST_F(WrongInput, SyntaxIsAnsweredWithWhatWasProbablyMeant) {
  const std::pair<const char*, const char*> cases[] = {
      {"duration_s = 0,02\n", "write a decimal point"},
      {"duration_s 0.02\n", "write KEY = VALUE"},
      {"motor = maxon\n", "put words in quotes"},
      {"motor = \"maxon\n", "close the quote"},
      {"[supply\nvoltage_V = 24\n", "close the header"},
      {"[load]\ntimes_s = [0, 1\nlocked = true\n", "close the list with ]"},
      {"[load]\nlocked = True\n", "in small letters"},
      {"[control]\ncurrent = { d1 = 1\n", "close the table with }"},
      {"duration_s = 1\nduration_s = 1\n", "once"},
  };
  for (const auto& [text, cure] : cases) {
    const std::vector<std::string> told = complaints(text);
    ASSERT_EQ(told.size(), 1U) << text;
    EXPECT_THAT(told[0], HasSubstr(cure));
  }
}

TEST_F(WrongInput, AStepOfASignalThatIsNotControlledNeedsItsLevel) {
  // The reference is a duty. As a level in ampere, it would give a meaningless number.
  EXPECT_THAT(
      complaints(head + "[control]\nmode = \"duty\"\n[reference]\nvalue = 0.5\n[[require]]\nmetric = "
                        "\"overshoot\"\nsignal = \"current\"\nmax = 1\n"),
      ElementsAre(
          "x.toml:7:1: require.level is missing, and the reference belongs to another signal; give level, the value that the signal must reach, in the signal's unit"));
}

TEST_F(WrongInput, FrequentSlipsOfSyntaxHaveTheirCure) {
  EXPECT_THAT(complaints("motor = \"maxon-251601\nduration_s = 1\n"),
              ElementsAre(::testing::EndsWith("; close the quote on the same line")));
  EXPECT_THAT(complaints(head + "duration_s = 3\n"),
              ElementsAre(::testing::EndsWith("; give each key and table once")));
}

TEST_F(WrongInput, ValuesOfTheCommandLineAreNamedAsSuch) {
  EXPECT_THAT(
      complaints(
          head,
          {.overrides = {{"supply.voltage_V", "-3"}, {"pwm.choping", "hard"}, {"pwm.chopping", "hard"}}}),
      ElementsAre("--set supply.voltage_V = -3 must be above 0; it means: voltage of the source, in V",
                  "--set pwm.choping is not a key here; did you mean chopping?"));
  EXPECT_THAT(complaints(head, {.overrides = {{"reference.unit", "1"}}}),
              ElementsAre(::testing::HasSubstr("; write --set 'reference.unit=\"1\"'; ")));
  EXPECT_THAT(complaints(head + "[reference]\nunit = 1\n"),
              ElementsAre(::testing::HasSubstr("; write unit = \"1\"; ")));
  EXPECT_THAT(
      complaints(head, {.overrides = {{"duration_s.x", "1"}}}),
      ElementsAre(
          "--set duration_s.x = 1 does not name a key; write --set table.key=value, for example --set supply.voltage_V=12"));
}

TEST_F(WrongInput, UnreadableFile) {
  const base::Result<study::Scenario> result = files::read_scenario("no/such/file.toml");
  ASSERT_FALSE(result);
  EXPECT_EQ(
      to_string(result.problems().at(0)),
      "no/such/file.toml: cannot be read: No such file or directory; check the path and your permission "
      "to read the file");
  for (const char* name : {"hill.tml", "hill"}) {
    const std::string near = write("hill.toml", head), path = (folder_ / name).string();
    const base::Result<study::Scenario> misspelt = files::read_scenario(path);
    ASSERT_FALSE(misspelt);
    EXPECT_EQ(to_string(misspelt.problems().at(0)),
              path + ": cannot be read: No such file or directory; did you mean " + near + "?");
  }
}

TEST_F(WrongInput, AFolderIsNoFile) {
  const base::Result<study::Scenario> result = files::read_scenario(folder_.string());
  ASSERT_FALSE(result);
  EXPECT_THAT(to_string(result.problems().at(0)),
              HasSubstr("cannot be read: Is a directory; name a file in this folder"));
}

/// The fuzzer found this case: after a key, the parser treated every character from U+00A1 to U+0499 as
/// unreachable.
TEST_F(WrongInput, ALetterBesideAKeyIsASyntaxErrorOnly) {
  for (const std::string letter : {"\u00d6", "\u00e9", "\u03b1", "\u3001", "\ufdf0"}) {
    const std::vector<std::string> told = complaints(head + "title" + letter + " = 1\n");
    ASSERT_EQ(told.size(), 1u) << letter;
    EXPECT_THAT(told[0], HasSubstr("x.toml:3:")) << letter;
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// Tests a reference from a file: the tables that can be read, and the messages about other files.
#include "text/scenario/reference_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "sixstep/study/scenario/at_description.hpp"
#include "tests/text/scenario_folder.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> told(const std::string& text, const std::optional<std::string>& column = {}) {
  const base::Result<ReferenceRows> rows = reference_rows("r.csv", text, column, "A");
  std::vector<std::string> lines;
  if (!rows)
    for (const base::Problem& problem : rows.problems()) lines.push_back(to_string(problem));
  return lines;
}

TEST(ReferenceFile, IsReadWhateverPartsItsCells) {
  for (const char* text :
       {"0,1\n0.5,-2.5e1\n", "\xef\xbb\xbft;i\r\n0;1\r\n0,5;-25\r\n", "# remark\n0\t1\n\n0.5\t-25",
        " 0  1\n 0.5   -25 \n", "\"t_s\",\"i_A\"\n0,1\n0.5,-25\n"}) {
    const base::Result<ReferenceRows> rows = reference_rows("r.csv", text, {}, "A");
    ASSERT_TRUE(rows) << text;
    EXPECT_THAT(rows->times_s, ElementsAre(0.0, 0.5)) << text;
    EXPECT_THAT(rows->values, ElementsAre(1.0, -25.0)) << text;
  }
  const base::Result<ReferenceRows> named = reference_rows("r.csv", "t_s,a,b\n0,1,2\n1,3,4\n", "b", "A");
  ASSERT_TRUE(named);
  EXPECT_THAT(named->values, ElementsAre(2.0, 4.0));
}

TEST(ReferenceFile, WhichOfManyColumnsIsMeantIsNotGuessed) {
  EXPECT_THAT(told("t [s],x [A],i [A]\n0,0,0\n0.1,3,100\n"),
              ElementsAre(AllOf(HasSubstr("r.csv:2: has 3 columns: \"x\", \"i\""),
                                HasSubstr("name the column in reference.column"))));
  EXPECT_THAT(told("0,0,0\n0.1,3,100\n"), ElementsAre(HasSubstr("keep two columns")));
  const base::Result<ShapeRows> shape = shape_rows("s.csv", "angle [deg],e,f\n0,0,0\n360,0,0\n");
  ASSERT_FALSE(shape);
  EXPECT_THAT(to_string(shape.problems()[0]), HasSubstr("keep two columns"));
}

TEST(ReferenceFile, AHeadingMayBringAUnit) {
  const auto read = [](const char* text, const char* unit) {
    const base::Result<ReferenceRows> rows = reference_rows("r.csv", text, {}, unit);
    EXPECT_TRUE(rows) << text << to_string(rows.problems()[0]);
    return rows ? *rows : ReferenceRows{};
  };
  EXPECT_THAT(read("time [ms];i (mA)\n0;0\n0,3;500\n", "A").times_s, ElementsAre(0.0, 0.0003));
  EXPECT_THAT(read("time [ms];i (mA)\n0;0\n0,3;500\n", "A").values, ElementsAre(0.0, 0.5));
  EXPECT_THAT(read("t_us,speed_rpm\n0,30\n5,60\n", "rad/s").times_s, ElementsAre(0.0, 5e-6));
  EXPECT_DOUBLE_EQ(read("t_us,speed_rpm\n0,30\n5,60\n", "rad/s").values.at(0), M_PI);
  EXPECT_THAT(read("t_s,speed_rad_s\n0,30\n", "rad/s").values, ElementsAre(30.0));
  EXPECT_THAT(read("t,duty_percent\n0,30\n", "").values, ElementsAre(0.3));
  EXPECT_THAT(read("t,what I saw\n0,30\n", "A").values, ElementsAre(30.0)) << "no unit: as wanted";
  EXPECT_THAT(
      told("t_s,u_V\n0,1\n"),
      ElementsAre(HasSubstr(
          "r.csv: has the heading u in V, but A is expected; name another column; units that fit: A")));
  for (const char* odd : {"t_s,i [counts]\n0,1\n", "Time (foo),i\n0,1\n"})
    EXPECT_THAT(told(odd), ElementsAre(HasSubstr("which is not a unit"))) << odd;
  // In the encoding of older instruments, the micro sign is one byte.
  EXPECT_THAT(read("time [\xb5s],speed_rpm\n0,30\n10000,60\n", "rad/s").times_s, ElementsAre(0.0, 0.01));
  EXPECT_DOUBLE_EQ(read("t,speed [turn/s]\n0,0.5\n", "rad/s").values.at(0), M_PI);
}

TEST(ReferenceFile, EachSlipIsToldWithItsLine) {
  EXPECT_THAT(told(""), ElementsAre(HasSubstr("r.csv: is empty; ")));
  EXPECT_THAT(told("t,i\n"), ElementsAre(HasSubstr("r.csv:1: contains no row of numbers; ")));
  EXPECT_THAT(told("0\n1\n"), ElementsAre("r.csv:1: has 1 column; each row is a time in s and a value"));
  EXPECT_THAT(told("0,1\n0.1\n0.2,x\n0.1,1\n0.1,1\n-1,nan\n"),
              ElementsAre("r.csv:2: column 2 \"\" is not a number; write numbers as 0.5 or 5e-1",
                          "r.csv:3: column 2 \"x\" is not a number; write numbers as 0.5 or 5e-1",
                          "r.csv:6: column 2 \"nan\" is not a number; write numbers as 0.5 or 5e-1"));
  EXPECT_THAT(
      told("# remark\n0,1\n0.1,1\n\n0.1,1\n-1,2\n"),
      ElementsAre("r.csv:5: time 0.1 is not above the row before; sort the rows; the first may be 0 s",
                  "r.csv:6: time -1 is not above the row before; sort the rows; the first may be 0 s"));
  EXPECT_THAT(told("t,torque\n0,1\n", "torqe"),
              ElementsAre("r.csv: has no column \"torqe\"; did you mean \"torque\"?"));
  EXPECT_THAT(
      told("0,1\n", "torque"),
      ElementsAre(
          "r.csv:1: has no headings; write headings in the first line, and the heading \"torque\" above the wanted column"));
  std::string broken = "0,1\n";
  for (int n = 0; n < 100; ++n) broken += "x,y\n";
  EXPECT_EQ(told(broken).size(), 6u);
  EXPECT_EQ(told(broken).back(),
            "r.csv: has wrong rows in 95 more lines; each row is a time in s and a value");
}

class ReferenceInAFile : public ScenarioFolder {
 protected:
  static std::string with(const std::string& keys) {
    return "motor = \"maxon-251601\"\nduration_s = 0.02\n[control]\nmode = \"current\"\n"
           "[reference]\nshape = \"csv\"\n" +
           keys;
  }
  base::Result<study::Scenario> read(const std::string& keys) { return ScenarioFolder::read(with(keys)); }
  std::vector<std::string> complaints(const std::string& keys) {
    return ScenarioFolder::complaints(with(keys));
  }
};

TEST_F(ReferenceInAFile, EntersTheScenarioAsNumbersThatStandForThemselves) {
  std::ofstream(folder_ / "r.csv") << "0,1\n0.01,3\n";
  const base::Result<study::Scenario> s = read("file = \"r.csv\"\ninterpolation = \"hold\"\n");
  ASSERT_TRUE(s);
  EXPECT_THAT(s->reference.times_s, ElementsAre(0.0, 0.01));
  // The scenario that is written no longer needs the file.
  const std::string text = scenario_text(*s);
  EXPECT_EQ(text.find("r.csv"), std::string::npos);
  const base::Result<study::Scenario> back = files::read_scenario_text("elsewhere.toml", text);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->reference.values, s->reference.values);
  EXPECT_EQ(back->reference.interpolation, study::Interpolation::hold);
}

TEST_F(ReferenceInAFile, ItsSlipsAreToldWhereTheyStand) {
  EXPECT_THAT(
      complaints("file = \"none.csv\"\n"),
      ElementsAre("x.toml:7:8: reference.file = \"none.csv\" names none.csv, which cannot be read: No "
                  "such file or directory; check the path and your permission to read the file"));
  EXPECT_THAT(complaints("file = \"/dev/zero\"\n"),
              ElementsAre("x.toml:7:8: reference.file = \"/dev/zero\" names /dev/zero, which cannot be read: "
                          "it is not a regular file; name a file"));
  std::ofstream(folder_ / "r.csv") << "0,1\n0,3\n";
  EXPECT_THAT(
      complaints("file = \"r.csv\"\n"),
      ElementsAre("r.csv:2: time 0 is not above the row before; sort the rows; the first may be 0 s"));
  EXPECT_THAT(
      complaints("file = \"r.csv\"\ntimes_s = [0]\nvalues = [1]\n"),
      ElementsAre(
          "x.toml:7:8: reference.file = \"r.csv\" contradicts times_s and values: give the rows only once; keep file, or times_s and values"));
  EXPECT_THAT(complaints("column = \"b\"\n"),
              ElementsAre("x.toml:5:1: reference.file is missing for shape = \"csv\"; give file = "
                          "\"NAME.csv\", or times_s and values"));
}

TEST_F(ReferenceInAFile, AnEventsOwnFileIsReadToo) {
  std::ofstream(folder_ / "r.csv") << "0,1\n0.01,3\n";
  const base::Result<study::Scenario> s = read(
      "times_s = [0]\nvalues = [0]\n[[at]]\ntime_s = 0.005\nreference = { shape = \"csv\", file = \"r.csv\" "
      "}\n");
  ASSERT_TRUE(s);
  EXPECT_THAT(s->at.at(0).reference->values, ElementsAre(1.0, 3.0));
}

TEST_F(ReferenceInAFile, WhatCannotChangeDuringARunIsToldWhatCan) {
  const std::string what(study::what_may_change);
  for (const char* key :
       {"reference", "load.torque_Nm", "control.mode", "pwm.chopping", "bridge.dead_time_s"})
    EXPECT_THAT(what, HasSubstr(key));
  EXPECT_THAT(
      complaints("times_s = [0]\nvalues = [0]\n[[at]]\ntime_s = 0.005\npwm.period_s = 1e-5\n"
                 "supply.resistance_ohm = 1\nload.torque_mNm = 1\n"),
      ElementsAre(
          "x.toml:11:5: at.pwm.period_s is not a key here; " + what,
          "x.toml:12:8: at.supply.resistance_ohm is not a key here; " + what,
          "x.toml:13:6: at.load.torque_mNm is not a key here; write the key as torque_Nm and give the value in the key's unit: 1 mNm = 0.001 Nm"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

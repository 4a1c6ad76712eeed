// SPDX-License-Identifier: Apache-2.0
// A board's log is read into a trace.
#include "text/recording/board_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace SIXSTEP_TEST_FILE {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_of(const sixstep::study::Trace& trace) {
  std::vector<std::string> out;
  for (const auto& column : trace.columns) out.push_back(column.name);
  return out;
}

TEST(BoardLog, ColumnsByTheirNamesInAnyUnit) {
  const auto log = text::read_board_log("b.csv",
                                        "# sixstep on an ATmega2560\n"
                                        "t [us],i_m [mA],duty,hall,speed [1/min],bus [V],bus [mA],faults\n"
                                        "100,-500,0.25,5,60,24,1500,0\n"
                                        "900,250,-0.125,4,-30,23.5,-20,3\n");
  ASSERT_TRUE(log) << log.problems()[0].limit;
  EXPECT_THAT(names_of(log->trace),
              ElementsAre("t_s", "i_m_A", "duty", "hall", "speed_rad_s", "bus_V", "bus_A"));
  EXPECT_THAT(log->trace.values[0], ElementsAre(DoubleEq(1e-4), DoubleEq(9e-4)));
  EXPECT_THAT(log->trace.values[1], ElementsAre(DoubleEq(-0.5), DoubleEq(0.25)));
  EXPECT_THAT(log->trace.values[2], ElementsAre(0.25, -0.125));
  EXPECT_NEAR(log->trace.values[4][0], 6.283185307179586, 1e-14);
  EXPECT_THAT(log->trace.values[6], ElementsAre(DoubleEq(1.5), DoubleEq(-0.02)));
}

TEST(BoardLog, ATracesOwnHeadings) {
  const auto log = text::read_board_log("b.csv", "t_s,i_m_A,u_ab_V\n0,1,2\n0.5,3,4\n");
  ASSERT_TRUE(log);
  EXPECT_THAT(names_of(log->trace), ElementsAre("t_s", "i_m_A", "u_ab_V"));
}

TEST(BoardLog, ATracesOwnHeadingInAnotherUnitIsRefused) {
  const auto told = [](const char* text) {
    const auto log = text::read_board_log("b.csv", text);
    return log ? std::string("nothing") : log.problems()[0].limit + "; " + log.problems()[0].cure;
  };
  EXPECT_THAT(told("t_s,i_m_A [mA]\n0,1\n1,2\n"),
              HasSubstr("whose name says A but whose unit says mA; write the heading i_m_A or i_m [mA]"));
  EXPECT_THAT(told("t_s,speed_rad_s [rpm]\n0,1\n1,2\n"),
              HasSubstr("write the heading speed_rad_s or speed [rpm]"));
  EXPECT_THAT(told("t_s [ms],i_m [mA]\n0,1\n1,2\n"), HasSubstr("write the heading t_s or t [ms]"));
  EXPECT_EQ(told("t_s [s],i_m_A [A],bus_V (V)\n0,1,2\n1,2,3\n"), "nothing");
}

TEST(BoardLog, FromTheLastStartToTheLastWholeLine) {
  const auto log = text::read_board_log(
      "b.csv",
      "67,8\n# reset\nt [us],i_m [mA]\n100,1\n200,2\n3# the watchdog bit\nt [us],i_m [mA]\n100,5\n200,6\n300,-");
  ASSERT_TRUE(log) << log.problems()[0].limit;
  EXPECT_THAT(log->trace.values[1], ElementsAre(DoubleEq(5e-3), DoubleEq(6e-3)));
}

TEST(BoardLog, SaysWhatIsWrong) {
  const auto limit = [](const char* text) {
    const auto log = text::read_board_log("b.csv", text);
    return log ? std::string("nothing") : log.problems()[0].where + " " + log.problems()[0].limit;
  };
  EXPECT_THAT(limit(""), HasSubstr("is empty"));
  EXPECT_THAT(limit("t [us],i_m [V]\n1,2\n3,4\n"), HasSubstr("but A is expected"));
  EXPECT_THAT(limit("t [us],temper\n1,2\n3,4\n"), HasSubstr("no column of the simulation"));
  EXPECT_THAT(limit("t [us],i_m [mA]\n1,2\n1,4\n"), HasSubstr("does not rise"));
  EXPECT_THAT(limit("t [us],i_m [mA]\n1,x\n2,4\n"), HasSubstr("is not a number"));
  EXPECT_THAT(limit("i_m [mA],duty\n1,0\n2,0\n"), ::testing::Not("nothing"));
  EXPECT_EQ(limit("t [us],i_m [mA]\n1,2\n"), "nothing");  // the comparison decides whether two rows suffice
  EXPECT_THAT(limit("t [us],i_m [mA]\n"), HasSubstr("contains no row of numbers"));
  EXPECT_EQ(limit("t [us],i_m [mA]\n1,2\n3,4\n"), "nothing");
}

std::string limit_with(const std::string& formula) {
  text::LogColumns wanted;
  wanted.formulas = {formula};
  const auto log = text::read_board_log("b.csv", "t [ms],erpm,i_m [mA]\n1,60,2\n3,60,4\n", wanted);
  return log ? "nothing" : to_string(log.problems()[0]);
}

TEST(BoardLog, ABrokenFormulaIsRefusedWithItsPlace) {
  for (const auto& [formula, place] :
       {std::pair{"speed=erpm*", "* at character 11"}, std::pair{"speed=*erpm", "* at character 7"},
        std::pair{"speed=erpm**2", "* at character 11"}, std::pair{"speed=erpm/*2", "/ at character 11"},
        std::pair{"speed=2**erpm", "* at character 9"}, std::pair{"speed=-*erpm", "* at character 8"},
        std::pair{"speed=erpm*2*pi/60/8*", "* at character 21"}, std::pair{"time=t/", "/ at character 7"}})
    EXPECT_THAT(limit_with(formula), testing::AllOf(testing::StartsWith("columns = "), HasSubstr(place)))
        << formula;
  for (const char* formula : {"speed=e*rpm", "speed=erpm+", "speed=erpm^", "speed=e/rpm*2", "speed=erpm*two"})
    EXPECT_THAT(limit_with(formula), HasSubstr("has no column")) << formula;
  for (const char* formula :
       {"speed=erpm", "speed=erpm*2*pi/60/8", "speed=-2*erpm", "speed= e rpm * pi / 30 "})
    EXPECT_EQ(limit_with(formula), "nothing") << formula;
  text::LogColumns wanted;
  wanted.formulas = {"speed=2*erpm/4*3"};
  const auto log = text::read_board_log("b.csv", "t [ms],erpm\n1,60\n3,60\n", wanted);
  ASSERT_TRUE(log);
  EXPECT_THAT(log->trace.values[1], ElementsAre(DoubleEq(90.0), DoubleEq(90.0)));
}

/// The remarks that a board writes between the rows, and the faults in its columns, appear as notes.
TEST(BoardLog, RemarksBetweenRowsAndFaultsAreTold) {
  const char* const rows =
      "# sixstep on an ATmega2560\nt [us],i_m [mA],missed,faults\n100,1,0,0\n# fault: over-current\n200,2,3,0\n"
      "# fault: over-current\n300,3,0,4\n\n# stop\n";
  text::LogColumns wanted;
  for (const bool named : {false, true}) {
    if (named) wanted.formulas = {"i_m=i_m"};
    const auto log = text::read_board_log("b.csv", rows, wanted);
    ASSERT_TRUE(log);
    EXPECT_THAT(
        log->notes,
        ElementsAre(
            "line 4 says \"fault: over-current\", and 1 more line says the same", "line 9 says \"stop\"",
            "1 row says that the board missed up to 3 control periods: the values in such rows are late",
            "1 row says that the board had a fault, at first faults 4 in line 7"));
    EXPECT_THAT(log->not_used, testing::IsEmpty());
  }
  const auto calm = text::read_board_log("b.csv", "t [us],i_m [mA],missed,faults\n100,1,0,0\n200,2,0,0\n");
  ASSERT_TRUE(calm);
  EXPECT_THAT(calm->notes, testing::IsEmpty());
}

TEST(BoardLog, ALineOfUnitsWithAStrangeOneIsNoLineOfHeadings) {
  const auto limit = [](const char* text) {
    const auto log = text::read_board_log("b.csv", text);
    return log ? "nothing" : to_string(log.problems()[0]);
  };
  EXPECT_THAT(limit("t,i_m,u_a\ns,foo,V\n0,1,2\n1,2,3\n"),
              testing::AllOf(HasSubstr("has the heading i_m in \"foo\", which is not a unit"),
                             HasSubstr("units that fit: A")));
  EXPECT_THAT(limit("t,i_m\nfoo,mA\n0,1\n1,2\n"),
              HasSubstr("has the heading t in \"foo\", which is not a unit"));
  EXPECT_THAT(limit("t,foo,bar\ns,V,mA\n0,1,2\n1,2,3\n"), HasSubstr("it has t, foo, bar"));
  const auto log = text::read_board_log("b.csv", "t,duty,i_m\nms,-,mA\n0,0.5,2\n1,0.25,3\n");
  ASSERT_TRUE(log);
  EXPECT_THAT(names_of(log->trace), ElementsAre("t_s", "duty", "i_m_A"));
  EXPECT_THAT(log->trace.values[2], ElementsAre(DoubleEq(2e-3), DoubleEq(3e-3)));
}

}  // namespace SIXSTEP_TEST_FILE

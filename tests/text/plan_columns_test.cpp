// SPDX-License-Identifier: Apache-2.0
// Tests the names of a plan's columns. All names differ, none contains active content, and the CSV file
// contains them in the order of its cells.
#include "text/results/plan_columns.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <memory>

#include "text/results/plan_text.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;

analysis::PlanColumns columns() {
  analysis::PlanColumns c;
  c.keys = {{"supply.voltage_V", "V"}, {"pwm.chopping", ""}};
  c.strayed = {{"supply.voltage_V", "V"}};
  c.figures = {{.name = "peak", .unit = "A", .required = true, .min = {}, .max = 3.0},
               {.name = "Peak", .unit = "A", .min = {}, .max = {}},
               {.name = "end", .unit = "", .min = {}, .max = {}},
               {.name = "=1+1,\x1b[31m\n", .unit = "rad/s", .min = {}, .max = {}}};
  return c;
}

TEST(PlanColumns, HaveNamesOfTheirOwn) {
  EXPECT_THAT(column_names(columns()),
              ElementsAre("supply.voltage_V [V]", "pwm.chopping", "drive: supply.voltage_V [V]", "peak [A]",
                          "Peak [A] (2)", "end (2)", "'=1+1,\\u001b[31m\\u000a [rad/s]"));
}

TEST(PlanColumns, StandOverTheCellsOfARow) {
  EXPECT_EQ(
      plan_csv_head(columns()),
      "run,end,passed,supply.voltage_V [V],pwm.chopping,drive: supply.voltage_V [V],peak [A],Peak [A] (2),end (2),"
      "\"'=1+1,\\u001b[31m\\u000a [rad/s]\",problem,digest\n");
  const auto row = analysis::RunRecord::of(std::make_shared<const analysis::PlanColumns>(columns()),
                                           {.number = 4,
                                            .point = {"-12", "\"=soft\""},
                                            .strayed = {-1.5},
                                            .end = analysis::RunEnd::whole,
                                            .problem = "=a\nb",
                                            .figures = {2.0, std::numeric_limits<double>::quiet_NaN(),
                                                        std::numeric_limits<double>::infinity(), -0.25},
                                            .digest = 255});
  ASSERT_TRUE(row);
  EXPECT_EQ(plan_csv_row(*row), "4,whole,1,-12,'=soft,-1.5,2,,never,-0.25,'=a\\u000ab,00000000000000ff\n")
      << "a number is a number, minus and all";
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

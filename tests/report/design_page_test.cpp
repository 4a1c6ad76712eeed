// SPDX-License-Identifier: Apache-2.0
// The page of a design is complete HTML, escapes all names, and has every part of the design. The same input
// gives the same bytes.
#include "report/design_page.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "files/scenario_on_disk.hpp"
#include "report/svg_chart.hpp"
#include "text/results/design_text.hpp"

namespace report {
namespace SIXSTEP_TEST_FILE {

namespace analysis = sixstep::analysis;
using sixstep::control::Mode;
using ::testing::HasSubstr;
using ::testing::Not;

analysis::DesignStudy studied(Mode mode, const std::string& name = "") {
  const auto file = std::filesystem::path(SIXSTEP_SOURCE_DIR) / "data/motors/maxon-251601.toml";
  auto sheet = files::read_sheet(file.string());
  if (!name.empty()) sheet->name = name;
  const auto s = analysis::study_design({.subject = {"maxon-251601", *sheet, {}},
                                         .spec = {.mode = mode, .torque_limit_Nm = 0.78},
                                         .tolerances = analysis::sheet_tolerances(*sheet, mode)});
  EXPECT_TRUE(s);
  return *s;
}

std::string page_of(const analysis::DesignStudy& s) {
  return render_design({s, "usable, 1 warning: a line", "motor = \"<x>\"", "sixstep design", "0"});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(DesignPage, HasEveryPartOfTheDesign) {
  const analysis::DesignStudy s = studied(Mode::speed);
  const std::string page = page_of(s);
  EXPECT_EQ(page, page_of(s));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr(">inf")));
  EXPECT_THAT(page, Not(HasSubstr(".hpp")));  // advice names keys and options, not source files
  EXPECT_EQ(count(page, "<svg"), 6u);         // step, current, gain, phase, headroom, ripple
  EXPECT_EQ(count(page, "</svg>"), 6u);
  EXPECT_EQ(count(page, "<table"), count(page, "</table>"));
  for (const char* part : {"0.0158299", "0.017225", "4.09559", "Speed cascade as designed", "J doubled",
                           "of the torque limit per rad/s", "Tolerances", "motor = &quot;&lt;x&gt;&quot;",
                           ">usable, 1 warning<"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST(DesignPage, ShowsWhatDecidesFirstAndFoldsTheRest) {
  const std::string page = page_of(studied(Mode::speed));
  const std::size_t steps = page.find("<details><summary>Derivation, step by step"),
                    margins = page.find("gain margin"), tolerances = page.find("<h2>Tolerances"),
                    file = page.find("<details><summary>The file that was simulated");
  ASSERT_NE(steps, page.npos);
  ASSERT_NE(file, page.npos);
  EXPECT_LT(page.find("<h2>Gains"), steps);
  EXPECT_GT(page.find("class=\"steps\""), steps) << "32 rows of derivation are folded";
  EXPECT_LT(page.find("class=\"steps\""), page.find("</details>"));
  EXPECT_LT(margins, tolerances);
  EXPECT_LT(tolerances, file);
  EXPECT_THAT(page, HasSubstr("gain margin, one period late</th><td class=\"num\">13.5\u00a0dB</td>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"unit\">dB</span>"));
}

/// The page has the lines of the text report about the speed sensor and about sensorless drives. These lines
/// are folded together with the other steps.
TEST(DesignPage, TellsHowTheSpeedIsKnown) {
  analysis::DesignStudy s = studied(Mode::speed);
  s.design.sensing = {{"w_min", "slowest speed that does not read as 0", 12.5, "rad/s"}};
  EXPECT_THAT(page_of(s), Not(HasSubstr("Without a rotor sensor")));
  s.sensorless = {{"T_swing", "2 pi sqrt(J/(p K_t I_start))", 23.5e-3, "s"}};
  const std::string page = page_of(s);
  for (const char* part :
       {"slowest speed that does not read as 0", "12.5\u00a0rad/s", "Without a rotor sensor", "23.5\u00a0ms"})
    EXPECT_GT(page.find(part), page.find("<details><summary>Derivation, step by step")) << part;
  EXPECT_THAT(page, HasSubstr("slowest speed that does not read as 0"));
  EXPECT_THAT(page, HasSubstr("23.5\u00a0ms"));
}

TEST(Design, ANominalCurrentThatNobodyNamedIsNotCalledSo) {
  auto sheet = files::read_sheet(
      (std::filesystem::path(SIXSTEP_SOURCE_DIR) / "data/motors/maxon-251601.toml").string());
  sheet->nominal_current_A.reset();
  const auto s = analysis::study_design(
      {.subject = {"maxon-251601", *sheet, {}}, .spec = {.mode = Mode::speed}, .tolerances = {}});
  ASSERT_TRUE(s);
  const std::string page = page_of(*s), text = text::design_text(*s, false);
  for (const std::string& told : {page, text}) {
    EXPECT_THAT(told, Not(HasSubstr("half the torque of the nominal current")));
    EXPECT_THAT(told, HasSubstr("the sheet names no nominal current: a tenth of the stall current, 2.33"));
  }
  EXPECT_THAT(
      text, HasSubstr("2.3301 A, a tenth of the stall current, because the sheet names no nominal current"));
  EXPECT_THAT(page, HasSubstr("a tenth of stall"));
  EXPECT_THAT(text,
              HasSubstr(" A, a tenth of the stall current (the sheet names no nominal current), above "));
}

TEST(DesignPage, ShowsAMoveAndAHeldRotor) {
  EXPECT_EQ(count(page_of(studied(Mode::position)), "<svg"), 6u);
  const std::string held = page_of(studied(Mode::current, "<b>evil</b>"));
  EXPECT_EQ(count(held, "<svg"), 5u);
  EXPECT_THAT(held, Not(HasSubstr("<b>evil")));
}

TEST(SvgCharts, DrawWhatIsFiniteAndBreakWhereItIsNot) {
  SvgChart chart{.title = "t", .x_label = "x"};
  EXPECT_EQ(svg_chart(chart), "");
  chart.curves = {{"c", "a", {0, 1, 2, 3}, {0, NAN, 2, 3}}};
  const std::string drawn = svg_chart(chart);
  EXPECT_EQ(count(drawn, "<path"), 1u);
  const std::string path = drawn.substr(drawn.find(" d=\"") + 4);
  EXPECT_EQ(count(path.substr(0, path.find('"')), "M"), 2u);
  EXPECT_EQ(count(path.substr(0, path.find('"')), "L"), 1u);
  chart.log_x = true;  // a logarithmic axis has no 0
  chart.curves[0].y = {1, 2, 3, 4};
  EXPECT_THAT(svg_chart(chart), Not(HasSubstr("inf")));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace report

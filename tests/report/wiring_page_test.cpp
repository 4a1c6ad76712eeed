// SPDX-License-Identifier: Apache-2.0
// The drawing and the page of a motor's wirings are complete HTML and escape all names. The same study gives
// the same bytes.
#include "report/wiring_page.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "report/wiring_picture.hpp"
#include "tests/support/wirings.hpp"

namespace report {
namespace SIXSTEP_TEST_FILE {

using sixstep::analysis::WiringDoes;
using sixstep::analysis::WiringStudy;
using sixstep::testing::made_up_wirings;
using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(const WiringStudy& s) {
  return render_wiring({s, "motor = \"<x>\"", "sixstep motor wiring", "0"});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(WiringPicture, HasEachWiringAndEachSymptom) {
  const WiringStudy s = made_up_wirings();
  const std::string svg = wiring_picture(s, "0.1.0");
  EXPECT_EQ(svg, wiring_picture(s, "0.1.0"));
  EXPECT_THAT(svg.substr(0, 400), HasSubstr("<desc>Made by sixstep 0.1.0</desc>"));
  EXPECT_EQ(count(svg, "<g"), count(svg, "</g>"));
  EXPECT_EQ(count(svg, "<title>phases "), 36u);
  EXPECT_THAT(svg, HasSubstr("<title>phases bac, Hall lines 132: BACKWARD</title>"));
  EXPECT_EQ(count(svg, "class=\"w-theory\""), 36u);
  EXPECT_EQ(count(svg, "class=\"w-run\""), 36u * 6 + 7) << "six starts each, and the current of each kind";
  for (const char* kind : {">FORWARD<", ">forward, early<", ">hums<", ">backward, late<", ">BACKWARD<"})
    EXPECT_THAT(svg, HasSubstr(kind));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_LT(svg.size(), 100'000u) << "pages show it";
}

TEST(WiringPicture, LeavesOutWhatNobodySees) {
  std::vector<Place> straight, corner;
  for (int n = 0; n <= 1000; ++n) {
    straight.push_back({0.1 * n, 0.1 * std::sin(n)});
    corner.push_back({0.1 * n, n < 500 ? 0.0 : 0.1 * (n - 500)});
  }
  EXPECT_EQ(line_through(straight), "M0 0l1000 1");
  EXPECT_EQ(line_through(corner), "M0 0l500 0 500 500");
  EXPECT_EQ(line_through({{0, 0}, {1, -1}, {2, 0}, {1, 0}}), "M0 0l10-10 10 10-10 0");
  EXPECT_EQ(line_through({{3, 4}}), "M30 40l0 0");
  EXPECT_EQ(line_through({}), "");
}

TEST(WiringPage, HasEveryPart) {
  const WiringStudy s = made_up_wirings();
  const std::string page = page_of(s);
  EXPECT_EQ(page, page_of(s));
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, HasSubstr("36 of 36"));
  EXPECT_THAT(page, HasSubstr("class=\"verdict pass\""));
  EXPECT_EQ(count(page, "<figure class=\"wiring\">"), 3u);
  EXPECT_THAT(page, HasSubstr("motor = &quot;&lt;x&gt;&quot;"));
  EXPECT_THAT(
      page,
      HasSubstr(
          "move the phase wires: a to c, c to b, b to a; or move the Hall lines: H1 to H2, H2 to H3, H3 to H1"));
  EXPECT_THAT(page, HasSubstr("Swap any two phase wires"));
}

TEST(WiringPage, TellsWhereTheoryAndSimulationDiffer) {
  WiringStudy s = made_up_wirings();
  s.cases[7].measured.does = WiringDoes::unclear;
  for (sixstep::analysis::FreeRun& run : s.cases[7].measured.runs) run.way_turns = 0;
  EXPECT_THAT(page_of(s), HasSubstr("35 of 36"));
  EXPECT_THAT(page_of(s), HasSubstr("class=\"verdict fail\""));
  EXPECT_THAT(page_of(s), HasSubstr("<td>FORWARD</td><td>unclear</td>"));
}

TEST(WiringPage, HoldsNamesAsText) {
  sixstep::design::Sheet sheet = sixstep::testing::maxon_sheet();
  sheet.name = "<script>alert(1)</script>&";
  const WiringStudy s = made_up_wirings(sheet);
  for (const std::string& text : {page_of(s), wiring_picture(s, "0")}) {
    EXPECT_THAT(text, Not(HasSubstr("<script")));
    EXPECT_THAT(text, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;&amp;"));
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace report

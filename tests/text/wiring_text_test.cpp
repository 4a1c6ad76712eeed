// SPDX-License-Identifier: Apache-2.0
// The 36 ways to connect a motor, as text and as JSON. The tests check the cell of each wiring, the terms of
// a linear motor, and the differences.
#include "text/results/wiring_text.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/linear.hpp"
#include "tests/support/wirings.hpp"
#include "text/results/wiring_json.hpp"
#include "text/results/wiring_words.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::WiringDoes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The cells of the row that starts with `begin`. Of the tables with such a row, the table with the number
/// `table` is used.
std::vector<std::string> row(const std::string& text, const std::string& begin, int table) {
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with("  " + begin + "  ") || table-- > 0) continue;
    std::vector<std::string> cells;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t from = line.find_first_not_of(' ', at);
      if (from == line.npos) break;
      const std::size_t end = std::min(line.find("  ", from), line.size());
      cells.push_back(line.substr(from, end - from));
      at = end;
    }
    return cells;
  }
  return {};
}

TEST(WiringText, HasEachWiringInItsPlace) {
  const std::string text = text::wiring_text(made_up_wirings());
  EXPECT_THAT(row(text, "3", 0), ElementsAre("3", "180..240 deg", "0", "1", "1", "3", "b", "a", "c"));
  EXPECT_THAT(row(text, "abc", 0),
              ElementsAre("abc", "FORWARD", "backward, late", "backward, early", "hums", "hums", "hums"));
  EXPECT_THAT(row(text, "bac", 0),
              ElementsAre("bac", "hums", "hums", "hums", "BACKWARD", "forward, late", "forward, early"));
  EXPECT_THAT(row(text, "abc", 1), ElementsAre("abc", "-", "a>c>b", "a>b>c", "H2-H3", "H1-H3", "H1-H2"));
  EXPECT_THAT(row(text, "cba", 1),
              ElementsAre("cba", "a-c", "a-b", "b-c", "a-b H1-H3", "a-b H1-H2", "a-b H2-H3"));
  EXPECT_THAT(text, HasSubstr("All 36 wirings move in simulation as theory predicts."));
  EXPECT_THAT(text, HasSubstr("20 times the current"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  for (const std::string& line : lines_of(text)) EXPECT_LE(line.size(), 130u) << line;
}

TEST(WiringText, SaysWhichWiringsDifferFromTheory) {
  analysis::WiringStudy s = made_up_wirings();
  s.cases[1].measured.does = WiringDoes::hums;
  s.cases[35].measured.does = WiringDoes::unclear;
  const std::string text = text::wiring_text(s);
  EXPECT_THAT(text, HasSubstr("phases abc, Hall lines 231: backward, late by theory, hums in simulation\n"));
  EXPECT_THAT(text,
              HasSubstr("phases bac, Hall lines 213: forward, early by theory, unclear in simulation\n"));
  EXPECT_THAT(text, HasSubstr("34 of 36 wirings move in simulation as theory predicts"));
  for (analysis::WiringCase& c : s.cases)
    c.measured.does = WiringDoes::hums;  // no wiring is left to compare the others with
  EXPECT_THAT(text::wiring_text(s), HasSubstr("18 of 36"));
}

TEST(WiringText, SpeaksOfALinearMotorInItsWords) {
  const analysis::WiringStudy s = made_up_wirings(unrolled(maxon_sheet()));
  EXPECT_THAT(turning_words(text::wiring_text(s)), ElementsAre());
  EXPECT_THAT(text::wiring_text(s), HasSubstr(" m/s"));
  EXPECT_THAT(text::wiring_text(s), HasSubstr(" mm at 50 Hz"));
  EXPECT_THAT(turning_words(text::wiring_json(s)), ElementsAre());
  const auto json = nlohmann::json::parse(text::wiring_json(s));
  EXPECT_GT(json["wirings"][0]["theory"]["force_N_A"], 0);
  EXPECT_EQ(json["wirings"][0]["measured"]["runs"][0]["speed_m_s"], 80);
}

TEST(WiringText, KeepsAHostileNameOffTheTerminal) {
  design::Sheet sheet = maxon_sheet();
  sheet.name = "a\033[2Jb\nc";
  const std::string text = text::wiring_text(made_up_wirings(sheet));
  EXPECT_EQ(text.find('\033'), text.npos);
  EXPECT_TRUE(text.starts_with("a\\u001b[2Jb\\u000ac\n")) << text.substr(0, 40);
  EXPECT_EQ(nlohmann::json::parse(text::wiring_json(made_up_wirings(sheet)))["motor"], sheet.name);
}

TEST(WiringJson, HasEverythingOfEachWiring) {
  const analysis::WiringStudy s = made_up_wirings();
  const auto json = nlohmann::json::parse(text::wiring_json(s));
  EXPECT_EQ(text::wiring_json(s), text::wiring_json(s));
  EXPECT_EQ(json["agreeing"], 36);
  EXPECT_EQ(json["commutation"][5], (nlohmann::json{{"sector", 5},
                                                    {"from_deg", 300},
                                                    {"to_deg", 360},
                                                    {"hall", "101"},
                                                    {"high", "c"},
                                                    {"low", "b"},
                                                    {"floating", "a"}}));
  ASSERT_EQ(json["wirings"].size(), 36u);
  for (std::size_t n = 0; n < 36; ++n) {
    const auto& w = json["wirings"][n];
    EXPECT_EQ(w["phases"], text::phases_word(s.cases[n].wiring));
    EXPECT_EQ(w["hall_lines"], text::hall_lines_word(s.cases[n].wiring));
    EXPECT_EQ(w["theory"]["does"], text::does_name(s.cases[n].theory.does));
    EXPECT_EQ(w["theory"]["part"], s.cases[n].theory.part);
    EXPECT_EQ(w["measured"]["runs"].size(), 6u);
    EXPECT_EQ(w["agrees"], true);
  }
  const auto& cures = json["wirings"][33]["cures"];  // bac, 132: the mirrored motor
  ASSERT_EQ(cures.size(), 3u);
  EXPECT_EQ(cures[0], (nlohmann::json{
                          {"wires", 4},
                          {"text", "swap the phase wires at legs a and b and swap the Hall lines H2 and H3"},
                          {"legs", {{"a", "b"}, {"b", "a"}}},
                          {"pins", {{"H2", "H3"}, {"H3", "H2"}}}}));
}

TEST(WiringWords, TellMovesAsTheyAreMade) {
  EXPECT_EQ(text::cure_text({}), "nothing");
  EXPECT_EQ(text::cure_mark({}), "-");
  EXPECT_EQ(text::cure_text({.legs = {1, 2, 0}}), "move the phase wires: a to b, b to c, c to a");
  EXPECT_EQ(text::cure_text({.legs = {2, 0, 1}}), "move the phase wires: a to c, c to b, b to a");
  EXPECT_EQ(text::cure_mark({.legs = {2, 0, 1}}), "a>c>b");
  EXPECT_EQ(text::cure_text({.pins = {2, 1, 0}}), "swap the Hall lines H1 and H3");
}

/// The words of each step agree with analysis::next_step().
TEST(WiringWords, OfTheRecipeAreItsSteps) {
  const auto steps = text::recipe_steps();
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(analysis::next_step(WiringDoes::hums), (analysis::Cure{.legs = {1, 0, 2}}));
  EXPECT_THAT(std::string(steps[0].second), HasSubstr("swap any two phase wires"));
  EXPECT_EQ(analysis::next_step(WiringDoes::forward_late), (analysis::Cure{.legs = {1, 2, 0}}));
  EXPECT_THAT(std::string(steps[1].second), HasSubstr("move all phase wires by one leg"));
  EXPECT_EQ(analysis::next_step(WiringDoes::backward),
            (analysis::Cure{.legs = {1, 0, 2}, .pins = {0, 2, 1}}));
  EXPECT_THAT(std::string(steps[2].second),
              HasSubstr("swap the phase wires at legs a and b and the Hall lines at H2 and H3"));
}

}  // namespace SIXSTEP_TEST_FILE

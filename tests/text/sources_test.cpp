// SPDX-License-Identifier: Apache-2.0
// Texts name other texts, although there is no file, as on a page in a browser.
#include "text/sources.hpp"

#include <gmock/gmock.h>

#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Sources, NamesAreMeantBesideWhoNamesThem) {
  EXPECT_EQ(beside("", "a.toml"), "a.toml");
  EXPECT_EQ(beside("a/b.toml", "c.toml"), "a/c.toml");
  EXPECT_EQ(beside("a/b.toml", "../c.toml"), "c.toml");
  EXPECT_EQ(beside("a/b.toml", "./x/../c.toml"), "a/c.toml");
  EXPECT_EQ(beside("a/b.toml", "/c.toml"), "/c.toml");
  EXPECT_EQ(beside("b.toml", "../../c.toml"), "../../c.toml");
  EXPECT_EQ(stem_of("a/b.c.toml"), "b.c");
  EXPECT_EQ(stem_of("a/.toml"), ".toml");
  EXPECT_EQ(stem_of("b"), "b");
}

const char* const base_text = "motor = \"mine\"\nduration_s = 1e-3\n[control]\nmode = \"duty\"\n";

base::Result<study::Scenario> read(const std::string& text, std::vector<NamedText> others) {
  return read_scenario_text("tried/x.toml", text, {.overrides = {}, .resolve = among(std::move(others))});
}

std::vector<std::string> complaints(const base::Result<study::Scenario>& s) {
  std::vector<std::string> lines;
  if (s) return lines;
  for (const base::Problem& problem : s.problems()) lines.push_back(to_string(problem));
  return lines;
}

TEST(Sources, AScenarioOfTextsAlone) {
  const std::string motor =
      "name = \"mine\"\npole_pairs = 4\nresistance_ohm = { value = 1, frame = \"terminal\" }\n"
      "inductance_mH = { value = 1, frame = \"terminal\" }\n"
      "torque_constant_mNm_A = 30\ninertia_gcm2 = 100\nnominal_voltage_V = 24\n";
  const auto s =
      read("extends = \"../base.toml\"\n[reference]\nshape = \"csv\"\nfile = \"rows.csv\"\n",
           {{"base.toml", base_text}, {"mine.toml", motor}, {"tried/rows.csv", "0, 0.1\n5e-4, 0.3\n"}});
  EXPECT_THAT(complaints(s), ElementsAre());
  ASSERT_TRUE(s);
  EXPECT_EQ(s->title, "x");
  EXPECT_THAT(s->reference.values, ElementsAre(0.1, 0.3));
}

TEST(Sources, WhatIsNotAtHandIsTold) {
  EXPECT_THAT(complaints(read("extends = \"base.toml\"\n", {})),
              ElementsAre(HasSubstr("extends = \"base.toml\" names tried/base.toml, which does not exist")));
  EXPECT_THAT(complaints(read(base_text, {})),
              ElementsAre(HasSubstr("motor = \"mine\" is neither tried/mine nor a built-in motor")));
  EXPECT_THAT(complaints(read_scenario_text("x.toml", base_text)),
              ElementsAre(HasSubstr("motor = \"mine\" is no built-in motor")));
}

TEST(Sources, ACircleIsFoundInAnySpelling) {
  EXPECT_THAT(
      complaints(read("extends = \"../tried/./x.toml\"\n", {{"tried/x.toml", "extends = \"x.toml\"\n"}})),
      ElementsAre(HasSubstr("a file that extends this file")));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

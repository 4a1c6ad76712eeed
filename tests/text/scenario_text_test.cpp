// SPDX-License-Identifier: Apache-2.0
// What is written reads back as the same scenario: every shipped one, and strings that TOML must escape.
#include "text/scenario/scenario_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "files/scenario_on_disk.hpp"
#include "text/scenario/starter_scenario.hpp"

namespace text {
namespace {

namespace fs = std::filesystem;

const fs::path data = fs::path(SIXSTEP_SOURCE_DIR) / "data";

study::Scenario read_back(const std::string& text) {
  base::Result<study::Scenario> result =
      files::read_scenario_text((data / "scenarios" / "written.toml").string(), text);
  if (result) return *result;
  for (const base::Problem& p : result.problems()) ADD_FAILURE() << to_string(p);
  return {};
}

TEST(ScenarioText, EveryShippedScenarioComesBackToTheBit) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data / "scenarios")) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().string());
    const base::Result<study::Scenario> scenario = files::read_scenario(entry.path().string());
    ASSERT_TRUE(scenario);
    const std::string text = scenario_text(*scenario);
    EXPECT_EQ(scenario_text(read_back(text)), text);
    for (const bool full : {false, true})  // explained line by line it is the same scenario
      EXPECT_EQ(scenario_text(read_back(starter_text(*scenario, {.file = "x.toml", .full = full}))), text);
    ++count;
  }
  EXPECT_GE(count, 30);
}

TEST(ScenarioText, WritesWhatDiffersFromTheDefaultsAlone) {
  study::Scenario s;
  s.motor = "maxon-251601";
  s.duration_s = 0.1;
  s.control.current.limit_A = 0.1 + 0.2;
  study::Requirement r;  // its metric is the default, and must be written all the same
  r.max = 3.0;
  s.require.push_back(r);
  EXPECT_EQ(scenario_text(s, {"one line\nonly"}),
            "# one line\\u000aonly\n"
            "motor = \"maxon-251601\"\n"
            "duration_s = 0.1\n"
            "\n[control.current]\n"
            "limit_A = 0.30000000000000004\n"
            "\n[[require]]\n"
            "metric = \"final\"\n"
            "max = 3\n");
}

TEST(ScenarioText, EscapesWhatAStringMayHold) {
  study::Scenario s;
  s.motor = "maxon-251601";
  s.duration_s = 0.1;
  s.title = "a \"quoted\" \\ back\nslash \x01 \x7f";
  EXPECT_EQ(read_back(scenario_text(s)).title, s.title);
}

}  // namespace
}  // namespace text

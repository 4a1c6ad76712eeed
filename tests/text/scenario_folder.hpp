// SPDX-License-Identifier: Apache-2.0
// Each test has its own folder, for scenarios that name other files. `complaints` returns the messages about a
// scenario.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "files/scenario_on_disk.hpp"

namespace text {

class ScenarioFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_ / "bases");
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  base::Result<study::Scenario> read(const std::string& text, const files::ReadOptions& options = {}) {
    return files::read_scenario_text((folder_ / "x.toml").string(), text, options);
  }
  /// The messages about a text. File names are relative to the folder.
  std::vector<std::string> complaints(const std::string& text, const files::ReadOptions& options = {}) {
    const base::Result<study::Scenario> s = read(text, options);
    std::vector<std::string> lines;
    if (s) return lines;
    for (const base::Problem& problem : s.problems()) {
      lines.push_back(to_string(problem));
      std::string& line = lines.back();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
        line.erase(at, prefix.size());
    }
    return lines;
  }
  std::filesystem::path folder_;
};

}  // namespace text

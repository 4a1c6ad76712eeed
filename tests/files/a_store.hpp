// SPDX-License-Identifier: Apache-2.0
// A plan's store in a folder of its own, and rows for the store.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/store/plan_store.hpp"

namespace files {

class Store : public testing::Test {
 protected:
  std::string path() const { return (folder_ / "runs.sqlite").string(); }
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("sixstep_store_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static StoredPlan plan() {
    StoredPlan p{.plan = "{\"vary\":[]}",
                 .inputs = "0123",
                 .title = "t",
                 .motor = "m",
                 .scenario = "s.toml",
                 .command = "c",
                 .scenario_text = "x = 1\n",
                 .columns = columns()};
    return p;
  }
  static analysis::TableColumns columns() {
    analysis::PlanColumns c;
    c.keys = {{"pwm.period_s", "s"}, {"pwm.chopping", ""}};
    c.strayed = {{"motor_override.resistance_ohm", "ohm"}};
    c.figures = {{"rise \"time\"", "s", true, {}, 2.0}, {"peak", "A", false, {}, {}}};
    return std::make_shared<const analysis::PlanColumns>(std::move(c));
  }
  static analysis::RunRecord row(const analysis::TableColumns& under, analysis::RunValues values) {
    return *analysis::RunRecord::of(under, std::move(values));
  }
  static analysis::RunRecord row(analysis::RunValues values) { return row(columns(), std::move(values)); }
  static analysis::RunValues values(std::size_t n) {
    const double x = static_cast<double>(n);
    return {.number = n,
            .point = {"3e-05", "\"soft\""},
            .strayed = {1.0 / (1.0 + x)},
            .end = analysis::RunEnd::whole,
            .problem = "",
            .figures = {x, 1.0 / 3.0 * x},
            .digest = 0xffffffff00000000u + n};
  }
  static analysis::RunRecord row(std::size_t n) { return row(values(n)); }
  /// Executes the statement in SQLite, without the code of the store.
  void tamper(const std::string& sql) const { ASSERT_EQ(Database::open(path())->run(sql), base::Problems{}); }
  std::string text_of_file() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string told() const {
    const base::Result<PlanStore> store = PlanStore::resume(path(), plan());
    return store ? "" : to_string(store.problems().front());
  }
  std::filesystem::path folder_;
};

inline std::vector<analysis::RunRecord> rows_of(PlanStore& store) {
  std::vector<analysis::RunRecord> rows;
  EXPECT_EQ(store.each([&](const analysis::RunRecord& r) { rows.push_back(r); }), base::Problems{});
  return rows;
}

}  // namespace files

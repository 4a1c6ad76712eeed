// SPDX-License-Identifier: Apache-2.0
// Tests the motors of the motor library. Each motor can be read. Its values are consistent, or its file names
// the contradictions. It can be simulated, or its file names the reason why not.
#include "text/motor/motor_library.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/run/run.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;

/// Visits a sheet and calls a function with each given value.
class EachQuantity final : public base::Visitor {
 public:
  using Call = std::function<void(std::string_view key, const base::Quantity& q, const base::About& about)>;
  explicit EachQuantity(Call call) : call_(std::move(call)) {}

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member,
                      const base::About& about) override {
    if (const base::Quantity* q = quantity_in(member)) call_(key, *q, about);
  }
  Call call_;
};

class MotorLibrary : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    base::Result<design::Sheet> sheet = read_sheet(GetParam());
    if (!sheet)
      for (const base::Problem& problem : sheet.problems()) FAIL() << to_string(problem);
    sheet_ = *sheet;
  }
  design::Sheet sheet_;
};

TEST_P(MotorLibrary, EveryValueHasSourceAndTrust) {
  EachQuantity each{[](std::string_view key, const base::Quantity& q, const base::About&) {
    EXPECT_FALSE(q.source.empty()) << key;
    EXPECT_NE(q.kind, base::Trust::unstated) << key;
    if (q.range) {
      EXPECT_LT(q.range->low, q.range->high) << key;
    }
  }};
  describe(each, sheet_);
}

TEST_P(MotorLibrary, AgreesWithItselfOrSaysWhereNot) {
  // check_sheet() refuses a known_deviation from a relation that the sheet satisfies. Both directions are
  // therefore tested.
  const auto check = design::check_sheet(sheet_);
  if (!check) FAIL() << to_string(check.problems().front());
  EXPECT_TRUE(check->consistent);
  EXPECT_EQ(check->doubts, base::Problems{});
  for (const design::Relation& r : check->relations)
    EXPECT_NE(r.verdict, design::RelationVerdict::broken) << r.name << " " << r.deviation;
}

TEST_P(MotorLibrary, SimulatesOrSaysWhyNot) {
  const base::Result<study::Scenario> scenario = read_scenario_text(
      "x.toml", "motor = \"" + GetParam() +
                    "\"\nduration_s = 1e-4\n[control]\nmode = \"duty\"\n[reference]\nvalue = 0.5\n");
  ASSERT_EQ(static_cast<bool>(scenario), sheet_.simulatable);
  if (scenario) {
    const auto outcome = study::run(*scenario);
    ASSERT_TRUE(outcome) << to_string(outcome.problems().front());
    EXPECT_GT(outcome->segments, 0u);
    return;
  }
  ASSERT_EQ(scenario.problems().size(), 1u);
  EXPECT_THAT(to_string(scenario.problems().front()),
              ::testing::AllOf(
                  ::testing::StartsWith("built-in " + GetParam() + ":"),
                  ::testing::HasSubstr("simulatable = false because " + sheet_.not_simulatable_because)));
}

TEST_P(MotorLibrary, WhatIsNotSimulatableLacksSomethingOrSaysItsDoubt) {
  if (sheet_.simulatable) return;
  // A doubtful value is not a missing value. These files describe their doubts in words.
  const std::set<std::string> doubted = {"anaheim-blws235d", "anaheim-blz362s", "drone-blk2blade",
                                         "jk42bls01",        "gmcc-ksk89d53u",  "qs138-70h"};
  sheet_.simulatable = true;
  sheet_.not_simulatable_because.clear();
  EXPECT_EQ(static_cast<bool>(design::motor_model(sheet_)), doubted.contains(GetParam()));
}

std::string in_letters(const ::testing::TestParamInfo<std::string>& info) {
  std::string name;
  for (const char c : info.param) name += c == '-' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Each, MotorLibrary, ::testing::ValuesIn(built_in_motors()), in_letters);

TEST(MotorLibraryFolder, IsCompiledInWhole) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(SIXSTEP_SOURCE_DIR) / "data" / "motors"))
    files.push_back(entry.path().stem().string());
  EXPECT_THAT(built_in_motors(), ::testing::UnorderedElementsAreArray(files));
  EXPECT_GE(files.size(), 30u);
}

TEST(MotorLibraryFolder, AMotorWithoutItsInertiaRunsOnceTheScenarioGivesIt) {
  const char* head =
      "motor = \"tmotor-4004-300kv\"\nduration_s = 1e-4\n[motor_override]\ninertia_gcm2 = 60\n";
  EXPECT_FALSE(read_scenario_text("x.toml", head));
  EXPECT_TRUE(read_scenario_text("x.toml",
                                 std::string(head) + "simulatable = true\nnot_simulatable_because = \"\"\n"));
}

TEST(MotorNames, AWordStandsForAllThatContainIt) {
  const auto cure = [](const std::string& name) {
    const auto sheet = read_sheet(name);
    return sheet ? std::string("found") : sheet.problems()[0].cure;
  };
  EXPECT_THAT(cure("Maxon"), ::testing::AllOf(::testing::HasSubstr("\"maxon-200142\""),
                                              ::testing::HasSubstr("or \"maxon-651614\"?")));
  EXPECT_EQ(cure("488607"), "did you mean \"maxon-488607\"?");
  EXPECT_EQ(cure("maxon-25160"), "did you mean \"maxon-251601\"?") << "a slip means one";
  EXPECT_THAT(cure("x"), ::testing::HasSubstr("sixstep motor list"));
  EXPECT_THAT(cure("unheard-of"), ::testing::HasSubstr("sixstep motor list"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

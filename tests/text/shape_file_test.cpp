// SPDX-License-Identifier: Apache-2.0
// Tests the points of a back-EMF from a file that a motor or an override names.
#include <gmock/gmock.h>

#include "text/scenario/reference_file.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* motor = R"(name = "tabled"
pole_pairs = 4
nominal_voltage_V = 24
back_emf = "table"
resistance_ohm = { value = 1, frame = "terminal" }
inductance_mH = { value = 1, frame = "terminal" }
torque_constant_mNm_A = 30
inertia_gcm2 = 100
)";
constexpr const char* rows = "angle_deg,value\n0,1\n120,1\n180,-1\n300,-1\n";

Resolve folder(const std::string& more, const std::string& table) {
  return among({{"motors/m.toml", motor + more}, {"motors/shape.csv", table}, {"other.csv", table}});
}

std::string first(const base::Problems& problems) { return to_string(problems.at(0)); }

TEST(ShapeFile, LiesBesideTheMotorThatNamesIt) {
  const auto sheet = read_sheet("motors/m.toml", folder("back_emf_file = \"shape.csv\"\n", rows));
  ASSERT_TRUE(sheet) << first(sheet.problems());
  EXPECT_THAT(sheet->back_emf_angle_deg, ElementsAre(0, 120, 180, 300));
  EXPECT_THAT(sheet->back_emf_shape, ElementsAre(1, 1, -1, -1));
}

TEST(ShapeFile, OfAnOverrideLiesBesideTheScenarioAndReplacesTheLists) {
  const std::string lists = "back_emf_angle_deg = [0, 90, 180, 270]\nback_emf_shape = [1, 1, -1, -1]\n";
  const std::string scenario =
      "motor = \"motors/m.toml\"\nduration_s = 0.01\ncontrol.mode = \"duty\"\n[motor_override]\n"
      "back_emf_file = \"other.csv\"\n";
  const auto read = read_scenario_text("s.toml", scenario, {.overrides = {}, .resolve = folder(lists, rows)});
  ASSERT_TRUE(read) << first(read.problems());
  EXPECT_THAT(read->sheet.back_emf_angle_deg, ElementsAre(0, 120, 180, 300));
}

TEST(ShapeFile, SaysWhatIsWrongWithItself) {
  const std::string named = "back_emf_file = \"shape.csv\"\n";
  const auto of = [&](const std::string& more, const char* table) {
    const auto sheet = read_sheet("motors/m.toml", folder(more, table));
    EXPECT_FALSE(sheet);
    return sheet ? std::string() : first(sheet.problems());
  };
  EXPECT_THAT(of(named, "angle_deg,value\n0,1\n120,x\n"),
              HasSubstr("motors/shape.csv:3: value \"x\" is not a number"));
  EXPECT_THAT(of(named, "0 1\n200 -1\n100 1\n"),
              HasSubstr("motors/shape.csv:3: angle 100 is not above the row before"));
  EXPECT_THAT(of(named, "time_s,value\n0,1\n"), HasSubstr("has the heading time in s, but deg is expected"));
  EXPECT_THAT(of("back_emf_file = \"none.csv\"\n", rows),
              HasSubstr("motors/m.toml:9:17: back_emf_file = \"none.csv\" names motors/none.csv"));
  EXPECT_THAT(of(named + "back_emf_shape = [1, -1]\n", rows), HasSubstr("give the points only once"));
  EXPECT_THAT(of(named, "0,1\n120,1\n180,-1\n300,-0.9\n"), HasSubstr("subtract 0.0"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

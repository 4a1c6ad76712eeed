// SPDX-License-Identifier: Apache-2.0
// Every motor and scenario in data/ can be read without a problem, and has all required texts.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "files/scenario_on_disk.hpp"
#include "text/motor/motor_library.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;
using ::testing::Contains;

const fs::path data = fs::path(SIXSTEP_SOURCE_DIR) / "data";

study::Scenario shipped(const std::string& name) {
  base::Result<study::Scenario> result =
      files::read_scenario((data / "scenarios" / (name + ".toml")).string());
  if (!result) {
    for (const base::Problem& problem : result.problems()) ADD_FAILURE() << to_string(problem);
    return {};
  }
  return *result;
}

TEST(ShippedFiles, EveryScenarioReads) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data / "scenarios")) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = fs::relative(entry.path(), data / "scenarios").replace_extension();
    SCOPED_TRACE(name.string());
    const study::Scenario scenario = shipped(name.string());
    EXPECT_FALSE(scenario.title.empty());
    EXPECT_EQ(scenario.require.empty(), name.parent_path() == "reference");
    for (const study::Requirement& r : scenario.require) {
      EXPECT_TRUE(r.min || r.max);
      EXPECT_FALSE(r.measure.label.empty());
    }
    ++count;
  }
  EXPECT_GE(count, 50);
}

/// A peak current must be a magnitude. If a drive brakes, the largest value would not show its peak.
TEST(ShippedFiles, APeakCurrentIsAMagnitude) {
  int count = 0;
  const auto judge = [&](const study::Measure& m) {
    if (m.label.find("peak current") == std::string::npos) return;
    ++count;
    EXPECT_TRUE(m.signal == study::Signal::current_magnitude ||
                (m.metric == study::MetricKind::largest_error && m.level == 0.0))
        << m.label;
  };
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data / "scenarios")) {
    if (!entry.is_regular_file()) continue;
    const study::Scenario s =
        shipped(fs::relative(entry.path(), data / "scenarios").replace_extension().string());
    for (const study::Requirement& r : s.require) judge(r.measure);
    for (const study::Comparison& c : s.compare) judge(c.measure);
  }
  EXPECT_GE(count, 8);
}

/// The bound of the move: full torque up to the speed at which the back-EMF is equal to the bus voltage, and
/// full torque back to rest.
TEST(ShippedFiles, TheBoundOfTheMoveFollowsFromTheSheet) {
  const double angle = 1000 * base::pi / 180, K = 33.5e-3, J = 135e-7, torque = 0.78, top = 24 / K;
  ASSERT_GT(std::sqrt(angle * torque / J), top) << "it reaches the top speed";
  for (const char* name : {"thesis/7.5-position", "thesis/7.5-position-exact-design"})
    EXPECT_NEAR(shipped(name).compare[0].value, angle / top + top * J / torque, 1e-12) << name;
}

TEST(ShippedFiles, TheGallerySaysWhatItTeaches) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(data / "scenarios" / "gallery")) {
    const study::Scenario scenario = shipped("gallery/" + entry.path().stem().string());
    EXPECT_GE(scenario.notes.size(), 100u) << entry.path();
    EXPECT_NE(scenario.title.find(':'), std::string::npos)
        << entry.path() << ": what it is, then what it shows";
    ++count;
  }
  EXPECT_GE(count, 12);
}

TEST(ShippedFiles, ReferenceCasesHaveTheirTrajectory) {
  for (const fs::directory_entry& entry : fs::directory_iterator(data / "scenarios" / "reference")) {
    const fs::path csv = fs::path(SIXSTEP_SOURCE_DIR) / "tests" / "reference" / entry.path().filename();
    EXPECT_TRUE(fs::exists(fs::path(csv).replace_extension(".csv"))) << csv;
  }
}

TEST(ShippedFiles, TheReferenceMotorSaysValueFrameAndSource) {
  const base::Result<design::Sheet> sheet =
      files::read_sheet((data / "motors" / "maxon-251601.toml").string());
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->pole_pairs, 8);
  EXPECT_EQ(sheet->resistance_ohm->value, 1.03);
  EXPECT_EQ(sheet->resistance_ohm->frame, "terminal");
  EXPECT_EQ(sheet->inductance_mH->value, 0.572);
  EXPECT_EQ(sheet->torque_constant_mNm_A->value, 33.5);
  EXPECT_EQ(sheet->torque_constant_mNm_A->frame, "terminal");
  EXPECT_EQ(sheet->inertia_gcm2->value, 135.0);
  EXPECT_EQ(sheet->viscous_friction_Nm_s->value, 7.3e-6);
  EXPECT_EQ(sheet->viscous_friction_Nm_s->source, "thesis");
}

TEST(ShippedFiles, TheMotorIsCompiledIn) {
  EXPECT_THAT(built_in_motors(), Contains("maxon-251601"));
  EXPECT_TRUE(files::read_sheet("maxon-251601"));
}

TEST(ShippedFiles, AnOverriddenConstantDropsTheOneItContradicts) {
  const study::Scenario sine = shipped("reference/R11");
  EXPECT_FALSE(sine.sheet.torque_constant_mNm_A);
  ASSERT_TRUE(sine.sheet.back_emf_mV_s);
  EXPECT_EQ(sine.sheet.back_emf_mV_s->value, 16.75);
  EXPECT_EQ(sine.sheet.back_emf_mV_s->frame, "phase");
  EXPECT_EQ(sine.sheet.back_emf, design::BackEmfShape::sine);
  EXPECT_EQ(sine.sheet.resistance_ohm->frame, "terminal");
}

TEST(ShippedFiles, AnOverrideKeepsTheFrameOfTheValueItReplaces) {
  const files::ReadOptions options{
      .overrides = {{"motor_override.resistance_ohm", "1.2"}, {"pwm.chopping", "hard"}}};
  const base::Result<study::Scenario> scenario =
      files::read_scenario((data / "scenarios" / "reference" / "R1.toml").string(), options);
  ASSERT_TRUE(scenario);
  EXPECT_EQ(scenario->sheet.resistance_ohm->value, 1.2);
  EXPECT_EQ(scenario->sheet.resistance_ohm->frame, "terminal");
  EXPECT_EQ(scenario->sheet.resistance_ohm->source, "motor_override");
  EXPECT_EQ(scenario->pwm.chopping, sixstep::control::Chopping::hard);
}

TEST(ShippedFiles, AReferenceCaseSaysWhatItsTableSays) {
  const study::Scenario r6 = shipped("reference/R6");
  EXPECT_EQ(r6.control.mode, sixstep::control::Mode::current);
  EXPECT_EQ(r6.control.current.d1, 4.5);
  EXPECT_EQ(r6.control.current.d0, -4.04);
  EXPECT_EQ(r6.reference.shape, study::Shape::square);
  EXPECT_EQ(r6.reference.high, 5.0);
  EXPECT_EQ(r6.reference.low, -5.0);
  EXPECT_EQ(r6.record.grid_s, 30e-6);
  EXPECT_THAT(r6.record.columns,
              ::testing::ElementsAre("i_a_A", "i_b_A", "i_c_A", "speed_rad_s", "angle_rad", "bus_V"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

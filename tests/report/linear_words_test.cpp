// SPDX-License-Identifier: Apache-2.0
// All outputs about a linear motor use the terms of linear motors.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/curve.hpp"
#include "batch/for_each.hpp"
#include "files/scenario_on_disk.hpp"
#include "report/curve_page.hpp"
#include "report/design_page.hpp"
#include "report/wiring_page.hpp"
#include "report/wiring_picture.hpp"
#include "sixstep/analysis/verify/first_scenario.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/linear.hpp"
#include "tests/support/wirings.hpp"
#include "text/results/curve_columns.hpp"
#include "text/results/curve_json.hpp"
#include "text/results/curve_table.hpp"
#include "text/results/design_json.hpp"
#include "text/results/design_text.hpp"
#include "text/results/json_summary.hpp"
#include "text/results/verdict_table.hpp"
#include "text/results/wiring_json.hpp"
#include "text/results/wiring_text.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/scenario/scenario_text.hpp"
#include "text/scenario/starter_scenario.hpp"

namespace report {
namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using sixstep::testing::turning_words;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Removes the scripts. They serve every motor, so the test checks only the page and the data that the
/// scripts draw.
std::string without_scripts(std::string page) {
  for (std::size_t at = page.find("<script"); at != page.npos; at = page.find("<script", at + 1)) {
    if (page.substr(at, 60).find("json") != page.npos) continue;
    page.erase(at, page.find("</script>", at) - at);
  }
  for (std::size_t at = page.find("<style"); at != page.npos; at = page.find("<style"))
    page.erase(at, page.find("</style>", at) - at + 8);
  return page;
}

/// The sheet is read from a file, because a page shows the values of a sheet under the keys of the file.
design::Sheet linear_sheet(bool thermal = true) {
  std::string file = R"(name = "m"
kind = "linear"
pole_pitch_mm = 8
nominal_voltage_V = 24
resistance_ohm = { value = 1.03, frame = "terminal" }
inductance_mH = { value = 0.572, frame = "terminal" }
force_constant_N_A = { value = 1.675, frame = "terminal" }
mass_kg = 0.03375
viscous_friction_N_s_m = 0.018
coulomb_friction_N = 0.05
stall_force_N = 39.0
nominal_current_A = { value = 2.33, frame = "terminal" }
nominal_force_N = 3.8
nominal_speed_m_s = 10.5
no_load_speed_m_s = 14.05
)";
  if (thermal)
    file += R"(thermal_resistance_winding_housing_K_W = 4.5
thermal_resistance_housing_ambient_K_W = 4.25
thermal_time_constant_winding_s = 16.6
thermal_time_constant_motor_s = 212
max_winding_temperature_degC = 125
)";
  const auto sheet = text::read_sheet("m", text::among({{"m.toml", file}}));
  EXPECT_TRUE(sheet) << base::to_string(sheet.problems()[0]);
  return *sheet;
}

TEST(LinearWords, OfWirings) {
  const analysis::WiringStudy s = sixstep::testing::made_up_wirings(linear_sheet());
  EXPECT_THAT(turning_words(text::wiring_text(s)), IsEmpty());
  EXPECT_THAT(turning_words(text::wiring_json(s)), IsEmpty());
  EXPECT_THAT(turning_words(without_scripts(wiring_picture(s, "0"))), IsEmpty());
  const std::string scenario = text::scenario_text(analysis::free_run(s.bench, s.subject, {}, 30));
  EXPECT_THAT(turning_words(without_scripts(render_wiring({s, scenario, "sixstep", "0"}))), IsEmpty());
  EXPECT_THAT(wiring_picture(s, "0"), HasSubstr("force over one electrical turn"));
}

TEST(LinearWords, OfACurve) {
  for (const bool thermal : {true, false}) {
    analysis::CurveRequest r{
        .sheet = linear_sheet(thermal), .bench = sixstep::testing::maxon_bench(), .points = 3};
    r.bench.motor = *design::motor_model(r.sheet);
    const auto curve = batch::torque_speed_curve(r, batch::on_threads(1));
    ASSERT_TRUE(curve) << base::to_string(curve.problems()[0]);
    const std::string table = text::curve_table(r, *curve), json = text::curve_json(r, *curve);
    const std::string page = render_curve({r, *curve, "sixstep curve m", "0"});
    EXPECT_THAT(turning_words(table), IsEmpty()) << table;
    EXPECT_THAT(turning_words(json), IsEmpty()) << json;
    EXPECT_THAT(turning_words(without_scripts(page)), IsEmpty()) << without_scripts(page);
    EXPECT_THAT(json, ::testing::Not(HasSubstr("rad_s")));
    for (const char* word : {"m/s", "force", " N"}) EXPECT_THAT(table, HasSubstr(word));
    for (const char* name : {"\"stall_force_N\"", "\"speed_m_s\"", "\"slope_N_s_m\""})
      EXPECT_THAT(json, HasSubstr(name));
    EXPECT_THAT(page, HasSubstr("Force-speed curve"));
  }
  for (const text::CurveColumn& c : text::curve_columns({true})) {
    EXPECT_THAT(turning_words(c.column.name + " " + c.column.unit + " " + c.column.meaning), IsEmpty());
    EXPECT_EQ(c.column.name.find("rad_s"), std::string::npos) << c.column.name;
  }
}

TEST(LinearWords, OfADesign) {
  using control::Mode;
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    const auto s = analysis::study_design({.subject = {"m", linear_sheet(), {}},
                                           .spec =
                                               [&] {
                                                 design::DesignSpec spec = design::on_a_board();
                                                 spec.mode = mode;
                                                 return spec;
                                               }(),
                                           .tolerances = analysis::sheet_tolerances(linear_sheet(), mode)});
    ASSERT_TRUE(s) << base::to_string(s.problems()[0]);
    const std::string text = text::design_text(*s, false), json = text::design_json(*s);
    const std::string scenario = text::scenario_text(s->scenario, text::design_lines(*s));
    const std::string page = render_design({*s, text::design_verdict(*s), scenario, "sixstep design", "0"});
    EXPECT_THAT(turning_words(text), IsEmpty()) << text;
    EXPECT_THAT(turning_words(json), IsEmpty()) << json;
    EXPECT_THAT(turning_words(scenario), IsEmpty()) << scenario;
    EXPECT_THAT(turning_words(without_scripts(page)), IsEmpty()) << page;
    EXPECT_THAT(text, HasSubstr("K_f"));
    EXPECT_THAT(json, HasSubstr("\"mass_kg\""));
  }
}

TEST(LinearWords, OfARun) {
  const auto folder = std::filesystem::path(SIXSTEP_SOURCE_DIR) / "data/scenarios/gallery";
  const auto scenario = files::read_scenario((folder / "linear-motor.toml").string());
  ASSERT_TRUE(scenario) << base::to_string(scenario.problems()[0]);
  const auto outcome = study::run(*scenario);
  ASSERT_TRUE(outcome);
  const text::TableEntry entry{"linear-motor", &*outcome};
  EXPECT_THAT(turning_words(text::verdict_table({&entry, 1}, false)), IsEmpty());
  const std::string json = text::json_summary(*scenario, *outcome);
  EXPECT_THAT(turning_words(json), IsEmpty()) << json;
  const auto columns = study::record_columns(*scenario);
  ASSERT_TRUE(columns);
  for (const study::Column& c : *columns)
    EXPECT_THAT(turning_words(c.name + " " + c.unit + " " + c.meaning), IsEmpty());
  study::Scenario without_notes = *scenario;
  without_notes.notes.clear();
  EXPECT_THAT(turning_words(text::scenario_text(without_notes, {})), IsEmpty());
}

TEST(LinearWords, OfAScenarioToStartFrom) {
  analysis::FirstScenarioSpec spec;
  spec.motor = "m";
  spec.sheet = linear_sheet();
  const auto s = analysis::first_scenario(spec);
  ASSERT_TRUE(s) << base::to_string(s.problems()[0]);
  const std::string text = text::starter_text(*s, {.file = "m.toml", .full = false});
  EXPECT_THAT(turning_words(text), IsEmpty()) << text;
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace report

// SPDX-License-Identifier: Apache-2.0
// Tests a motor file as a user types it: every spelling of a key, and every template filled in. Each error is
// reported once, with its position.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "files/scenario_on_disk.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/motor_template.hpp"
#include "text/toml/table_reader.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;

class MotorFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  base::Result<design::Sheet> read(const std::string& text) {
    std::ofstream(folder_ / "m.toml") << text;
    return files::read_sheet((folder_ / "m.toml").string());
  }
  std::vector<std::string> told(const std::string& text) {
    const base::Result<design::Sheet> sheet = read(text);
    std::vector<std::string> lines;
    if (!sheet)
      for (const base::Problem& problem : sheet.problems())
        lines.push_back(to_string(problem).substr(folder_.string().size() + 1));
    return lines;
  }
  std::filesystem::path folder_;
};

/// A complete sheet. `changed` replaces the line of its key, or is added as a new line.
std::string sheet_with(const std::string& changed) {
  std::map<std::string, std::string> lines = {
      {"name", "\"m\""},
      {"pole_pairs", "8"},
      {"nominal_voltage_V", "24"},
      {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
      {"inductance_mH", "{ value = 0.572, frame = \"terminal\" }"},
      {"torque_constant_mNm_A", "33.5"},
      {"inertia_gcm2", "135"},
  };
  std::string text;
  const std::string key = changed.substr(0, changed.find(' '));
  for (const auto& [k, v] : lines)
    if (k != key) text += fmt::format("{} = {}\n", k, v);
  return text + changed + "\n";
}

TEST_F(MotorFile, EachSlipIsOneClearErrorWithItsCure) {
  EXPECT_THAT(told(sheet_with("")), ElementsAre());
  EXPECT_THAT(told(sheet_with("winding = \"12N16P\"\npole_pairs = 16")).size(), 1u);
  const std::pair<std::string, const char*> slips[] = {
      {sheet_with("resistance_ohm = 1.03"),
       "m.toml:7:18: resistance_ohm = 1.03 must say its frame: \"terminal\" means R_s = 0.515 ohm, stall "
       "current 23.3 A; \"phase\" means R_s = 1.03 ohm, stall current 11.7 A; write frame = \"terminal\" or "
       "\"phase\""},
      {sheet_with("resistance_ohm = -1.03"),
       "m.toml:7:18: resistance_ohm = -1.03 must be above 0; it means: winding resistance, between two "
       "terminals or of one phase of the star, in ohm"},
      {sheet_with("inertia_gcm2 = 0"),
       "m.toml:7:16: inertia_gcm2 = 0 must be above 0; it means: moment of inertia of the rotor, in g cm2"},
      {sheet_with("resistance_kohm = 1.03"),
       "m.toml:8:1: resistance_kohm is not a key here; write the key as resistance_ohm and give the value in the key's unit: 1 kohm = 1000 ohm"},
      {sheet_with("torque_constant_Nm_Arms = 0.4"),
       "m.toml:8:1: torque_constant_Nm_Arms is not a key here; write the key as torque_constant_Nm_A and give the value in the key's unit, with a frame that is rms"},
      {sheet_with("poles = 15"),
       "m.toml:8:9: poles = 15 must be an even number from 2 on; magnet poles come in pairs of north and "
       "south; if the sheet counts pairs, write pole_pairs"},
      {"winding = \"12N14P\"\n" + sheet_with("pole_pairs = 14"),
       "m.toml:8:14: pole_pairs = 14 is the number of poles of winding = \"12N14P\"; write pole_pairs = 7"},
      {sheet_with("line_10_terminal_resistance_ohm = 1.03"),
       "m.toml:8:35: line_10_terminal_resistance_ohm = 1.03 is already given, as resistance_ohm; keep one of the two keys, which have the same meaning"},
      {sheet_with("back_emf_mV_s = 16"),
       "m.toml:8:17: back_emf_mV_s = 16 contradicts torque_constant_mNm_A, which means 16.75; remove one of the two keys"},
      {sheet_with("stall_current_A = { value = 23.3, range = [24, 25] }"),
       "m.toml:8:43: stall_current_A.range = [24, 25] does not contain the value, 23.3; write the least and the largest value of all sources, including this value"},
      {sheet_with("stall_current_A = { value = 23.3, range = [25, 24] }"),
       "m.toml:8:43: stall_current_A.range = [25, 24] is not in rising order; write range = [low, high]"},
      {sheet_with("inertia_gcm2 = { value = 135, kind = \"measurd\" }"),
       "m.toml:7:38: inertia_gcm2.kind = \"measurd\" must be \"sheet\", \"measured\" or \"derived\"; did you "
       "mean \"measured\"?"},
  };
  for (const auto& [text, message] : slips) EXPECT_THAT(told(text), ElementsAre(message));
}

TEST_F(MotorFile, AValueInAnotherSpellingIsToldAsItStands) {
  for (const char* written : {"117", "{ value = 117 }"})
    EXPECT_THAT(told(fmt::format("name = \"m\"\nresistance_mohm = {}\n", written)),
                ElementsAre("m.toml:2:19: resistance_mohm = 117 must say its frame: \"terminal\" means R_s = "
                            "0.0585 ohm; \"phase\" means R_s = 0.117 ohm; write frame = \"terminal\" or "
                            "\"phase\""));
  const auto scenario =
      files::read_scenario_text("x.toml",
                                "motor = \"tmotor-4004-300kv\"\nduration_s = 0.01\n[motor_override]\n"
                                "simulatable = true\nnot_simulatable_because = \"\"\n"
                                "inertia_kgm2 = 6e-6\ninertia_with_brake_kgm2 = 6e-7\n");
  ASSERT_FALSE(scenario);
  EXPECT_EQ(
      to_string(scenario.problems().front()),
      "x.toml:7:27: motor_override.inertia_with_brake_kgm2 = 6e-7 is less than the rotor's inertia, inertia_kgm2 = 6e-06; swap the two values: a brake adds inertia");
}

/// Visits a sheet and stores one quantity.
class Find final : public base::Visitor {
 public:
  explicit Find(std::string_view wanted) : wanted_(wanted) {}
  std::optional<base::Quantity> found;

 private:
  void visit_quantity(std::string_view key, const base::QuantityMember& member, const base::About&) override {
    if (const base::Quantity* q = quantity_in(member); q && key == wanted_) found = *q;
  }
  std::string_view wanted_;
};

TEST_F(MotorFile, EverySpellingIsTheKeyInItsUnit) {
  int count = 0;
  for (const KeyEntry& key : sheet_keys())
    for (const base::Spelling& spelling : key.about.also) {
      SCOPED_TRACE(spelling.key);
      if (key.type != KeyType::quantity) continue;  // a count: the test of the templates reads it
      base::Result<Document> document =
          Document::parse("m.toml", fmt::format("name = \"m\"\n{} = 2.50\n", spelling.key));
      ASSERT_TRUE(document);
      Complaints complaints(*document);
      design::Sheet sheet;
      read_root(*document, sheet, complaints);
      EXPECT_TRUE(complaints.empty()) << to_string(complaints.in_order().front());
      Find find(key.path);
      describe(find, sheet);
      ASSERT_TRUE(find.found);
      EXPECT_EQ(find.found->value, base::times_ten_to(2.5, spelling.ten) * spelling.factor);
      EXPECT_EQ(find.found->last_digit, base::times_ten_to(1.0, spelling.ten - 2) * spelling.factor);
      EXPECT_EQ(find.found->key, spelling.key);
      EXPECT_EQ(find.found->source, spelling.source);
      if (!spelling.frame.empty()) {
        EXPECT_EQ(find.found->frame, spelling.frame);
      }
      EXPECT_EQ(find_key(sheet_keys(), spelling.key) != nullptr, true);
      ++count;
    }
  EXPECT_GE(count, 35);
}

TEST_F(MotorFile, AnOverrideInAnotherSpellingOrWayReplacesTheSheets) {
  const auto model = [](const std::string& override) {
    const auto scenario = files::read_scenario_text(
        "x.toml", "motor = \"maxon-251601\"\nduration_s = 0.01\n[motor_override]\n" + override + "\n");
    if (!scenario) ADD_FAILURE() << to_string(scenario.problems().front());
    return *design::motor_model(scenario->sheet);
  };
  EXPECT_EQ(model("resistance_mohm = 900").machine.R_ohm, 0.45);  // the frame is that of the sheet
  EXPECT_EQ(model("inductance_uH = { value = 300, frame = \"phase\" }").machine.L_H, 3e-4);
  EXPECT_EQ(model("poles = 14").machine.pole_pairs, 7);
  const double flux = model("flux_linkage_mWb = 2\nback_emf = \"sine\"").machine.K_e_V_s;
  EXPECT_NEAR(flux, 8 * 2e-3, 1e-17);
}

/// The template after its open lines (`key = ` or `# key = `) have been filled in by key.
std::string filled(const std::string& text, const std::map<std::string, std::string>& values) {
  std::set<std::string> seen;
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); result += line + "\n") {
    const std::size_t start = line.starts_with("# ") ? 2 : 0;
    const auto open = values.find(line.substr(start, line.find(" = ", start) - start));
    if (open == values.end()) continue;
    line = open->first + " = " + open->second;
    seen.insert(open->first);
  }
  for (const auto& [key, value] : values) EXPECT_TRUE(seen.contains(key)) << key;
  return result;
}

TEST_F(MotorFile, AFreshTemplateAsksForEachNumber) {
  for (const std::string& style : template_styles()) {
    const auto text = motor_template(style, "mine");
    ASSERT_TRUE(text);
    const std::vector<std::string> lines = told(*text);
    EXPECT_GE(lines.size(), 4u) << style;
    for (const std::string& line : lines) EXPECT_THAT(line, ::testing::HasSubstr(" must ")) << style;
  }
  EXPECT_EQ(
      to_string(motor_template("servos", "x").problems().front()),
      "--style = servos is none of maxon, drone, servo, faulhaber, nanotec, portescap, hub, linear, firmware; choose the style whose sheet looks like yours");
}

TEST_F(MotorFile, TheTemplatesFilledInAreTheReferenceMotor) {
  // The 251601 as a sine machine, in the terms of each maker. K_e is K_t/1.65399 of the numbers below.
  const double K_e = 0.01675, K_t = 1.6539866862653762 * K_e;
  const std::map<std::string, std::map<std::string, std::string>> sheets = {
      {"maxon",
       {{"line_29_number_of_pole_pairs", "8"},
        {"line_1_nominal_voltage_V", "24"},
        {"line_10_terminal_resistance_ohm", "1.03"},
        {"line_11_terminal_inductance_mH", "0.572"},
        {"line_12_torque_constant_mNm_A", "33.5"},
        {"line_16_rotor_inertia_gcm2", "135"},
        {"line_2_no_load_speed_rpm", "6710"},
        {"line_3_no_load_current_mA", "185"}}},
      {"drone",
       {{"winding", "\"12N16P\""},
        {"nominal_voltage_V", "24"},
        {"speed_constant_rpm_V", fmt::format("{{ value = {}, frame = \"line-peak\" }}",
                                             9.549296585513721 / (K_e * 1.7320508075688772))},
        {"resistance_mohm", "{ value = 1030, frame = \"terminal\" }"},
        {"inductance_uH", "{ value = 572, frame = \"terminal\" }"},
        {"inertia_gcm2", "135"},
        {"idle_current_A", "0.185"},
        {"idle_voltage_V", "24"}}},
      {"servo",
       {{"poles", "16"},
        {"nominal_voltage_V", "24"},
        {"torque_constant_Nm_A", fmt::format("{{ value = {}, frame = \"rms\" }}", K_e * 2.1213203435596424)},
        {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
        {"inductance_mH", "{ value = 0.572, frame = \"terminal\" }"},
        {"inertia_kgcm2", "0.135"}}},
      {"faulhaber",
       {{"pole_pairs", "8"},
        {"nominal_voltage_V", "24"},
        {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
        {"inductance_uH", "{ value = 572, frame = \"terminal\" }"},
        {"torque_constant_mNm_A", fmt::format("{}", K_t * 1e3)},
        {"inertia_gcm2", "135"},
        {"coulomb_friction_mNm", "1"},
        {"viscous_friction_Nm_s", "\"4.3e-4 mNm/min-1\""},
        {"no_load_current_mA", "\"0.185 A\""},
        {"back_emf_constant_V_krpm",
         fmt::format("{{ value = \"{} mV/min-1\", frame = \"six-step\" }}", K_t * 1e3 / 9.549296585513721)},
        {"speed_constant_rpm_V",
         fmt::format("{{ value = \"{} min-1/V\", frame = \"six-step\" }}", 9.549296585513721 / K_t)}}},
      {"nanotec",
       {{"pole_pairs", "8"},
        {"nominal_voltage_V", "\"24 VDC\""},
        {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
        {"inductance_mH", "{ value = 0.572, frame = \"terminal\" }"},
        {"torque_constant_Nm_A", fmt::format("{{ value = \"{} Ncm/A\", frame = \"terminal\" }}", K_t * 1e2)},
        {"inertia_gcm2", "135"}}},
      {"portescap",
       {{"pole_pairs", "8"},
        {"nominal_voltage_V", "24"},
        {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
        {"inductance_mH", "{ value = 0.572, frame = \"terminal\" }"},
        {"torque_constant_mNm_A", fmt::format("{}", K_t * 1e3)},
        {"inertia_gcm2", "\"135 10^-7 kg m2\""},
        {"back_emf_constant_V_krpm", fmt::format("{{ value = \"{} V/1000 rpm\", frame = \"six-step\" }}",
                                                 K_t * 1e3 / 9.549296585513721)}}},
      {"hub",
       {{"poles", "16"},
        {"nominal_voltage_V", "24"},
        {"speed_constant_rpm_V",
         fmt::format("{{ value = {}, frame = \"six-step\" }}", 9.549296585513721 / K_t)},
        {"resistance_ohm", "{ value = 1.03, frame = \"terminal\" }"},
        {"inductance_mH", "{ value = 0.572, frame = \"terminal\" }"},
        {"inertia_kgm2", "1.35e-5"}}},
      {"firmware",
       {{"pole_pairs", "8"},
        {"resistance_ohm", "{ value = 0.515, frame = \"phase\" }"},
        {"inductance_uH", "{ value = 286, frame = \"phase\" }"},
        {"flux_linkage_mWb", fmt::format("{}", K_e / 8 * 1e3)},
        {"inertia_kgm2", "1.35e-5"}}}};
  for (const auto& [style, values] : sheets) {
    SCOPED_TRACE(style);
    const auto text = motor_template(style, "mine");
    ASSERT_TRUE(text);
    const base::Result<design::Sheet> sheet = read(filled(*text, values));
    if (!sheet) FAIL() << to_string(sheet.problems().front());
    const auto m = design::motor_model(*sheet);
    if (!m) FAIL() << to_string(m.problems().front());
    EXPECT_EQ(m->machine.pole_pairs, 8);
    EXPECT_EQ(m->machine.R_ohm, 0.515);
    EXPECT_EQ(m->machine.L_H, 0.286e-3);
    EXPECT_NEAR(m->machine.K_e_V_s, K_e, 4 * 0x1p-52);
    EXPECT_EQ(m->shaft.J_kg_m2, 1.35e-5);
    EXPECT_TRUE(design::check_sheet(*sheet)->consistent);
  }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

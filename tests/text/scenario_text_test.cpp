// SPDX-License-Identifier: Apache-2.0
// A scenario that is written and read again is the same scenario. The cases are every shipped scenario, and
// strings that TOML must escape.
#include "text/scenario/scenario_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "files/scenario_on_disk.hpp"
#include "sixstep/study/scenario/scenario_description.hpp"
#include "text/scenario/starter_scenario.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;

const fs::path data = fs::path(SIXSTEP_SOURCE_DIR) / "data";

study::Scenario read_back(const std::string& text) {
  base::Result<study::Scenario> result =
      files::read_scenario_text((data / "scenarios" / "written.toml").string(), text);
  if (result) return *result;
  for (const base::Problem& p : result.problems()) ADD_FAILURE() << to_string(p);
  return {};
}

/// Every described key of a scenario as text. The keys of the motor's sheet and the entries of tables and
/// lists are included.
class EveryKey final : public base::Visitor {
 public:
  std::vector<std::string> rows;

 private:
  void visit_value(std::string_view key, const base::ValueMember& member, const base::About&) override {
    std::visit([&](const auto* of) { row(key, *of); }, member);
  }
  template <class T>
  void row(std::string_view key, const T& member) {
    add(key, fmt::format("{}", member));
  }
  template <class T>
  void row(std::string_view key, const std::optional<T>& member) {
    if (member) row(key, *member);
  }
  template <class T>
  void row(std::string_view key, const std::vector<T>& member) {
    add(key, fmt::format("{}", fmt::join(member, ", ")));
  }
  void visit_word(std::string_view key, base::WordMember& member, const base::About&) override {
    add(key, std::string(member.word()));
  }
  void visit_quantity(std::string_view key, const base::QuantityMember& member, const base::About&) override {
    const base::Quantity* const q = quantity_in(member);
    if (!q) return;
    const base::Interval range = q->range.value_or(base::Interval{});
    add(key, fmt::format("{} {} {} {} {} {} {}", q->value, q->frame, q->source, static_cast<int>(q->kind),
                         range.low, range.high, q->last_digit.value_or(0)));
  }
  void visit_table(std::string_view key, base::TableMember& member, const base::About&) override {
    if (member.is_there()) within(key, [&] { member.walk(*this); });
  }
  void visit_list(std::string_view key, base::ListMember& items, const base::About&) override {
    for (std::size_t n = 0; n < items.size(); ++n) within(key, [&] { items.walk(n, *this); });
  }
  template <class Walk>
  void within(std::string_view key, const Walk& walk) {
    const std::string outer = path_;
    path_ += std::string(key) + ".";
    walk();
    path_ = outer;
  }
  void add(std::string_view key, const std::string& text) {
    rows.push_back(path_ + std::string(key) + " " + text);
  }
  std::string path_;
};

std::vector<std::string> every_key(study::Scenario s) {
  EveryKey keys;
  describe(keys, s);
  return keys.rows;
}

/// Removes the names of other files, because the written text contains the values from these files.
void detach(study::Scenario& s) {
  const auto leave = [](study::Reference& r) {
    r.file.clear();
    r.column.reset();
  };
  leave(s.reference);
  for (study::At& at : s.at)
    if (at.reference) leave(*at.reference);
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
    study::Scenario alone = *scenario;
    alone.extends.clear();
    detach(alone);
    EXPECT_EQ(every_key(read_back(text)), every_key(alone));
    for (const bool full : {false, true})  // the explained text defines the same scenario
      EXPECT_EQ(scenario_text(read_back(starter_text(*scenario, {.file = "x.toml", .full = full}))), text);
    ++count;
  }
  EXPECT_GE(count, 30);
}

study::Scenario with(const std::string& more) {
  return read_back("motor = \"maxon-251601\"\nduration_s = 0.1\n" + more);
}

TEST(ScenarioText, WritesWhatOverridesTheMotorsSheet) {
  const char* overrides[] = {
      "motor_override.resistance_ohm = { value = 0.50, frame = \"phase\", source = \"a meter\", kind = \"measured\" }",
      "motor_override.resistance_ohm = { value = 1.20, frame = \"terminal\", range = [1.1, 1.3] }",
      "motor_override = { line_16_rotor_inertia_gcm2 = 140.0, flat_deg = 100 }",
      "motor_override = { back_emf = \"sine\", harmonic_orders = [3, 5], harmonic_sizes = [0.1, -0.05] }",
      "motor_override = { connection = \"delta\", mutual_inductance_mH = 0.01 }",
      "motor_override.phase_resistance_deviation = [0.1, -0.05, -0.05]",
      "motor_override = { d_axis_inductance_mH = 0.2, q_axis_inductance_mH = 0.3 }",  // replaces
                                                                                      // inductance_mH
      "motor_override = { cogging_orders = [48], cogging_mNm = [2], cogging_phase_deg = [30] }",
      "motor_override.back_emf_mV_s = 16.75",  // replaces the torque constant
      "motor_override.torque_constant_mNm_A = { value = 33.5, frame = \"terminal\", source = \"data sheet, line 12\" }",
      "motor_override = { name = \"another \\\"name\\\"\", winding = \"24N16P\", viscous_friction_Nm_s = 1e-5 }",
  };
  for (const char* text : overrides) {
    SCOPED_TRACE(text);
    const study::Scenario s = with(text);
    const std::string written = scenario_text(s);
    EXPECT_THAT(written, ::testing::HasSubstr("[motor_override]"));
    EXPECT_EQ(every_key(read_back(written)), every_key(s)) << written;
    for (const bool full : {false, true})
      EXPECT_EQ(every_key(read_back(starter_text(s, {.file = "x.toml", .full = full}))), every_key(s));
  }
  EXPECT_THAT(scenario_text(with("")), ::testing::Not(::testing::HasSubstr("motor_override")));
}

/// The default event of a Hall line is line 1 at low. A heading without keys is such an event.
TEST(ScenarioText, KeepsAnEventWhoseKeysAreAllTheUsualOnes) {
  const std::pair<const char*, const char*> events[] = {{"ideal", "[at.reference]"},
                                                        {"hall", "[at.sensors.hall_break]"},
                                                        {"absolute", "[at.sensors.bad_track]"},
                                                        {"encoder", "[at.sensors.encoder_line]"}};
  for (const auto& [rotor, event] : events) {
    SCOPED_TRACE(event);
    const study::Scenario s =
        with(fmt::format("control.mode = \"duty\"\nsensors.rotor = \"{}\"\npwm.commutation = \"sample\"\n"
                         "sensors.capture_Hz = 48e6\n[[at]]\ntime_s = 0.05\n{}\n",
                         rotor, event));
    ASSERT_EQ(s.at.size(), 1u);
    const std::vector<std::string> keys = every_key(s);
    EXPECT_EQ(every_key(read_back(scenario_text(s))), keys);
    for (const bool full : {false, true})
      EXPECT_EQ(every_key(read_back(starter_text(s, {.file = "x.toml", .full = full}))), keys);
  }
}

/// TOML reads 132 as a number. The option --set sensors.hall_lines=132 also passes a number.
TEST(ScenarioText, AWordOfDigitsNeedsNoQuotes) {
  const study::Scenario s = with("sensors = { hall_lines = 132, hall_inverted = 3 }");
  EXPECT_EQ(s.sensors.hall_lines, sixstep::rig::WireOrder::acb);
  EXPECT_EQ(s.sensors.hall_inverted, study::HallLines::line_3);
  EXPECT_THAT(scenario_text(s), ::testing::HasSubstr("hall_lines = \"132\""));
}

TEST(ScenarioText, WritesWhatDiffersFromTheDefaultsAlone) {
  study::Scenario s;
  s.motor = "maxon-251601";
  s.duration_s = 0.1;
  s.control.current.limit_A = 0.1 + 0.2;
  study::Requirement r;  // its metric is the default value, but must be written
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

TEST(ScenarioText, AListWithinATableStandsUnderIt) {
  study::Scenario s;
  s.control.own.number = {{"first", 1.5}, {"second", -2.0}};
  const std::string text = scenario_text(s);
  EXPECT_NE(
      text.find(
          "\n[[control.own.number]]\nname = \"first\"\nvalue = 1.5\n\n[[control.own.number]]\nname = \"second\"\nvalue = -2"),
      std::string::npos)
      << text;
}

TEST(ScenarioText, EscapesWhatAStringMayHold) {
  study::Scenario s;
  s.motor = "maxon-251601";
  s.duration_s = 0.1;
  s.title = "a \"quoted\" \\ back\nslash \x01 \x7f";
  EXPECT_EQ(read_back(scenario_text(s)).title, s.title);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

// SPDX-License-Identifier: Apache-2.0
// The files of a linear motor have terms of their own. A file for a linear motor with a term of a rotary
// motor is refused, and so is a rotary motor's file with a linear term.
#include <gmock/gmock.h>

#include "sixstep/design/sheet/parameters.hpp"
#include "text/motor/motor_template.hpp"
#include "text/motor/motor_text.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::HasSubstr;
using ::testing::Not;

base::Result<study::Scenario> read(const std::string& text, const std::string& motor = "example-linear") {
  return read_scenario_text("s.toml", "motor = \"" + motor + "\"\nduration_s = 0.01\n" + text, {});
}
std::string first(const base::Problems& problems) { return to_string(problems.at(0)); }
std::string told(const std::string& text, const std::string& motor = "example-linear") {
  const auto s = read(text, motor);
  return s ? std::string() : first(s.problems());
}

TEST(LinearMotorFile, FillsTheTurningMotorsMembers) {
  const auto sheet = read_sheet("example-linear");
  ASSERT_TRUE(sheet) << first(sheet.problems());
  const auto m = design::motor_model(*sheet);
  ASSERT_TRUE(m) << first(m.problems());
  EXPECT_NEAR(m->shaft.J_kg_m2, 0.03375, 1e-17);
  EXPECT_EQ(m->K_t_Nm_A, 1.675);
  EXPECT_EQ(m->shaft.B_Nm_s, 0.01825);
  EXPECT_NEAR(m->machine.pole_pairs, 400.0, 1e-10);  // 8 pole pairs in 2 pi 20 mm
  EXPECT_NEAR(m->no_load_speed_rad_s, 14.05, 1e-12);
  EXPECT_NEAR(m->stall_torque_Nm, 39.0, 1e-12);
}

TEST(LinearMotorFile, IsShownInItsOwnUnits) {
  const auto sheet = read_sheet("m", among({{"m.toml", R"(name = "m"
kind = "linear"
pole_pitch_mm = 7.854
nominal_voltage_V = 24
resistance_ohm = { value = 1.03, frame = "terminal" }
inductance_mH = { value = 0.572, frame = "terminal" }
force_constant_N_A = { value = 1.675, frame = "terminal" }
mass_kg = 0.03375
viscous_friction_N_s_m = 0.01825
coulomb_friction_N = 0.05
stall_force_N = 39.0
no_load_speed_m_s = 14.05
no_load_current_mA = 185
)"}}));
  ASSERT_TRUE(sheet) << first(sheet.problems());
  const auto check = design::check_sheet(*sheet);
  ASSERT_TRUE(check) << first(check.problems());
  const std::string shown = sheet_table(*sheet) + check_report(*sheet, *check);
  for (const char* words :
       {"1.675 N/A", "0.03375 kg", "14.05 m/s", "7.854 mm", "K_f", "N s/m", "stall force"})
    EXPECT_THAT(shown, HasSubstr(words));
  for (const char* words : {"mNm", "rpm", "g cm2", "rad/s", "torque"})
    EXPECT_THAT(shown, Not(HasSubstr(words)));
  EXPECT_TRUE(check->consistent) << shown;
  const std::string json = motor_json(*sheet, *check);
  EXPECT_THAT(json, HasSubstr("\"K_f_N_A\""));
  EXPECT_THAT(json, HasSubstr("\"mass_kg\""));
  EXPECT_THAT(json, Not(HasSubstr("g cm2")));
}

TEST(LinearMotorFile, AScenarioSpeaksOfForceMassAndMetres) {
  const auto s = read(
      "[control]\nmode = \"position\"\nposition.gain_m_s_per_mm = 0.05\nspeed.force_limit_N = 10\n"
      "[reference]\nvalue = 90\n[load]\nforce_N = 3\nmass_kg = 0.5\nforces_N = []\n"
      "[initial]\nspeed_m_s = 0.5\nposition_mm = 12.5\n");
  ASSERT_TRUE(s) << first(s.problems());
  EXPECT_EQ(s->load.torque_Nm, 3.0);
  EXPECT_EQ(s->load.inertia_kg_m2, 0.5);
  EXPECT_EQ(s->initial.speed_rad_s, 0.5);
  EXPECT_EQ(s->initial.angle_rad, 12.5e-3);
  EXPECT_NEAR(s->reference.value * sixstep::base::pi / 180, 0.09, 1e-16);
  EXPECT_NEAR(s->control.position.gain_rad_s_per_deg * 180 / sixstep::base::pi, 50.0, 1e-12)
      << "0.05 m/s per mm";
  EXPECT_EQ(*s->control.speed.torque_limit_Nm, 10.0);
}

TEST(LinearMotorFile, IsWrittenAsItIsRead) {
  const auto s = read(
      "[control]\nmode = \"position\"\nposition.gain_m_s_per_mm = 0.05\nspeed.force_limit_N = 10\n"
      "[reference]\nshape = \"steps\"\ntimes_s = [0, 0.005]\nvalues = [10, 33.3]\n[load]\nforce_N = 3\n"
      "[initial]\nposition_mm = 12.5\n[[require]]\nmetric = \"final\"\nsignal = \"position\"\nmax = 40\n");
  ASSERT_TRUE(s) << first(s.problems());
  const std::string text = scenario_text(*s);
  EXPECT_THAT(text, HasSubstr("force_N = 3"));
  EXPECT_THAT(text, HasSubstr("position_mm = 12.5"));
  EXPECT_THAT(text, HasSubstr("gain_m_s_per_mm = 0.05"));
  const auto again = read_scenario_text("again.toml", text, {});
  ASSERT_TRUE(again) << first(again.problems()) << text;
  EXPECT_EQ(again->initial.angle_rad, s->initial.angle_rad);
  EXPECT_EQ(again->control.position.gain_rad_s_per_deg, s->control.position.gain_rad_s_per_deg);
  EXPECT_EQ(again->reference.values, s->reference.values);
  EXPECT_EQ(again->require[0].max, s->require[0].max);
}

TEST(LinearMotorFile, ItsSheetIsWrittenAsItIsRead) {
  const auto s = read("[motor_override]\nforce_constant_N_A = 31.5\nmass_kg = 1.25\n");
  ASSERT_TRUE(s) << first(s.problems());
  EXPECT_THAT(scenario_text(*s), HasSubstr("force_constant_N_A = { value = 31.5"));
  const auto again = read_scenario_text("again.toml", scenario_text(*s), {});
  ASSERT_TRUE(again) << first(again.problems());
  EXPECT_EQ(sheet_text(again->sheet), sheet_text(s->sheet));
  const Resolve own = [&](const Naming&) {
    return base::Result<NamedText>(NamedText{"motor.toml", sheet_text(s->sheet), {}});
  };
  const auto motor = read_sheet("motor.toml", own);
  ASSERT_TRUE(motor) << first(motor.problems());
  EXPECT_EQ(sheet_text(*motor), sheet_text(s->sheet));
}

TEST(LinearMotorFile, UnitsAreOfTheMotorsKind) {
  EXPECT_EQ(
      told("[control]\nmode = \"speed\"\nspeed.force_limit_N = 10\n[reference]\nvalue = \"150 mm/s\"\n"), "");
  EXPECT_THAT(
      told("[control]\nmode = \"speed\"\nspeed.force_limit_N = 10\n[reference]\nvalue = \"150 rpm\"\n"),
      HasSubstr("cannot be converted to m/s"));
  EXPECT_THAT(told("load.mass_kg = \"200 g\"\n"), "");
}

TEST(LinearMotorFile, TheOtherKindsWordsAreRefused) {
  EXPECT_THAT(
      told("load.torque_Nm = 3\n"),
      HasSubstr(
          "s.toml:3:18: load.torque_Nm = 3 applies to rotary motors only, and this motor is linear; write force_N"));
  EXPECT_THAT(
      told("load.force_N = 3\n", "maxon-251601"),
      HasSubstr("load.force_N = 3 applies to linear motors only, and this motor is rotary; write torque_Nm"));
  EXPECT_THAT(told("[[at]]\ntime_s = 0.005\nload.torque_Nm = 3\n"), HasSubstr("write force_N"));
  EXPECT_THAT(told("motor_override.mass_kg = 3\n", "maxon-251601"), HasSubstr("write inertia_gcm2"));
}

TEST(LinearMotorFile, NamesItsSignalsItself) {
  const auto asked = [](const std::string& signal) {
    return "[[require]]\nmetric = \"max\"\nsignal = \"" + signal + "\"\nmax = 40\n";
  };
  const auto s = read(asked("force"));
  ASSERT_TRUE(s) << first(s.problems());
  EXPECT_EQ(s->require[0].measure.signal, study::Signal::torque);
  EXPECT_THAT(scenario_text(*s), HasSubstr("signal = \"force\""));
  EXPECT_EQ(told(asked("speed_m_s")) + told(asked("load_N")) + told(asked("position_m")), "");
  EXPECT_THAT(
      told(asked("torque")),
      HasSubstr(
          "s.toml:5:10: require.signal = \"torque\" applies to rotary motors only, and this motor is linear; write \"force\""));
  EXPECT_THAT(told(asked("load_Nm")), HasSubstr("write \"load_N\""));
  EXPECT_THAT(
      told(asked("force"), "maxon-251601"),
      HasSubstr(
          "require.signal = \"force\" applies to linear motors only, and this motor is rotary; write \"torque\""));
  EXPECT_THAT(told(asked("forse")), HasSubstr("did you mean \"force\"?"));
}

TEST(LinearMotorFile, SpreadsNameItsKeys) {
  const auto spread = [](const std::string& key, const std::string& width) {
    return "[[spread]]\nkey = \"" + key + "\"\n" + width + "\n";
  };
  const auto s =
      read(spread("motor_override.force_constant_N_A", "relative = 0.05") +
           spread("motor_override.mass_kg", "absolute = \"2 g\"") + spread("load.force_N", "absolute = 0.5"));
  ASSERT_TRUE(s) << first(s.problems());
  EXPECT_EQ(s->spread[1].key, "motor_override.inertia_gcm2");
  EXPECT_NEAR(*s->spread[1].absolute, 2e-3 * 1e7, 1e-9);
  const std::string text = scenario_text(*s);
  EXPECT_THAT(text, HasSubstr("key = \"motor_override.mass_kg\"\nabsolute = 0.002\n"));
  const auto again = read_scenario_text("again.toml", text, {});
  ASSERT_TRUE(again) << first(again.problems()) << text;
  EXPECT_EQ(again->spread[1].key, s->spread[1].key);
  EXPECT_THAT(told(spread("load.torque_Nm", "absolute = 0.5")), HasSubstr("write \"load.force_N\""));
  EXPECT_THAT(told(spread("load.force_N", "absolute = 0.5"), "maxon-251601"),
              HasSubstr("write \"load.torque_Nm\""));
}

TEST(LinearMotorFile, ATemplateFilledInReadsBackClean) {
  std::string text = *motor_template("linear", "mine");
  for (const char* words : {"torque", "inertia", "rpm", "mNm", "rad/s", "shaft"})
    EXPECT_THAT(text, Not(HasSubstr(words))) << text;
  const std::pair<std::string, std::string> values[] = {
      {"pole_pitch_mm", "24"},  {"nominal_voltage_V", "48"},  {"resistance_ohm", "2.1"},
      {"inductance_mH", "1.2"}, {"force_constant_N_A", "18"}, {"mass_kg", "0.6"},
  };
  for (const auto& [key, value] : values) {
    const std::size_t at = text.find("\n" + key + " = ");
    ASSERT_NE(at, text.npos) << key << text;
    const std::size_t end = text.find('#', at);
    const bool framed = text.substr(at, end - at).find("terminal") != text.npos;
    text.replace(
        at, std::min(end, text.find('\n', at + 1)) - at,
        "\n" + key + " = " + (framed ? "{ value = " + value + ", frame = \"terminal\" } " : value + " "));
  }
  const auto sheet = read_sheet("m", among({{"m.toml", text}}));
  ASSERT_TRUE(sheet) << first(sheet.problems()) << text;
  EXPECT_EQ(sheet->kind, design::MotorKind::linear);
  const auto m = design::motor_model(*sheet);
  ASSERT_TRUE(m) << first(m.problems());
  EXPECT_EQ(m->K_t_Nm_A, 18.0);
  EXPECT_NEAR(m->shaft.J_kg_m2, 0.6, 1e-16);
  EXPECT_TRUE(design::check_sheet(*sheet)->consistent);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

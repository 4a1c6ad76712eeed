// SPDX-License-Identifier: Apache-2.0
// The parameter files of five programs describe one motor, and all give the same model. Damaged files give no
// motor.
#include "text/motor/foreign_motor.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/foreign_keys.hpp"
#include "text/motor/foreign_words.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::HasSubstr;

// The motor has 7 pole pairs. R, L and the flux linkage are values of a phase.
constexpr double R = 0.0187, L_d = 2.02e-5, L_q = 2.44e-5, psi = 5.12e-3;
constexpr int pairs = 7;
const double K_e = pairs * psi;                            // peak of a phase per mechanical rad/s
const double KV = 30 / base::pi / (std::sqrt(3.0) * K_e);  // rpm per volt of peak between two terminals

std::string vesc(const std::string& more = "") {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MCConfiguration>\n    <motor_type>2</motor_type>\n"
      "    <foc_motor_l>{}</foc_motor_l>\n    <foc_motor_ld_lq_diff>{}</foc_motor_ld_lq_diff>\n"
      "    <foc_motor_r>{}</foc_motor_r>\n    <foc_motor_flux_linkage>{}</foc_motor_flux_linkage>\n"
      "    <si_motor_poles>{}</si_motor_poles>\n{}</MCConfiguration>\n",
      (L_d + L_q) / 2, L_q - L_d, R, psi, 2 * pairs, more);
}
/// The file of odrivetool's backup, with its nesting. The torque constant is per ampere of peak current.
std::string odrive() {
  return fmt::format(
      "{{\"axis0\": {{\"config\": {{\"startup\": false}}, \"motor\": {{\"config\": {{\"pole_pairs\": {}, \"phase_resistance\": {}, "
      "\"phase_inductance\": {}, \"torque_constant\": {}, \"current_lim\": 60.0}}}}}}, \"name\": \"a \\\"b\", \"l\": [1, 2]}}",
      pairs, R, L_d, 1.5 * K_e);
}
std::string moteus() {
  return fmt::format(
      "uuid.uuid.0 12\nmotor.poles {}\nmotor.resistance_ohm {}\nmotor.inductance_d_H {}\nmotor.inductance_q_H {}\nmotor.Kv {}\n",
      2 * pairs, R, L_d, L_q, KV);
}
std::string simple_foc(double resistance_ohm, double rpm_V) {
  return fmt::format(
      "#include <SimpleFOC.h>\n// BLDCMotor motor = BLDCMotor(11);\nBLDCMotor motor = BLDCMotor({}, {}f, {}, {}, {});\n",
      pairs, resistance_ohm, rpm_V, L_q, L_d);
}
std::string matlab(const std::string& more = "") {
  return fmt::format(
      "%% a motor\npmsm.p = {};   % pole pairs\npmsm.Rs = {}; %Ohm\npmsm.Ld = {};\npmsm.Lq = {};\npmsm.FluxPM = {};\n"
      "pmsm.Ke = {};\npmsm.J = 9e-5;\npmsm.B = 1.5e-5;\npmsm.I_rated = 40*sqrt(2);\ninverter.I_rated = 5;\n{}",
      pairs, R, L_d, L_q, psi, std::sqrt(3.0) * K_e * 1000 * 2 * base::pi / 60, more);
}

design::Sheet sheet_of(const std::string& file, const std::vector<std::string>& answers = {}) {
  const auto text = motor_of_foreign_file("a.file", file, "m", answers);
  EXPECT_TRUE(text) << to_string(text.problems()[0]);
  std::string toml = text ? *text : "";
  if (const std::size_t nan = toml.find("nan, source"); nan != std::string::npos)
    toml.replace(nan, 3, "9e-5");
  const auto sheet = read_sheet("m.toml", among({{"m.toml", toml}}));
  EXPECT_TRUE(sheet) << to_string(sheet.problems()[0]) << "\n" << toml;
  return sheet ? *sheet : design::Sheet();
}

design::MotorModel model_of(const std::string& file, const std::vector<std::string>& answers = {}) {
  const auto model = design::motor_model(sheet_of(file, answers));
  EXPECT_TRUE(model) << to_string(model.problems()[0]);
  return model ? *model : design::MotorModel();
}

std::string told(const std::string& file, const std::vector<std::string>& answers = {}) {
  const auto text = motor_of_foreign_file("a.file", file, "m", answers);
  return text ? "a motor" : to_string(text.problems()[0]);
}

TEST(ForeignMotor, OneMotorInFiveProgramsIsOneModel) {
  const std::map<std::string, std::pair<std::string, std::vector<std::string>>> files = {
      {"VESC Tool", {vesc(), {}}},
      {"ODrive", {odrive(), {}}},
      {"moteus", {moteus(), {}}},
      {"SimpleFOC, phase", {simple_foc(R, KV), {"resistance=phase", "kv=line-peak"}}},
      {"SimpleFOC, terminal",
       {simple_foc(2 * R, KV * std::sqrt(3.0) / 1.6539866862653763), {"kv=six-step", "resistance=terminal"}}},
      {"MATLAB", {matlab(), {}}},
  };
  for (const auto& [program, file] : files) {
    SCOPED_TRACE(program);
    const design::MotorModel model = model_of(file.first, file.second);
    EXPECT_EQ(model.machine.pole_pairs, pairs);
    EXPECT_NEAR(model.machine.R_ohm, R, 1e-9 * R);
    const double L = program == "ODrive" ? L_d : (L_d + L_q) / 2;  // an ODrive has one inductance
    EXPECT_NEAR(model.machine.L_H, L, 1e-9 * L);
    EXPECT_NEAR(model.K_e_V_s, K_e, 1e-9 * K_e);
    EXPECT_NEAR(model.shaft.J_kg_m2, 9e-5, 1e-13);
  }
}

TEST(ForeignMotor, TheAxesAndTheRatings) {
  const design::Sheet of_vesc = sheet_of(vesc());
  EXPECT_NEAR(of_vesc.d_axis_inductance_mH->value, 1e3 * L_d, 1e-11);
  EXPECT_NEAR(of_vesc.q_axis_inductance_mH->value, 1e3 * L_q, 1e-11);
  const design::Sheet of_matlab = sheet_of(matlab());
  EXPECT_NEAR(of_matlab.nominal_current_A->value, 40.0, 1e-7);  // rms of a peak of 40 sqrt 2
  EXPECT_EQ(of_matlab.nominal_current_A->frame, "rms");
  EXPECT_EQ(of_matlab.viscous_friction_Nm_s->value, 1.5e-5);
}

TEST(ForeignMotor, ValuesSayTheirSourceAndMissingOnesAreNan) {
  const auto text = motor_of_foreign_file("a.xml", vesc(), "m");
  ASSERT_TRUE(text);
  EXPECT_THAT(
      *text,
      HasSubstr(
          "resistance_ohm = { value = 0.0187, frame = \"phase\", source = \"VESC Tool: foc_motor_r\" }"));
  EXPECT_THAT(*text, HasSubstr("source = \"VESC Tool: foc_motor_l - foc_motor_ld_lq_diff/2\""));
  EXPECT_THAT(*text, HasSubstr("inertia_kgm2 = { value = nan"));
  EXPECT_FALSE(read_sheet("m.toml", among({{"m.toml", *text}}))) << "a file with nan is no motor yet";
  // Before a drive has measured a value, its file contains 0.
  const auto fresh =
      motor_of_foreign_file("a.cfg", "motor.poles 14\nmotor.resistance_ohm 0.0\nmotor.Kv 0\n", "m");
  ASSERT_TRUE(fresh);
  EXPECT_THAT(*fresh, HasSubstr("resistance_ohm = { value = nan, frame = \"terminal|phase\""));
  EXPECT_THAT(*fresh, HasSubstr("flux_linkage_mWb = { value = nan"));
}

TEST(ForeignMotor, AsksWhatAProgramLeavesOpen) {
  EXPECT_THAT(
      told(simple_foc(R, KV)),
      HasSubstr(
          "a.file:3: R = 0.0187f has two possible meanings: the constructor's comment states a phase, the library's page "
          "on testing parameters states phase to phase; answer resistance=phase (R_s = 0.0187 ohm) or resistance=terminal (R_s = 0.00935 ohm)"));
  EXPECT_THAT(told(simple_foc(R, KV), {"resistance=phase"}),
              HasSubstr("answer kv=line-peak (K_e = 35.84 mV s) or kv=six-step"));
  EXPECT_THAT(told(simple_foc(R, KV), {"resistance=both", "kv=line-peak"}),
              HasSubstr("has two possible meanings"));
  EXPECT_THAT(told(vesc(), {"kv=six-step"}),
              HasSubstr("answer = kv=six-step names no question about a.file"));
  const auto text =
      motor_of_foreign_file("a.ino", simple_foc(R, 150), "m", {"resistance=phase", "kv=six-step"});
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("# speed_constant_rpm_V = { value = 150, frame = \"line-peak\""))
      << "the other meaning is a comment";
  const std::string two = "pmsm.Rs = 1;\npmsm.FluxPM = 0.01;\nbldc.Rs = 2;\n";
  EXPECT_THAT(told(two), HasSubstr("has 2 motors; answer motor=pmsm or motor=bldc"));
  EXPECT_EQ(told(two, {"motor=bldc"}), "a motor");
  EXPECT_THAT(told(two, {"motor=acim"}), HasSubstr("has 2 motors"));
}

TEST(ForeignMotor, AnEncodersRatioContradictsThePoles) {
  const auto with_ratio = [](const char* mode) {
    return vesc(std::string("<foc_sensor_mode>") + mode +
                "</foc_sensor_mode><foc_encoder_ratio>10</foc_encoder_ratio>\n");
  };
  EXPECT_EQ(told(with_ratio("0")), "a motor") << "no encoder is in use";
  EXPECT_THAT(told(with_ratio("1")),
              HasSubstr("si_motor_poles gives 7 pole pairs and foc_encoder_ratio gives 10"));
  EXPECT_EQ(model_of(with_ratio("1"), {"pole_pairs=10"}).machine.pole_pairs, 10);
  EXPECT_EQ(model_of(with_ratio("1"), {"pole_pairs=7"}).machine.pole_pairs, 7);
}

/// Replaces a text once. The test fails if the text is missing.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(ForeignMotor, HostileFilesAreNoMotor) {
  // The file is cut off.
  EXPECT_THAT(told(vesc().substr(0, 240)),
              HasSubstr("a.file ends before its last element, </MCConfiguration>,"));
  EXPECT_THAT(told(vesc().substr(0, vesc().size() - 3)), HasSubstr("ends before its last bracket"));
  EXPECT_THAT(told(odrive().substr(0, 150)), HasSubstr("the file is cut off or damaged"));
  EXPECT_THAT(told("BLDCMotor motor = BLDCMotor(7, 0.1"), HasSubstr("ends before its last bracket"));
  EXPECT_THAT(told("{\"phase_resistance\": 1}}"), HasSubstr("has a JSON error in line 1 on"));
  EXPECT_THAT(told("{\n\"phase_resistance\" 1}"), HasSubstr("has a JSON error in line 2 on"));
  EXPECT_THAT(told(std::string(100'000, '{') + "\"phase_resistance\""),
              HasSubstr("ends before its last bracket"));
  // The value is not a number, or a number that no motor has.
  for (const char* value : {"nan", "-0.02", "inf", "1e999", "ohm", "0.0187 ohm", ""})
    EXPECT_THAT(
        told(with(moteus(), "motor.resistance_ohm 0.0187", std::string("motor.resistance_ohm ") + value)),
        testing::AnyOf(HasSubstr("motor.resistance_ohm ="), HasSubstr("a motor")))
        << value;
  EXPECT_THAT(told(with(moteus(), "ohm 0.0187", "ohm nan")),
              HasSubstr("a.file:3: motor.resistance_ohm = nan must be a number above 0"));
  EXPECT_THAT(told(with(vesc(), ">0.0187<", ">1e30<")),
              HasSubstr("foc_motor_r = 1e30 becomes resistance_ohm = 1e+30, which must"));
  EXPECT_THAT(told(with(vesc(), ">14<", ">13<")), HasSubstr("si_motor_poles = 13 is an odd number of poles"));
  EXPECT_THAT(told(with(odrive(), "\"pole_pairs\": 7", "\"pole_pairs\": 7.5")),
              HasSubstr("must be a whole number"));
  EXPECT_THAT(told(with(vesc(), "<foc_motor_ld_lq_diff>4", "<foc_motor_ld_lq_diff>9000")),
              HasSubstr("must be below twice foc_motor_l"));
  // The value is in another unit: microhenries or milliohms.
  EXPECT_THAT(told(with(odrive(), "2.02e-05", "20.2")),
              HasSubstr("a time constant L/R of 1.08e+03 s, and no motor has this time constant"));
  // The file contains no value of a motor, is binary, or is the file of another program.
  EXPECT_THAT(
      told("<MCConfiguration>\n<l_current_max>60</l_current_max>\n</MCConfiguration>"),
      HasSubstr(
          "contains no known value of a motor: the values of VESC Tool are si_motor_poles, foc_motor_r"));
  EXPECT_THAT(told(std::string("\x7f"
                               "ELF\0\1\2",
                               7)),
              HasSubstr("is not a known parameter file"));
  EXPECT_THAT(told(""), HasSubstr("is not a known parameter file"));
  EXPECT_THAT(told(std::string("<MCConfiguration>\0\xff\xfe", 20)), HasSubstr("ends before"));
}

TEST(ForeignMotor, AFormulaOfMatlabIsTakenWhereItIsAProduct) {
  EXPECT_EQ(foreign_number("1.16*sqrt(2)"), 1.16 * std::sqrt(2.0));
  EXPECT_EQ(foreign_number(" 60 / 2 / pi "), 60 / 2.0 / base::pi);
  EXPECT_EQ(foreign_number("0.039f"), 0.039);
  for (const char* no : {"", "1+2", "pmsm.Ke/2", "2*", "sqrt(x)", "1 2", "1e999", "1/0"})
    EXPECT_FALSE(foreign_number(no)) << no;
  const std::string by_formula = with(matlab(), fmt::format("pmsm.FluxPM = {};", psi),
                                      "pmsm.FluxPM = (pmsm.Ke)/(sqrt(3)*2*pi*1000*pmsm.p/60);");
  EXPECT_NEAR(model_of(by_formula).K_e_V_s, K_e, 1e-9 * K_e) << "the constant comes from Ke then";
}

TEST(ForeignMotor, SeveralStatementsOfMatlabInALineCount) {
  const std::string packed = fmt::format(
      "pmsm.p = {}; pmsm.Rs = {}, pmsm.Ld = {}; pmsm.Lq = {}; pmsm.FluxPM = {}; pmsm.x = [1; 2, 3]; pmsm.J = 9e-5;",
      pairs, R, L_d, L_q, psi);
  const design::Sheet sheet = sheet_of(packed);
  EXPECT_NEAR(sheet.d_axis_inductance_mH->value, 1e3 * L_d, 1e-11);
  EXPECT_NEAR(sheet.q_axis_inductance_mH->value, 1e3 * L_q, 1e-11);
  EXPECT_NEAR(sheet.resistance_ohm->value, R, 1e-12);
  EXPECT_NEAR(model_of(packed).K_e_V_s, K_e, 1e-9 * K_e);
}

TEST(ForeignMotor, ASketchMaySetTheMotorsMembers) {
  const std::vector<std::string> answers{"resistance=phase"};
  const std::string braces = fmt::format(
      "BLDCMotor m{{{}}};\nvoid setup() {{\n  m.phase_resistance = {};\n  m.phase_inductance={};\n}}\n",
      pairs, R, L_q);
  const auto text = motor_of_foreign_file("a.ino", braces, "m", answers);
  ASSERT_TRUE(text) << to_string(text.problems()[0]);
  EXPECT_THAT(*text, HasSubstr(fmt::format("resistance_ohm = {{ value = {}, frame = \"phase\"", R)));
  EXPECT_THAT(*text, HasSubstr("inductance_uH = { value = 24.4"));
  EXPECT_THAT(told("class Own : public BLDCMotor { int pole_pairs = 7; };"),
              HasSubstr("contains no known value of a motor"));
}

TEST(ForeignMotor, WhatIsTakenForAnotherIsTold) {
  const auto one_axis = motor_of_foreign_file(
      "a.cfg", "motor.poles 14\nmotor.resistance_ohm 0.05\nmotor.inductance_d_H 2e-5\nmotor.v_per_hz 0.2\n",
      "m");
  ASSERT_TRUE(one_axis);
  EXPECT_THAT(*one_axis, HasSubstr("has only motor.inductance_d_H: taken for both axes"));
  EXPECT_THAT(*one_axis, HasSubstr("motor.v_per_hz is of a firmware before 0x010a"));
  const auto both = motor_of_foreign_file("a.cfg", moteus(), "m");
  EXPECT_THAT(*both, ::testing::Not(HasSubstr("taken for both")));
  EXPECT_THAT(*both, ::testing::Not(HasSubstr("v_per_hz")));
}

/// Every key of the table is a key of a motor file.
TEST(ForeignMotor, TheTableNamesKeysOfMotorFiles) {
  for (const ForeignKind kind : {ForeignKind::vesc, ForeignKind::odrive, ForeignKind::moteus,
                                 ForeignKind::simple_foc, ForeignKind::matlab})
    for (const ForeignKey& row : foreign_tool(kind).keys)
      EXPECT_NE(find_key(sheet_keys(), row.key), nullptr) << row.key;
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

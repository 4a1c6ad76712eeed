// SPDX-License-Identifier: Apache-2.0
// Sheets of several trades are typed as they are printed: electrical hertz, ounces, kilograms as weights, rms
// amperes, and the makers' names of the keys.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "sixstep/design/sheet/sheet_check.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::AnyOf;
using ::testing::HasSubstr;

/// Reads a motor file that is only in memory.
base::Result<design::Sheet> sheet_of(const std::string& text) {
  return read_sheet("m.toml", [&](const Naming&) -> base::Result<NamedText> {
    return NamedText{"m.toml", text};
  });
}

design::Sheet read(const std::string& text) {
  base::Result<design::Sheet> sheet = sheet_of(text);
  if (!sheet) ADD_FAILURE() << to_string(sheet.problems().front());
  return sheet ? std::move(*sheet) : design::Sheet{};
}

std::string told(const std::string& text) {
  const base::Result<design::Sheet> sheet = sheet_of(text);
  std::string all;
  if (!sheet)
    for (const base::Problem& problem : sheet.problems()) all += to_string(problem) + "\n";
  return all.empty() ? "accepted" : all;
}

constexpr const char* sine = "name = \"m\"\nback_emf = \"sine\"\n";

/// 6 V at 40 000 rpm with 2 pole pairs are 1333.3 electrical Hz and 4.5 mV/Hz.
TEST(PrintedUnits, VoltsPerHertzAreElectrical) {
  const design::Sheet s =
      read(std::string(sine) +
           "pole_pairs = 2\nspeed_constant_rpm_V = { value = 6667, frame = \"line-peak\" }\n"
           "back_emf_constant_V_krpm = { value = \"4.5 mV/Hz\", frame = \"line-peak\" }\n");
  EXPECT_NEAR(s.back_emf_constant_V_krpm->value, 6.0 / 40.0, 1e-16);
  EXPECT_DOUBLE_EQ(*s.back_emf_constant_V_krpm->last_digit, 0.1 / 30.0);
  const auto check = design::check_sheet(s);
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->consistent);
  EXPECT_NEAR(check->relations.at(0).deviation, 0.0, 1e-4);  // 6667 instead of 6666.7
  EXPECT_NEAR(check->constants.K_e_V_s->value, 6.0 / (40000.0 * M_PI / 30.0) / std::sqrt(3.0), 1e-18);
}

TEST(PrintedUnits, ElectricalUnitsWantPolePairsHoweverTheyAreCounted) {
  const std::string constant = "speed_constant_rpm_V = { value = \"222.2 Hz/V\", frame = \"line-peak\" }\n";
  for (const char* poles :
       {"pole_pairs = 2\n", "poles = 4\n", "winding = \"6N4P\"\n", "line_29_number_of_pole_pairs = 2\n"})
    EXPECT_NEAR(read(std::string(sine) + constant + poles).speed_constant_rpm_V->value, 222.2 * 30.0, 1e-11)
        << poles;
  EXPECT_THAT(
      told(std::string(sine) + constant),
      HasSubstr(
          "m.toml:3:34: speed_constant_rpm_V.value = \"222.2 Hz/V\" has the unit Hz/V, which counts electrical turns, and the pole pairs are not given; also give pole_pairs"));
}

TEST(PrintedUnits, HertzAndMinutesElsewhere) {
  const std::string motor = std::string(sine) + "pole_pairs = 2\n";
  EXPECT_NEAR(read(motor + "flux_linkage_mWb = \"4.5 mV/Hz\"\n").flux_linkage_mWb->value, 4.5 / (2.0 * M_PI),
              1e-15);
  EXPECT_NEAR(read(motor + "back_emf_constant_V_krpm = { value = \"4.5 V/kHz\", frame = \"line-peak\" }\n")
                  .back_emf_constant_V_krpm->value,
              0.15, 1e-16);
  EXPECT_NEAR(read(motor + "back_emf_mV_s = \"5 mWb\"\n").back_emf_mV_s->value, 10.0, 0.0);
  EXPECT_THAT(told(motor + "viscous_friction_Nm_s = \"1e-3 mNm/Hz\"\n"), HasSubstr("which may count turns"));
  EXPECT_THAT(told(motor + "back_emf_constant_V_krpm = { value = \"4.5 mV min\", frame = \"line-peak\" }\n"),
              HasSubstr("this unit contains minutes as a factor"));
  EXPECT_THAT(told(motor + "no_load_speed_rpm = \"300 1/s\"\n"), HasSubstr("cannot be converted to rpm"));
  EXPECT_NEAR(read(motor + "no_load_speed_rpm = \"6000 erpm\"\n").no_load_speed_rpm->value, 3000.0, 1e-12);
}

/// The sheet states 20 oz-in/Arms, 0.0018 oz-in-s2 and 2 oz-in. 1 oz-in is 7.0615518 mN m.
TEST(PrintedUnits, AnAmericanServo) {
  const design::Sheet s =
      read(std::string(sine) +
           "poles = 8\ntorque_constant_Nm_A = { value = \"20 oz-in/A\", frame = \"rms\" }\n"
           "inertia_gcm2 = \"0.0018 oz-in-s2\"\ncoulomb_friction_mNm = \"2 oz-in\"\n"
           "nominal_torque_mNm = \"10 lb-in\"\nstall_torque_mNm = \"3 lb-ft\"\n"
           "speed_torque_gradient_rpm_mNm = \"20 rpm/oz-in\"\n"
           "viscous_friction_Nm_s = \"0.5 oz-in/krpm\"\n"
           "thermal_resistance_housing_ambient_K_W = \"1.8 °C/W\"\n");
  EXPECT_NEAR(s.torque_constant_Nm_A->value, 0.141231036284520875, 1e-16);
  EXPECT_NEAR(s.inertia_gcm2->value, 127.107932656068787, 1e-13);
  EXPECT_NEAR(s.coulomb_friction_mNm->value, 14.1231036284520875, 1e-14);
  EXPECT_NEAR(s.nominal_torque_mNm->value, 1129.848290276167, 1e-12);
  EXPECT_NEAR(s.stall_torque_mNm->value, 4067.4538449942012, 1e-11);
  EXPECT_NEAR(s.speed_torque_gradient_rpm_mNm->value, 20 * 0.14161193266123495, 1e-15);
  EXPECT_NEAR(s.viscous_friction_Nm_s->value, 0.5 * 6.74328526280169754e-5, 1e-19);
  EXPECT_EQ(s.thermal_resistance_housing_ambient_K_W->value, 1.8);
  EXPECT_DOUBLE_EQ(*s.coulomb_friction_mNm->last_digit, 7.06155181422604375);
}

TEST(PrintedUnits, AModelMakersServo) {
  const design::Sheet s = read(std::string(sine) +
                               "pole_pairs = 2\nstall_torque_mNm = \"9.4 kg cm\"\n"
                               "nominal_torque_mNm = \"3 kgf·cm\"\n");
  EXPECT_NEAR(s.stall_torque_mNm->value, 9.4 * 98.0665, 1e-12);
  EXPECT_NEAR(s.nominal_torque_mNm->value, 3 * 98.0665, 1e-12);
}

TEST(PrintedUnits, RmsInAUnitIsTheFrame) {
  const std::string motor = std::string(sine) + "pole_pairs = 4\n";
  EXPECT_EQ(read(motor + "torque_constant_Nm_A = \"0.55 Nm/Arms\"\n").torque_constant_Nm_A->frame, "rms");
  EXPECT_EQ(read(motor + "nominal_current_A = \"3 Arms\"\n").nominal_current_A->frame, "rms");
  EXPECT_EQ(read(motor + "torque_constant_Nm_A = { value = \"0.55 Nm/Arms\", frame = \"rms\" }\n")
                .torque_constant_Nm_A->value,
            0.55);
  EXPECT_EQ(
      told(motor + "torque_constant_Nm_A = { value = \"0.55 Nm/Arms\", frame = \"terminal\" }\n"),
      "m.toml:4:34: torque_constant_Nm_A.value = \"0.55 Nm/Arms\" is rms, but the frame is \"terminal\"; write frame = \"rms\", or the unit without rms\n");
  EXPECT_THAT(told(motor + "back_emf_constant_V_krpm = \"40 Vrms/krpm\"\n"),
              HasSubstr("is rms, and the frame is missing; write frame = \"line-rms\" or \"phase-rms\""));
  EXPECT_EQ(
      read(motor + "back_emf_constant_V_krpm = { value = \"0.382 Vrms/(rad/s)\", frame = \"line-rms\" }\n")
          .back_emf_constant_V_krpm->frame,
      "line-rms");
  EXPECT_THAT(told(motor + "line_6_nominal_current_A = \"3 Arms\"\n"), HasSubstr("no rms value"));
  EXPECT_THAT(told(motor + "nominal_voltage_V = \"230 Vrms\"\n"), HasSubstr("no rms value"));
}

/// Faulhaber's k_E is k_M/9.5493, the mean over the step between two commutations.
TEST(PrintedUnits, AConstantOverACommutationStepIsConsistent) {
  const design::Sheet s =
      read(std::string(sine) +
           "pole_pairs = 2\ntorque_constant_mNm_A = 40.2\n"
           "back_emf_constant_V_krpm = { value = \"4.21 mV/min-1\", frame = \"six-step\" }\n");
  const auto check = design::check_sheet(s);
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->consistent);
  ASSERT_EQ(check->relations.size(), 1u);
  EXPECT_NEAR(check->relations[0].deviation, 40.2 / (4.21 * 9.549296585513721) - 1.0, 1e-14);
}

std::string scenario_told(const std::string& keys, double& speed_rad_s) {
  const auto s = read_scenario_text("x.toml", "motor = \"maxon-251601\"\nduration_s = 0.01\n" + keys);
  if (s) speed_rad_s = s->initial.speed_rad_s;
  return s ? "accepted" : to_string(s.problems().front());
}

TEST(PrintedUnits, AScenarioKnowsThePolePairsOfItsMotor) {
  double speed_rad_s = 0.0;
  EXPECT_EQ(scenario_told("initial.speed_rad_s = \"3000 erpm\"\n", speed_rad_s), "accepted");
  EXPECT_NEAR(speed_rad_s, 3000.0 / 8 * M_PI / 30, 1e-14);
  EXPECT_EQ(
      scenario_told("initial.speed_rad_s = \"3000 erpm\"\nmotor_override.pole_pairs = 4\n", speed_rad_s),
      "accepted");
  EXPECT_NEAR(speed_rad_s, 3000.0 / 4 * M_PI / 30, 1e-14);
  EXPECT_EQ(scenario_told("initial.speed_rad_s = \"10 turns/s\"\n", speed_rad_s), "accepted");
  EXPECT_NEAR(speed_rad_s, 20 * M_PI, 1e-14);
  EXPECT_THAT(scenario_told("initial.speed_rad_s = \"10 Hz\"\n", speed_rad_s),
              HasSubstr("which may count turns"));
  // The largest mechanical speed is 1e6 rad/s. The electrical speed is 8 times as large.
  EXPECT_THAT(scenario_told("initial.speed_rad_s = \"1e9 erpm\"\n", speed_rad_s),
              HasSubstr("must lie in -76394372.68410976 to 76394372.68410976, in erpm"));
}

/// Names in the sheets of makers, and the key that has the meaning of each name.
TEST(PrintedUnits, AMakersWordLeadsToTheKeyOfItsMeaning) {
  constexpr const char* words[][2] = {
      // Faulhaber
      {"number_of_pole_pairs", "pole_pairs"},
      {"terminal_resistance_ohm", "resistance_ohm with frame = \"terminal\""},
      {"terminal_inductance_uH", "inductance_uH with frame = \"terminal\""},
      {"back_emf_constant_mV_rpm",
       "back_emf_constant_V_krpm and give the value in the key's unit: 1 mV/rpm = 1 V/krpm"},
      {"rotor_inertia_gcm2", "inertia_gcm2"},
      {"no_load_current_A", "no_load_current_mA and give the value in the key's unit: 1 A = 1000 mA"},
      {"static_friction_mNm", "coulomb_friction_mNm"},
      {"C_0", "coulomb_friction_mNm"},
      {"C_V", "viscous_friction_Nm_s as \"4.3e-4 mNm/rpm\""},
      {"rth1_K_W", "thermal_resistance_winding_housing_K_W"},
      {"rth2_K_W", "thermal_resistance_housing_ambient_K_W"},
      {"tau_w1_s", "thermal_time_constant_winding_s"},
      {"tau_w2_s", "thermal_time_constant_motor_s"},
      {"operating_temperature_max_C", "max_winding_temperature_degC"},
      {"k_M", "torque_constant_mNm_A"},
      {"k_n", "speed_constant_rpm_V"},
      {"M_H", "stall_torque_mNm"},
      {"rated_torque_mNm", "nominal_torque_mNm"},
      // T-Motor
      {"KV", "speed_constant_rpm_V with frame"},
      {"KV_rpm_V", "speed_constant_rpm_V with frame"},
      {"internal_resistance_mohm", "resistance_mohm with the frame"},
      {"configuration", "winding as \"12N14P\""},
      {"idle_current_mA", "idle_current_A and give the value in the key's unit: 1 mA = 0.001 A"},
      // Portescap, Nanotec
      {"resistance_line_to_line_ohm", "resistance_ohm with frame = \"terminal\""},
      {"inductance_line_to_line_mH", "inductance_mH with frame = \"terminal\""},
      {"number_of_poles", "poles"},
      {"rated_current_A", "nominal_current_A with frame"},
      {"rated_voltage_V", "nominal_voltage_V"},
      {"max_continuous_torque_mNm", "nominal_torque_mNm"},
      {"max_coil_temperature_degC", "max_winding_temperature_degC"},
      // servo drives
      {"torque_constant_Nm_Arms",
       "torque_constant_Nm_A and give the value in the key's unit, with a frame that is rms"},
      {"nominal_current_Arms",
       "nominal_current_A and give the value in the key's unit, with a frame that is rms"},
      // maxon
      {"starting_current_A", "stall_current_A"},
      {"terminal_resistance_phase_to_phase_ohm", "resistance_ohm with frame = \"terminal\""},
      // VESC, ODrive, SimpleFOC
      {"foc_motor_r", "resistance_ohm with frame = \"phase\""},
      {"foc_motor_l_uH", "inductance_uH with frame = \"phase\""},
      {"foc_motor_flux_linkage_Wb", "flux_linkage_Wb"},
      {"si_motor_poles", "poles"},
      {"phase_resistance_mohm", "resistance_mohm with frame = \"phase\""},
      {"phase_inductance_uH", "inductance_uH with frame = \"phase\""},
      {"KV_rating", "speed_constant_rpm_V"},
      {"pp", "pole_pairs"},
  };
  for (const auto& [word, key] : words)
    EXPECT_THAT(told(fmt::format("name = \"m\"\n{} = 1\n", word)),
                AnyOf(HasSubstr(fmt::format("; write {}", key)),
                      HasSubstr(fmt::format("; write the key as {}", key))))
        << word;
}

TEST(PrintedUnits, AWordWithoutAKeyIsToldWhereItBelongs) {
  EXPECT_THAT(told("name = \"m\"\ngear_ratio = 10\n"), HasSubstr("write load.gear in the scenario"));
  EXPECT_THAT(told("name = \"m\"\npeak_current_A = 10\n"), HasSubstr("control.limits.current_A"));
  EXPECT_THAT(told("name = \"m\"\nresistnce_ohm = 10\n"), HasSubstr("did you mean resistance_ohm?"));
  double unused = 0.0;
  EXPECT_THAT(scenario_told("gear_ratio = 10\n", unused), ::testing::Not(HasSubstr("load.gear in")));
}

/// If a drive has identified the value, it is half of the value between two terminals. A branch of the delta
/// has 3/2 of the value between two terminals.
TEST(PrintedUnits, OfADeltaBothValuesThatAPhaseCanMeanAreNamed) {
  const std::string all = told(std::string(sine) +
                               "pole_pairs = 2\nconnection = \"delta\"\n"
                               "resistance_ohm = { value = 0.1, frame = \"phase\" }\nback_emf_mV_s = 5\n");
  EXPECT_THAT(all, HasSubstr("If a drive identified the value"));
  EXPECT_THAT(all, HasSubstr("if the value is of one branch of the delta, write 2/3 of the value"));
  EXPECT_THAT(all, HasSubstr("give back_emf_constant_V_krpm with frame = \"line-peak\""));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

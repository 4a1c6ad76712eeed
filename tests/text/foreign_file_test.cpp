// SPDX-License-Identifier: Apache-2.0
// Parameter files of other programs are recognised. The message states how to make a motor file from them.
#include "text/toml/foreign_file.hpp"

#include <gmock/gmock.h>

#include "text/motor/motor_library.hpp"
#include "text/scenario/scenario_file.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using ::testing::HasSubstr;

constexpr const char* vesc =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<MCConfiguration>\n    <l_current_max>60</l_current_max>\n"
    "    <foc_motor_l>2.23e-05</foc_motor_l>\n    <foc_motor_r>0.0187</foc_motor_r>\n"
    "    <foc_motor_flux_linkage>0.00512</foc_motor_flux_linkage>\n    <si_motor_poles>14</si_motor_poles>\n</MCConfiguration>\n";
constexpr const char* moteus =
    "motor.poles 14\nmotor.resistance_ohm 0.0468\nmotor.Kv 304.0\nservo.pid_dq.kp 0.05\n";
constexpr const char* odrive =
    "{\n  \"axis0.config.motor.pole_pairs\": 7,\n  \"axis0.config.motor.phase_resistance\": 0.039,\n"
    "  \"axis0.config.motor.phase_inductance\": 2.23e-05,\n  \"axis0.config.motor.torque_constant\": 0.03063\n}\n";
constexpr const char* simple_foc =
    "#include <SimpleFOC.h>\nBLDCMotor motor = BLDCMotor(7, 0.039f, 270, 0.0000223);\nvoid setup() {}\n";
constexpr const char* matlab =
    "pmsm.p = 7;\npmsm.Rs = 0.36;\npmsm.Ld = 0.2e-3;\npmsm.FluxPM = 0.0064;\npmsm.J = 7.06e-6;\n";

std::string told(const char* content) {
  const auto sheet = read_sheet("m.xml", among({{"m.xml", content}}));
  return sheet ? "a motor" : to_string(sheet.problems()[0]);
}

TEST(ForeignFile, SaysWhatItIsAndWhatMakesAMotorOfIt) {
  EXPECT_EQ(
      told(vesc),
      "m.xml:1:1: is a VESC motor configuration, but a TOML file is required; make a motor file from this file: sixstep motor new NAME "
      "--from m.xml");
  EXPECT_THAT(told(moteus), HasSubstr("is a moteus configuration, but a TOML file is required"));
  EXPECT_THAT(told(odrive), HasSubstr("is an ODrive configuration, but a TOML file is required"));
  EXPECT_THAT(told(simple_foc), HasSubstr("is a SimpleFOC sketch, but a TOML file is required"));
  EXPECT_THAT(told(matlab), HasSubstr("is a MATLAB struct of a motor, but a TOML file is required"));
}

TEST(ForeignFile, AsAScenarioToo) {
  const auto scenario = read_scenario_text("s.xml", vesc, {.overrides = {}, .resolve = among({})});
  ASSERT_FALSE(scenario);
  EXPECT_THAT(to_string(scenario.problems()[0]), HasSubstr("s.xml:1:1: is a VESC motor configuration"));
}

TEST(ForeignFile, OtherTextsStayWhatTheyAre) {
  for (const char* other : {"<html><p>Sign in</p></html>\n", "{ \"a\": 1 }\n", "motor.kind sine\n", "a = \n"})
    EXPECT_FALSE(foreign_file("m.toml", other)) << other;
  EXPECT_EQ(told("motor = \"pmsm.FluxPM\"\n").find("MATLAB"), std::string::npos) << "what is TOML is TOML";
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text

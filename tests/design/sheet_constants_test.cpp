// SPDX-License-Identifier: Apache-2.0
// Every printed form of a constant gives the same machine. A wrong sheet gives one message with the remedy.
#include "sixstep/design/sheet/sheet_constants.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using namespace sixstep::testing;
using base::Quantity;

constexpr double eps = 0x1p-52;

/// The sheet of a sine machine of the 251601's size, without a torque constant.
Sheet without_constant() {
  Sheet s = printed_251601();
  s.torque_constant_mNm_A.reset();
  s.speed_constant_rpm_V.reset();
  s.back_emf = BackEmfShape::sine;
  return s;
}

double K_e(const Sheet& s) {
  const SheetConstants c = sheet_constants(s);
  for (const base::Problem& p : c.problems) ADD_FAILURE() << to_string(p);
  return c.K_e_V_s ? c.K_e_V_s->value : 0.0;
}

TEST(SheetConstants, EachWayIsTheTableOfConstantsForASine) {
  Sheet s = without_constant();
  s.flux_linkage_mWb = Quantity{2.5, "", ""};
  EXPECT_NEAR(K_e(s), 8 * 2.5e-3, 4 * eps);  // p psi_f
  s = without_constant();
  s.speed_constant_rpm_V = Quantity{300, "line-peak", ""};
  EXPECT_NEAR(K_e(s), 9.549296585513721 / (300 * std::sqrt(3.0)), 4 * eps);
  s.speed_constant_rpm_V->frame = "six-step";  // computed from K_t = 9549/KV
  EXPECT_NEAR(K_e(s), 9.549296585513721 / 300 / 1.6539866862653762, 4 * eps);
  s = without_constant();
  s.torque_constant_Nm_A = Quantity{0.03, "peak", ""};
  EXPECT_NEAR(K_e(s), 2 * 0.03 / 3, 4 * eps);
  s.torque_constant_Nm_A->frame = "rms";
  EXPECT_NEAR(K_e(s), 0.03 / (1.5 * std::sqrt(2.0)), 4 * eps);  // K_t/2.1213
  s.torque_constant_Nm_A->frame = "terminal";
  EXPECT_NEAR(K_e(s), 0.03 / 1.6539866862653762, 4 * eps);
  s = without_constant();
  s.back_emf_constant_V_krpm = Quantity{2, "phase-peak", ""};
  const double per_rad_s = 2 / 104.71975511965977;
  EXPECT_NEAR(K_e(s), per_rad_s, 4 * eps);
  s.back_emf_constant_V_krpm->frame = "phase-rms";
  EXPECT_NEAR(K_e(s), per_rad_s * std::sqrt(2.0), 4 * eps);
  s.back_emf_constant_V_krpm->frame = "line-peak";
  EXPECT_NEAR(K_e(s), per_rad_s / std::sqrt(3.0), 4 * eps);
  s.back_emf_constant_V_krpm->frame = "line-rms";
  EXPECT_NEAR(K_e(s), per_rad_s * std::sqrt(2.0 / 3.0), 4 * eps);
}

TEST(SheetConstants, GeometryGivesTheTerminalTorqueConstant) {
  Sheet s = without_constant();
  s.back_emf = BackEmfShape::trapezoid;
  s.flux_density_T = Quantity{0.5, "", ""};
  s.active_length_mm = Quantity{10, "", ""};
  s.air_gap_radius_mm = Quantity{20, "", ""};
  EXPECT_EQ(
      told(s),
      "flux_density_T needs turns_in_series beside it; give all four values of K_t = 2 B l r N, or none");
  s.turns_in_series = 100;
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->K_t_Nm_A, 2 * 0.5 * 0.01 * 0.02 * 100, 4 * eps);  // thesis 1.1
  EXPECT_NEAR(m->machine.K_e_V_s, m->K_t_Nm_A / 2, eps);
}

TEST(SheetConstants, TheFirstWayIsUsedAndTheOthersAreKeptApart) {
  Sheet s = without_constant();
  s.speed_constant_rpm_V = Quantity{300, "line-peak", ""};
  s.flux_linkage_mWb = Quantity{2.5, "", ""};
  const SheetConstants c = sheet_constants(s);
  EXPECT_EQ(c.K_e_V_s->from, "flux_linkage_mWb, phase");
  ASSERT_EQ(c.other_ways.size(), 1u);
  EXPECT_EQ(c.other_ways[0].key, "speed_constant_rpm_V");
}

TEST(SheetConstants, AMissingFrameIsToldWithWhatEachWouldMean) {
  Sheet s = printed_251601();
  s.resistance_ohm->frame.clear();
  EXPECT_EQ(
      told(s).substr(0, told(s).find('\n')),
      "resistance_ohm = 1.03 must say its frame: \"terminal\" means R_s = 0.515 ohm, stall current 23.3 "
      "A; \"phase\" means R_s = 1.03 ohm, stall current 11.7 A; write frame = \"terminal\" or \"phase\"; "
      "the printed stall current, 23.3 A, fits \"terminal\"");
  const auto ends = [](const Sheet& sheet, const std::string& words) {
    const std::string line = told(sheet).substr(0, told(sheet).find('\n'));
    EXPECT_TRUE(line.ends_with(words)) << line;
  };
  s.stall_current_A->value = 24 / 1.03 / 2;
  ends(s, "fits \"phase\"");
  s.stall_current_A->value = 24 / 1.03 * 2;
  ends(s, "fits neither, which is U divided by half of the resistance");
  s.stall_current_A->value = 30;
  ends(s, "30 A, fits neither");
  s = printed_251601();
  s.inductance_mH->frame.clear();
  EXPECT_EQ(
      told(s),
      "inductance_mH = 0.572 must say its frame: \"terminal\" means L_s = 0.286 mH, time constant L/R = "
      "0.555 ms; \"phase\" means L_s = 0.572 mH, time constant L/R = 1.11 ms; write frame = "
      "\"terminal\" or \"phase\"");
  s.electrical_time_constant_ms = Quantity{1.11, "", ""};
  EXPECT_TRUE(told(s).ends_with("the printed electrical time constant, 1.11 ms, fits \"phase\"")) << told(s);
  s = without_constant();
  s.speed_constant_rpm_V = Quantity{920, "", ""};
  EXPECT_EQ(told(s),
            "speed_constant_rpm_V = 920 must say its frame: \"six-step\" means a terminal torque constant of "
            "10.38 mNm/A; \"line-peak\" means a terminal torque constant of 9.912 mNm/A; write frame = "
            "\"six-step\" or \"line-peak\"");
  s = printed_251601();
  s.nominal_current_A->frame.clear();
  EXPECT_EQ(
      told(s),
      "nominal_current_A = 2.33 must say its frame: \"terminal\" means 2.33 A of direct current in at one "
      "terminal and out at another, a nominal torque of 78.06 mNm; \"rms\" means a sine of 2.33 A rms in each "
      "phase, 3.295 A peak, a nominal torque of 100.7 mNm; write frame = \"terminal\" or \"rms\"");
}

/// If a sheet has no torque constant, the torque is unknown. The message then states the current instead.
TEST(SheetConstants, NominalCurrentSaysWhichAmperes) {
  Sheet s = without_constant();
  s.nominal_current_A = Quantity{10, "", ""};
  EXPECT_THAT(told(s),
              ::testing::HasSubstr("\"terminal\" means 10 A of direct current in at one terminal and out at "
                                   "another; \"rms\" means a sine of 10 A rms in each phase, 14.14 A peak;"));
}

/// Faulhaber prints k_M = 40.2 mNm/A and k_E = k_M/9.5493 = 4.21 mV/min-1. This k_E is the mean over a sector
/// between the driven terminals.
TEST(SheetConstants, ABackEmfOverASectorIsTheTorqueConstant) {
  for (const BackEmfShape shape : {BackEmfShape::sine, BackEmfShape::trapezoid}) {
    Sheet s = without_constant();
    s.back_emf = shape;
    s.back_emf_constant_V_krpm = Quantity{4.21, "six-step", ""};
    EXPECT_NEAR(sheet_constants(s).K_t_Nm_A->value, 4.21e-3 * 9.54929658551372015, 1e-15);
  }
}

TEST(SheetConstants, PolesPairsAndWindingsAreToldApart) {
  Sheet s = printed_251601();
  s.pole_pairs.reset();
  s.winding = "12N14P";
  EXPECT_EQ(sheet_constants(s).pole_pairs, 7);
  s.pole_pairs = 14;
  EXPECT_EQ(told(s), "pole_pairs = 14 is the number of poles of winding = \"12N14P\"; write pole_pairs = 7");
  s.pole_pairs = 8;
  EXPECT_EQ(
      told(s),
      "pole_pairs = 8 contradicts winding = \"12N14P\", which has 7 pole pairs; correct the key that is wrong");
  s.pole_pairs.reset();
  s.winding.clear();
  s.poles = 15;
  EXPECT_EQ(
      told(s),
      "poles = 15 must be an even number from 2 on; magnet poles come in pairs of north and south; if the "
      "sheet counts pairs, write pole_pairs");
  s.poles = 16;
  EXPECT_EQ(sheet_constants(s).pole_pairs, 8);
  s.poles.reset();
  for (const auto& [code, message] : {std::pair{"12N15P", "names 15 poles, an odd number"},
                                      {"14N12P", "names 14 teeth, not a multiple of 3"},
                                      {"12/14", "is not a winding code"},
                                      {"12N14", "is not a winding code"},
                                      {"", "pole_pairs is missing"}}) {
    s.winding = code;
    EXPECT_NE(told(s).find(message), std::string::npos) << told(s);
    EXPECT_EQ(told(s).find('\n'), std::string::npos) << told(s);
  }
  s.winding = "36n 42p";
  EXPECT_EQ(sheet_constants(s).pole_pairs, 21);
}

TEST(SheetConstants, ABadNumberIsOneClearError) {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    Sheet s = printed_251601();
    s.resistance_ohm->value = bad;
    const std::string limit = std::isfinite(bad) ? " must be above 0" : " must be a finite number";
    EXPECT_EQ(told(s), "resistance_ohm = " + base::written(bad) + limit +
                           "; give the value that the sheet prints, or remove this key");
    s = printed_251601();
    s.torque_constant_mNm_A->value = bad;
    EXPECT_EQ(told(s).find('\n'), std::string::npos) << told(s);
    s = printed_251601();
    s.inertia_gcm2->value = bad;
    EXPECT_EQ(told(s).find('\n'), std::string::npos) << told(s);
  }
}

TEST(SheetConstants, SaliencyAndBrakesAreAskedFor) {
  Sheet s = printed_251601();
  s.inductance_mH.reset();
  s.d_axis_inductance_mH = Quantity{0.031, "phase", ""};
  s.q_axis_inductance_mH = Quantity{0.044, "phase", ""};
  EXPECT_EQ(told(s), "");
  EXPECT_NEAR(sheet_constants(s).L_H->value, 37.5e-6, 1e-20) << "what design goes by: the mean";
  s.q_axis_inductance_mH->value = 0.031;
  EXPECT_EQ(sheet_constants(s).L_H->value, 31e-6);
  s.inductance_mH = Quantity{0.3, "phase", ""};
  EXPECT_EQ(
      told(s),
      "inductance_mH = 0.3 is given twice: L_d and L_q are also given; remove inductance_mH, or both axis inductances");
  s = printed_251601();
  s.inertia_with_brake_gcm2 = Quantity{150, "", ""};
  EXPECT_EQ(sheet_constants(s).J_kg_m2->value, 135e-7);
  s.with_brake = true;
  EXPECT_EQ(sheet_constants(s).J_kg_m2->value, 150e-7);
  s.inertia_with_brake_gcm2->value = 13.5;
  EXPECT_EQ(
      told(s),
      "inertia_with_brake_gcm2 = 13.5 is less than the rotor's inertia, inertia_gcm2 = 135; swap the two values: a brake adds inertia");
}

TEST(SheetConstants, FrictionLiesBetweenItsExtremesAndTwoPointsSplitIt) {
  Sheet s = printed_251601();
  const Friction one = sheet_constants(s).friction;
  const double w0 = 6710 * base::pi / 30, loss = 0.0335 * 0.185;
  EXPECT_NEAR(*one.all_viscous_Nm_s, loss / w0, 4 * eps * loss / w0);
  EXPECT_NEAR(*one.all_coulomb_Nm, loss, 4 * eps * loss);
  EXPECT_EQ(one.B_Nm_s, *one.all_viscous_Nm_s);  // by default all friction is viscous
  // A motor with the friction torque T = 3e-6 w + 2e-3 (speed w), and its no-load currents at two speeds.
  const double B = 3e-6, T_c = 2e-3, w[] = {200.0, 700.0};
  s.no_load_speed_rpm = Quantity{w[1] * 30 / base::pi, "", ""};
  s.no_load_current_mA = Quantity{(B * w[1] + T_c) / 0.0335 * 1e3, "", ""};
  s.second_no_load_speed_rpm = Quantity{w[0] * 30 / base::pi, "", ""};
  s.second_no_load_current_mA = Quantity{(B * w[0] + T_c) / 0.0335 * 1e3, "", ""};
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->shaft.B_Nm_s, B, 64 * eps * B);  // two subtractions of numbers of the same size
  EXPECT_NEAR(m->shaft.coulomb_Nm, T_c, 64 * eps * T_c);
  s.second_no_load_current_mA->value = 500;
  EXPECT_NE(told(s).find("gives, with the first point, a negative friction: B = -"), std::string::npos);
}

TEST(SheetConstants, AnIdleCurrentAtAVoltageIsANoLoadPoint) {
  Sheet s = printed_251601();
  s.no_load_speed_rpm.reset();
  s.no_load_voltage_V = Quantity{10, "", ""};
  const Friction f = sheet_constants(s).friction;
  const double w0 = (10 - 1.03 * 0.185) / 0.0335;  // the ideal line
  EXPECT_NEAR(f.no_load_speed_rad_s, w0, 4 * eps * w0);
  EXPECT_NEAR(f.B_Nm_s, 0.0335 * 0.185 / w0, 8 * eps * f.B_Nm_s);
}

TEST(SheetConstants, NotSimulatableMeansNoModelButAReason) {
  Sheet s = printed_251601();
  s.simulatable = false;
  EXPECT_EQ(told(s).substr(0, 40), "simulatable = false gives no reason; giv");
  s.not_simulatable_because = "no source gives its inertia";
  s.inertia_gcm2.reset();
  EXPECT_EQ(
      told(s),
      "simulatable = false because no source gives its inertia; choose another motor, or give the "
      "missing values in [motor_override] together with simulatable = true and not_simulatable_because = \"\"");
}

TEST(SheetConstants, StandardKeysMeanTheSameModel) {
  Sheet s = without_constant();
  s.flux_linkage_mWb = Quantity{2.5, "", ""};
  s.inductance_mH.reset();
  s.d_axis_inductance_mH = s.q_axis_inductance_mH = Quantity{0.286, "phase", ""};
  const Sheet standard = in_standard_keys(s);
  EXPECT_TRUE(standard.torque_constant_mNm_A && standard.inductance_mH && standard.viscous_friction_Nm_s);
  const auto a = motor_model(s), b = motor_model(standard);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->machine.K_e_V_s, b->machine.K_e_V_s, 4 * eps);
  EXPECT_NEAR(a->machine.L_H, b->machine.L_H, 4 * eps * 1e-3);
  EXPECT_EQ(a->shaft.B_Nm_s, b->shaft.B_Nm_s);
  // A value that is already under a standard key keeps its bits.
  const auto printed = motor_model(printed_251601()), again = motor_model(in_standard_keys(printed_251601()));
  EXPECT_EQ(printed->machine.K_e_V_s, again->machine.K_e_V_s);
  EXPECT_EQ(printed->machine.L_H, again->machine.L_H);
}

}  // namespace SIXSTEP_TEST_FILE

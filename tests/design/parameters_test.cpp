// SPDX-License-Identifier: Apache-2.0
// A data sheet is converted to a model. The tests check the bits of the reference motor's values, the sector
// means of the shapes, and sheets that are refused.
#include "sixstep/design/sheet/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/thesis/thesis_models.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;

constexpr double eps = 0x1p-52;

Sheet maxon() {
  Sheet s;
  s.name = "maxon EC 45 flat 251601";
  s.pole_pairs = 8;
  s.nominal_voltage_V = {24.0, "", ""};
  s.resistance_ohm = {1.03, "terminal", ""};
  s.inductance_mH = {0.572, "terminal", ""};
  s.torque_constant_mNm_A = base::Quantity{33.5, "terminal", ""};
  s.inertia_gcm2 = {135.0, "", ""};
  s.no_load_speed_rpm = base::Quantity{6710.0, "", ""};
  s.no_load_current_mA = base::Quantity{185.0, "", ""};
  return s;
}

std::string problems_of(const Sheet& sheet) {
  const auto m = motor_model(sheet);
  std::string text;
  if (!m)
    for (const base::Problem& p : m.problems()) text += to_string(p) + '\n';
  return text;
}

TEST(MotorModel, OfTheReferenceMotorHasTheNearestDoubles) {
  const auto m = motor_model(maxon());
  ASSERT_TRUE(m);
  EXPECT_EQ(m->machine.R_ohm, 0.515);
  EXPECT_EQ(m->machine.L_H, 0.286e-3);
  EXPECT_EQ(m->machine.K_e_V_s, 0.01675);
  EXPECT_EQ(m->machine.pole_pairs, 8);
  EXPECT_EQ(m->shaft.J_kg_m2, 1.35e-5);
  EXPECT_EQ(m->K_t_Nm_A, 0.0335);
  Sheet s = maxon();  // a number without a short decimal
  s.inertia_gcm2->value = 0.1 + 0.2;
  EXPECT_EQ(motor_model(s)->shaft.J_kg_m2, (0.1 + 0.2) / 1e7);
  EXPECT_EQ(m->no_load_current_A, 0.185);
  EXPECT_NEAR(m->no_load_speed_rad_s, 702.67, 0.005);
  EXPECT_NEAR(m->shaft.B_Nm_s, 8.82e-6, 0.005e-6);
  EXPECT_NEAR(m->stall_torque_Nm, 0.0335 * 24 / 1.03, 4 * eps);
}

TEST(MotorModel, PrintedValuesGoBeforeDerivedOnes) {
  Sheet s = maxon();
  s.viscous_friction_Nm_s = base::Quantity{7.3e-6, "", ""};
  s.stall_torque_mNm = base::Quantity{780.0, "", ""};
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->shaft.B_Nm_s, 7.3e-6);
  EXPECT_EQ(m->stall_torque_Nm, 0.78);
}

TEST(MotorModel, PhaseFrameIsTakenAsItIs) {
  Sheet s = maxon();
  s.resistance_ohm = {0.515, "phase", ""};
  s.inductance_mH = {0.286, "phase", ""};
  const auto m = motor_model(s), terminal = motor_model(maxon());
  ASSERT_TRUE(m && terminal);
  EXPECT_EQ(m->machine.R_ohm, terminal->machine.R_ohm);
  EXPECT_EQ(m->machine.L_H, terminal->machine.L_H);
}

TEST(MotorModel, TorquePerAmpereIsTheSectorMeanOfTheShape) {
  // An independent check by the shape itself: the midpoint rule over the first sector, with the pair a, b.
  // The rule is exact if the shape is piecewise linear and its ramps end on the grid. For other shapes, its
  // error is h^2/24 f'' (step h, second derivative f'').
  for (const double flat : {10.0, 60.0, 90.0, 119.0, 120.0, 121.0, 150.0, 179.0}) {
    Sheet s = maxon();
    s.flat_deg = flat;
    const auto m = motor_model(s);
    ASSERT_TRUE(m);
    double sum = 0.0;
    constexpr int points = 12000;
    for (int n = 0; n < points; ++n) {
      const double theta = base::sector_rad * (n + 0.5) / points;
      const base::Abc<double> f = back_emf_shape(m->machine, {theta});
      sum += m->machine.K_e_V_s * (f.a - f.b);
    }
    EXPECT_NEAR(sum / points / m->K_t_Nm_A, 1.0, 1e-12) << flat;
    if (flat >= 120.0) {
      EXPECT_EQ(m->machine.K_e_V_s, m->K_t_Nm_A / 2);
    }
  }
  Sheet s = maxon();
  s.back_emf = BackEmfShape::sine;
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->K_t_Nm_A / m->machine.K_e_V_s, 1.6539866862653762, 4 * eps);
}

TEST(MotorModel, BackEmfIsUsedAsItIs) {
  Sheet s = maxon();
  s.torque_constant_mNm_A.reset();
  s.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  s.back_emf = BackEmfShape::sine;
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->machine.K_e_V_s, 0.01675);
  EXPECT_NEAR(m->K_t_Nm_A, 0.01675 * 1.6539866862653762, 4 * eps);
}

TEST(MotorModel, CoulombFrictionTakesItsShareOfTheNoLoadLoss) {
  Sheet s = maxon();
  s.coulomb_friction_mNm = base::Quantity{2.46, "", ""};
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->shaft.coulomb_Nm, 2.46e-3);
  EXPECT_NEAR(m->shaft.coulomb_Nm + m->shaft.B_Nm_s * m->no_load_speed_rad_s, 0.0335 * 0.185, 4 * eps);
  s.coulomb_friction_mNm->value = 7.0;
  EXPECT_EQ(problems_of(s).substr(0, 66),
            "coulomb_friction_mNm = 7 exceeds the loss at no load, K_t I_0 = 6.");
  s.viscous_friction_Nm_s = base::Quantity{1e-6, "", ""};
  EXPECT_EQ(problems_of(s), "");
}

TEST(MotorModel, BothConstantsMustBeOneFact) {
  Sheet s = maxon();
  s.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  EXPECT_EQ(problems_of(s), "");
  s.back_emf_mV_s->value = 16.76;
  EXPECT_EQ(
      problems_of(s),
      "back_emf_mV_s = 16.76 contradicts torque_constant_mNm_A, which means 16.75; remove one of the two keys\n");
}

/// The values are in SI units, but under keys in mH and gcm2. A run of such a motor would not end.
TEST(MotorModel, AMotorTooFastToBeOneHasASlipInAUnit) {
  Sheet henry = maxon();
  henry.inductance_mH->value = 0.572e-3;
  EXPECT_EQ(
      problems_of(henry),
      "inductance_mH = 0.000572 gives the winding a time constant L/R of 555 ns, and no motor has less than 1000 ns; "
      "correct the unit of inductance or resistance\n");
  Sheet kilograms = maxon();
  kilograms.inertia_gcm2->value = 1.35e-5;
  EXPECT_EQ(
      problems_of(kilograms),
      "inertia_gcm2 = 1.35e-05 lets rotor and winding oscillate at K_t/sqrt(L J) = 1.21e+06 rad/s, and no motor has more than 1e5 rad/s; correct the unit of the inertia, of the inductance or of the torque constant\n");
}

TEST(MotorModel, EveryProblemIsReportedAtOnce) {
  Sheet empty;
  const std::string text = problems_of(empty);
  for (const char* key : {"pole_pairs is missing", "resistance_ohm is missing", "inductance_mH is missing",
                          "torque_constant_mNm_A is missing", "inertia_gcm2 is missing"})
    EXPECT_NE(text.find(key), std::string::npos) << key << "\nin\n" << text;
  Sheet wrong = maxon();
  wrong.flat_deg = 180.0;
  wrong.resistance_ohm->frame = "line";
  wrong.inertia_gcm2->value = std::nan("");
  wrong.torque_constant_mNm_A->frame = "phase";
  EXPECT_EQ(motor_model(wrong).problems().size(), 4u);
}

}  // namespace SIXSTEP_TEST_FILE

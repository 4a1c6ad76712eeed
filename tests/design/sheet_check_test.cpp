// SPDX-License-Identifier: Apache-2.0
// The relations between the values of a sheet. The sheet of the 251601 is consistent, every error is found,
// and rounded values are accepted.
#include "sixstep/design/sheet/sheet_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using namespace sixstep::testing;
using base::Quantity;

SheetCheck checked(const Sheet& sheet) {
  const auto check = check_sheet(sheet);
  if (check) return *check;
  for (const base::Problem& p : check.problems()) ADD_FAILURE() << to_string(p);
  return {};
}

Relation relation(const SheetCheck& check, const std::string& name) {
  for (const Relation& r : check.relations)
    if (r.name == name) return r;
  ADD_FAILURE() << "no relation " << name;
  return {};
}

/// The tolerance of the nominal torque, after friction is subtracted, is equal to the effect of the rounding
/// of I and I_0.
TEST(SheetCheck, NominalTorqueAllowsTheFrictionToItsRounding) {
  const double K = 54.1, I = 2.05, I_0 = 0.092, I_half = 0.005, I_0_half = 0.5e-3, K_half = 0.05;
  Sheet s = printed_251601();
  s.torque_constant_mNm_A = {K, "terminal", ""};
  s.nominal_current_A = {I, "terminal", ""};
  s.no_load_current_mA = {1e3 * I_0, "", ""};
  s.nominal_torque_mNm = {108, "", ""};
  const Relation r = relation(checked(s), "nominal torque");
  // The largest ratio is the printed K I divided by the true K (I - I_0). In this case, the printed torque is
  // half a digit below the true torque.
  const double largest = K * I / ((K - K_half) * (I - I_half - I_0 - I_0_half)) * 108 / 107.5 - 1;
  EXPECT_NEAR(r.highest, largest, 0.03 * largest);
  EXPECT_NEAR(r.lowest, -(I_half / I + K_half / K + 0.5 / 108), 1e-9);
}

/// Only the sheets of maxon have numbered lines.
TEST(SheetCheck, ANumberedLineOfAnotherMakerIsDoubted) {
  Sheet s = printed_251601();
  EXPECT_TRUE(checked(s).doubts.empty());
  s.resistance_ohm->key = "line_10_terminal_resistance_ohm";
  for (const char* maker : {"", "Acme", "maxon", "Maxon motor"}) {
    s.maker = maker;
    const SheetCheck check = checked(s);
    EXPECT_EQ(check.doubts.empty(), std::string(maker).find("axon") != std::string::npos) << maker;
    for (const base::Problem& doubt : check.doubts) EXPECT_EQ(doubt.where, "line_10_terminal_resistance_ohm");
  }
}

TEST(SheetCheck, TheReferenceMotorsRelationsByTheNumbers) {
  const SheetCheck check = checked(printed_251601());
  const struct {
    const char* name;
    double left, right;
    bool holds;
  } expected[] = {{"stall current", 23.30, 23.3, true},
                  {"stall torque", 780.55, 780, true},
                  {"speed constant", 9547.5, 9549.3, true},
                  {"no-load speed", 6785.7, 6710, true},
                  {"nominal torque", 78.055, 83.4, false},
                  {"max. efficiency", 82.973, 83, true},
                  {"mechanical time constant", 12.39, 12.4, true},
                  {"speed/torque gradient", 8.764, 8.76, true}};
  EXPECT_EQ(check.relations.size(), std::size(expected));
  for (const auto& e : expected) {
    const Relation r = relation(check, e.name);
    EXPECT_NEAR(r.left, e.left, 6e-5 * e.left) << e.name;  // the digits of the table above
    EXPECT_NEAR(r.right, e.right, 1e-5 * e.right) << e.name;
    EXPECT_EQ(r.verdict == RelationVerdict::holds, e.holds) << e.name << " " << r.deviation;
  }
  EXPECT_FALSE(check.consistent);
  EXPECT_NEAR(relation(check, "no-load speed").deviation, 0.0113, 5e-5);
  EXPECT_NEAR(relation(check, "nominal torque").deviation, -0.0641, 5e-5);
  EXPECT_NEAR(*check.electrical_time_constant_s, 0.286e-3 / 0.515, 1e-18);
}

/// The stall point is stated by U/R, the stall current and the stall torque. If one of these three values is
/// wrong, the other two show it: 780 mN m = k_M 24/1.03.
TEST(SheetCheck, OneBadValueOfTheStallPointBreaksItsOwnRelationAlone) {
  Sheet s = printed_251601();
  s.stall_current_A->value = 46.6;
  const SheetCheck check = checked(s);
  EXPECT_EQ(relation(check, "stall current").verdict, RelationVerdict::broken);
  EXPECT_NE(relation(check, "stall current").remark.find("check the stall current"), std::string::npos);
  EXPECT_EQ(relation(check, "stall torque").verdict, RelationVerdict::holds);
  EXPECT_NEAR(relation(check, "stall torque").left, 33.5 * 24 / 1.03, 1e-9);
  s.known_deviation = {"stall current", "nominal torque"};
  EXPECT_TRUE(checked(s).consistent);
  s = printed_251601();
  s.stall_torque_mNm->value *= 2;  // the two other values agree
  EXPECT_EQ(relation(checked(s), "stall current").verdict, RelationVerdict::holds);
  EXPECT_EQ(relation(checked(s), "stall torque").remark, "a factor 2: terminal against phase?");
}

/// 0.572 mH/1.03 ohm = 0.555 ms in either frame (terminals or phase), if both values have the same frame.
TEST(SheetCheck, AnElectricalTimeConstantIsLOverR) {
  Sheet s = printed_251601();
  s.electrical_time_constant_ms = Quantity{0.555, "", ""};
  EXPECT_NEAR(relation(checked(s), "electrical time constant").left, 0.572 / 1.03, 1e-12);
  EXPECT_EQ(relation(checked(s), "electrical time constant").verdict, RelationVerdict::holds);
  s.inductance_mH->frame = "phase";
  EXPECT_EQ(relation(checked(s), "electrical time constant").remark, "a factor 2: terminal against phase?");
}

TEST(SheetCheck, ALineKeepsTheValueOfItsOwnKey) {
  Sheet s = printed_251601();
  s.inertia_gcm2 = Quantity{.value = 60000, .key = "inertia_kgm2"};
  const SheetCheck check = checked(s);
  for (const LineUse& line : check.lines)
    if (line.key == "inertia_kgm2") {
      EXPECT_NEAR(line.in_file, 0.006, 1e-17);
    }
}

/// If the current is smooth, commutation may reduce the speed by the fraction 3 p L_s i/(pi K_t) (symbols of
/// model.md).
TEST(SheetCheck, ANominalSpeedOnTheIdealLineSaysWhatCommutationTakes) {
  Sheet s = printed_251601();
  s.nominal_speed_rpm = Quantity{5980, "", ""};
  EXPECT_EQ(relation(checked(s), "nominal speed").verdict, RelationVerdict::holds);
  const double part = 3 * 8 * 0.286e-3 * (83.4 / 33.5 + 0.185) / (base::pi * 0.0335);
  const std::string remark = relation(checked(s), "nominal speed").remark;
  EXPECT_NE(
      remark.find("about " + base::rounded(100 * part / (1 + part), 2) + " %; the torque-speed curve has"),
      std::string::npos)
      << remark;
}

/// A no-load speed of 55000 rpm with mechanics for 15000 rpm is a misread line of the sheet. A winding for
/// 1.5 times the maximum speed of the mechanics is accepted.
TEST(SheetCheck, ANoLoadSpeedFarAboveTheMechanicsIsADoubt) {
  Sheet sheet = printed_251601();
  sheet.max_speed_rpm = Quantity{.value = 6710 / 1.5};
  EXPECT_EQ(relation(checked(sheet), "maximum speed").verdict, RelationVerdict::holds);
  EXPECT_NEAR(relation(checked(sheet), "maximum speed").deviation, 0.5, 1e-12);
  EXPECT_NE(relation(checked(sheet), "maximum speed").remark, "");
  sheet.max_speed_rpm->value = 6710 / 3.7;
  const SheetCheck check = checked(sheet);
  EXPECT_EQ(relation(check, "maximum speed").verdict, RelationVerdict::broken);
  EXPECT_NEAR(relation(check, "maximum speed").deviation, 2.7, 0.01);
  sheet.no_load_speed_rpm.reset();  // the speed is then computed from U and k_M
  EXPECT_NEAR(relation(checked(sheet), "maximum speed").deviation,
              24 / 33.5e-3 * 30 / base::pi / 6710 * 3.7 - 1, 0.02);
}

TEST(SheetCheck, ToleranceIsTheRoundingOfWhatIsPrinted) {
  // A printed 1.03 means 1.025 to 1.035, and a printed 23.3 means 23.25 to 23.35. The voltage is exact.
  const Relation r = relation(checked(printed_251601()), "stall current");
  EXPECT_NEAR(r.highest, 0.005 / 1.03 + 0.05 / 23.3, 1e-15);
  EXPECT_EQ(r.lowest, -r.highest);
  Sheet s = printed_251601();
  s.stall_current_A->last_digit = 0.001;  // as if 23.300 were printed
  EXPECT_NEAR(relation(checked(s), "stall current").highest, 0.005 / 1.03 + 0.0005 / 23.3, 1e-15);
}

TEST(SheetCheck, ASheetRoundedToThreeDigitsIsNeverCalledInconsistent) {
  // The true values of a grid of motors, each rounded to three digits, as sheets print them.
  const auto three = [](double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2);
    return Quantity{std::strtod(std::to_string(std::round(x / unit) * unit).c_str(), nullptr), "", ""};
  };
  for (double R = 0.21; R < 30; R *= 1.37)
    for (double K = 11.3; K < 200; K *= 1.53)
      for (double I_0 = 0.0123; I_0 < 0.3 * 24 / R && I_0 < 2; I_0 *= 2.1) {
        Sheet s = printed_251601();
        const double stall = 24 / R, n = 30e3 / base::pi / K, x = std::sqrt(I_0 / stall);
        s.resistance_ohm = three(R);
        s.resistance_ohm->frame = "terminal";
        s.torque_constant_mNm_A = three(K);
        s.speed_constant_rpm_V = three(n);
        s.speed_constant_rpm_V->frame = "six-step";
        s.no_load_current_mA = three(I_0 * 1e3);
        s.no_load_speed_rpm = three(n * (24 - R * I_0));
        s.stall_current_A = three(stall);
        s.stall_torque_mNm = three(stall * K);
        s.nominal_current_A = three(0.3 * stall + I_0);
        s.nominal_current_A->frame = "terminal";
        s.nominal_torque_mNm = three(0.3 * stall * K);
        s.max_efficiency_percent = three(100 * (1 - x) * (1 - x));
        s.speed_torque_gradient_rpm_mNm = three(R / (K * K) * 30e3 / base::pi);
        s.mechanical_time_constant_ms = three(R * 135e-7 / (K * K) * 1e9);
        for (const Relation& r : checked(s).relations)
          EXPECT_EQ(r.verdict, RelationVerdict::holds) << r.name << " " << r.deviation << " of " << r.lowest
                                                       << " R " << R << " K " << K << " I_0 " << I_0;
      }
}

TEST(SheetCheck, EverySlipOfALineThatIsPrintedTwiceIsNoticed) {
  using Member = std::optional<Quantity> Sheet::*;
  for (const Member line :
       {&Sheet::resistance_ohm, &Sheet::torque_constant_mNm_A, &Sheet::speed_constant_rpm_V,
        &Sheet::inertia_gcm2, &Sheet::no_load_speed_rpm, &Sheet::stall_torque_mNm, &Sheet::stall_current_A,
        &Sheet::max_efficiency_percent, &Sheet::speed_torque_gradient_rpm_mNm,
        &Sheet::mechanical_time_constant_ms, &Sheet::nominal_voltage_V})
    for (const double slip : {0.5, 0.9, 1.1, 2.0}) {
      Sheet s = printed_251601();
      s.nominal_torque_mNm.reset();  // this line already deviates by more than its rounding
      (s.*line)->value *= slip;
      if (s.max_efficiency_percent->value >= 100) continue;
      EXPECT_FALSE(checked(s).consistent) << (s.*line)->value;
    }
}

/// Friction is a torque, which is equal in the terminal frame and in the phase frame. If half the current is
/// missing, this does not indicate another frame.
TEST(SheetCheck, FrictionThatLacksHalfTheCurrentIsNoFactorOfAFrame) {
  Sheet s = printed_251601();
  const double w = s.no_load_speed_rpm->value * base::pi / 30.0;
  const double loss_Nm = 1e-6 * s.torque_constant_mNm_A->value * s.no_load_current_mA->value;
  s.viscous_friction_Nm_s = Quantity{0.5 * loss_Nm / w, "", ""};
  EXPECT_EQ(relation(checked(s), "no-load current").remark,
            "Coulomb friction T_c is not given; T_c would increase the left side");
  s.coulomb_friction_mNm = Quantity{1e-6, "", ""};
  EXPECT_EQ(relation(checked(s), "no-load current").remark, "");
  s.coulomb_friction_mNm = Quantity{0.5e3 * loss_Nm, "", ""};
  EXPECT_EQ(relation(checked(s), "no-load current").verdict, RelationVerdict::holds);
}

TEST(SheetCheck, AWellKnownFactorIsNamed) {
  Sheet s = printed_251601();
  s.resistance_ohm->value *= 2;
  EXPECT_EQ(
      relation(checked(s), "stall current").remark,
      "a factor 2: terminal against phase? the stall torque agrees with the stall current: check the resistance and the voltage");
  s = printed_251601();
  s.stall_torque_mNm->value /= 10;
  EXPECT_EQ(relation(checked(s), "stall torque").remark,
            "a factor 10: a misplaced decimal point, or a wrong unit?");
  s = printed_251601();
  s.back_emf = BackEmfShape::sine;
  s.torque_constant_mNm_A.reset();
  s.torque_constant_Nm_A = Quantity{0.45, "rms", ""};
  s.back_emf_constant_V_krpm =
      Quantity{0.45 / 1.5 / std::sqrt(2.0) * 104.72 * std::sqrt(1.5), "phase-rms", ""};
  EXPECT_EQ(relation(checked(s), "K_e by back_emf_constant_V_krpm").remark,
            "a factor sqrt 3: line against phase?");
  s.back_emf_constant_V_krpm->frame = "line-rms";
  EXPECT_EQ(relation(checked(s), "K_e by back_emf_constant_V_krpm").verdict, RelationVerdict::holds);
}

TEST(SheetCheck, EfficiencyLiesBetweenAllCoulombAndAllViscous) {
  // A check by the motor's equations. The efficiency is eta = w (i - I_f(w))/(U i) K_t with w = (U - R
  // i)/K_t, maximised over the current i. I_f is the current of friction.
  const double U = 24, R = 1.03, K = 0.0335, I_0 = 0.185, stall = U / R, w_0 = (U - R * I_0) / K;
  double coulomb = 0.0, viscous = 0.0;
  for (double i = I_0; i < stall; i += 1e-4) {
    const double w = (U - R * i) / K;
    coulomb = std::max(coulomb, w * K * (i - I_0) / (U * i));
    viscous = std::max(viscous, w * K * (i - I_0 * w / w_0) / (U * i));
  }
  const double x = std::sqrt(I_0 / stall);
  EXPECT_NEAR(coulomb, (1 - x) * (1 - x), 1e-8);  // at the maximum, the error is of second order in the step
  EXPECT_NEAR(viscous, (1 - x) / (1 + x), 1e-8);
  Sheet s = printed_251601();
  s.max_efficiency_percent->last_digit = 1e-3;
  for (const auto& [percent, holds] : {std::pair{100 * viscous, true},
                                       {100 * coulomb, true},
                                       {100 * viscous + 0.3, false},
                                       {100 * coulomb - 0.3, false}}) {
    s.max_efficiency_percent->value = percent;
    EXPECT_EQ(relation(checked(s), "max. efficiency").verdict == RelationVerdict::holds, holds) << percent;
  }
}

TEST(SheetCheck, AKnownDeviationMustBeOneAndIsOne) {
  Sheet s = printed_251601();
  s.known_deviation = {"nominal torque"};
  EXPECT_TRUE(checked(s).consistent);
  EXPECT_EQ(relation(checked(s), "nominal torque").verdict, RelationVerdict::known);
  s.known_deviation = {"stall torque"};
  EXPECT_EQ(to_string(check_sheet(s).problems().at(0)),
            "known_deviation = \"stall torque\" names a relation that holds; remove this name");
  s.known_deviation = {"stall"};
  EXPECT_EQ(to_string(check_sheet(s).problems().at(0)).substr(0, 90),
            "known_deviation = \"stall\" is not the name of a relation of this sheet; name one of these: ");
}

/// If a sheet has few values, a unit that is wrong by a factor of thousand contradicts no relation. Such
/// values are then doubted because of their size.
TEST(SheetCheck, ASlowWindingOrRotorIsDoubted) {
  const auto doubts = [](const Sheet& sheet) {
    std::vector<std::string> out;
    for (const base::Problem& p : checked(sheet).doubts) out.push_back(to_string(p));
    return out;
  };
  const Sheet good = printed_251601();
  EXPECT_TRUE(doubts(good).empty());
  Sheet s = good;
  s.inductance_mH->value = 205;  // L/R = 199 ms
  EXPECT_TRUE(doubts(s).empty());
  s.inductance_mH->value = 1200;
  ASSERT_EQ(doubts(s).size(), 1u);
  EXPECT_EQ(
      doubts(s)[0],
      "inductance_mH = 1200 gives the winding a time constant L/R of 1.17 s, and almost no motor has more than 0.2 s; correct the unit of inductance or resistance");
  s = good;
  s.inertia_gcm2->value = 4.8e8;
  s.inertia_gcm2->key = "inertia_kgm2";  // the file says 48
  ASSERT_EQ(doubts(s).size(), 1u);
  EXPECT_TRUE(
      doubts(s)[0].starts_with("inertia_kgm2 = 48 gives the rotor a time constant R J/K_t^2 of 4.41e+04 s"));
}

/// If a message states a value beside a key of the file, the value is in the unit of this key.
TEST(SheetCheck, MessagesNameValuesAsTheFileWritesThem) {
  Sheet s = printed_251601();
  s.with_brake = true;
  s.inertia_with_brake_gcm2 = Quantity{100, "", ""};
  s.inertia_with_brake_gcm2->key = "inertia_with_brake_kgm2";
  s.inertia_gcm2->key = "inertia_kgcm2";
  const auto told = check_sheet(s);
  ASSERT_FALSE(told);
  EXPECT_EQ(to_string(told.problems()[0]).substr(0, 92),
            "inertia_with_brake_kgm2 = 1e-05 is less than the rotor's inertia, inertia_kgcm2 = 0.135; swa");
  s = printed_251601();
  s.torque_constant_mNm_A->value = 41e3;
  s.inertia_gcm2->value = 48;
  s.inertia_gcm2->key = "inertia_kgm2";
  const auto model = motor_model(s);
  ASSERT_FALSE(model);
  bool named = false;
  for (const base::Problem& p : model.problems()) named |= p.where == "inertia_kgm2" && p.value == "4.8e-06";
  EXPECT_TRUE(named);
}

TEST(SheetCheck, EveryLineIsUsedOrSaysWhyNot) {
  Sheet s = printed_251601();
  s.viscous_friction_Nm_s = Quantity{7.3e-6, "", ""};
  const SheetCheck check = checked(s);
  std::vector<std::string> used;
  for (const LineUse& line : check.lines) {
    EXPECT_EQ(line.used, line.why.empty()) << line.key;
    if (line.used) used.push_back(line.key);
  }
  std::sort(used.begin(), used.end());
  EXPECT_EQ(used, (std::vector<std::string>{"inductance_mH", "inertia_gcm2", "resistance_ohm",
                                            "torque_constant_mNm_A", "viscous_friction_Nm_s"}));
}

}  // namespace SIXSTEP_TEST_FILE

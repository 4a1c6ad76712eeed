// SPDX-License-Identifier: Apache-2.0
// The no-load points of a sheet obey n_0 = (U - R I_0)/k_M and k_M I_0 = T_c + B w_0 (symbols of model.md).
// They are checked with the formula, with a printed sheet, and with an error in each value for each form of
// friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_check.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using namespace sixstep::testing;
using base::Quantity;
using base::Trust;

constexpr double rpm = 30.0 / base::pi;

SheetCheck checked(const Sheet& sheet) {
  const auto check = check_sheet(sheet);
  if (check) return *check;
  for (const base::Problem& p : check.problems()) ADD_FAILURE() << to_string(p);
  return {};
}

std::optional<Relation> found(const Sheet& sheet, const std::string& name) {
  for (const Relation& r : checked(sheet).relations)
    if (r.name == name) return r;
  return {};
}

Relation relation(const Sheet& sheet, const std::string& name) {
  const std::optional<Relation> r = found(sheet, name);
  EXPECT_TRUE(r) << "no relation " << name;
  return r.value_or(Relation{});
}

/// A motor whose no-load speed w and current I satisfy both equations, apart from rounding: U = R I + K w and
/// K I = T_c + B w.
struct Motor {
  double U = 24.0, R = 1.03, K = 0.0335, B = 4e-6, T_c = 3e-3;
  double w(double at_V) const { return (at_V - R * T_c / K) / (K + R * B / K); }
  double w() const { return w(U); }
  double I(double at_V) const { return (T_c + B * w(at_V)) / K; }
  double I() const { return I(U); }
};

/// A value that is printed with so many digits that its rounding is negligible.
Quantity fine(double value, const char* frame = "") {
  Quantity q{value, frame, ""};
  q.last_digit = 1e-9 * value;
  return q;
}

/// A sheet with only the lines of the no-load relations.
Sheet sheet_of(const Motor& m) {
  Sheet s;
  s.name = "x";
  s.pole_pairs = 8;
  s.nominal_voltage_V = fine(m.U);
  s.resistance_ohm = fine(m.R, "terminal");
  s.inductance_mH = fine(0.572, "terminal");
  s.torque_constant_mNm_A = fine(m.K * 1e3, "terminal");
  s.inertia_gcm2 = fine(135);
  s.no_load_speed_rpm = fine(m.w() * rpm);
  s.no_load_current_mA = fine(m.I() * 1e3);
  s.viscous_friction_Nm_s = fine(m.B);
  s.coulomb_friction_mNm = fine(m.T_c * 1e3);
  return s;
}

TEST(SheetNoLoad, ASheetsOwnFrictionMakesItsNoLoadCurrent) {
  // The printed sheet of Faulhaber 3564 B, with four windings: k_M in mNm/A, I_0 in A, n_0 in rpm, U in V, R
  // in ohm. The friction values C_0 and C_V are equal for all windings.
  const double C_0 = 1.10, C_V = 2.4e-4;
  const struct {
    double U, R, n_0, I_0, k_M;
  } windings[] = {{12, 0.6, 7850, 0.206, 14.52},
                  {24, 1.2, 11300, 0.189, 20.12},
                  {36, 2.8, 11550, 0.131, 29.50},
                  {48, 4.4, 12200, 0.109, 37.02}};
  for (const auto& x : windings) {
    Sheet s = sheet_of({});
    s.nominal_voltage_V = Quantity{x.U, "", ""};
    s.resistance_ohm = Quantity{x.R, "terminal", ""};
    s.torque_constant_mNm_A = Quantity{x.k_M, "terminal", ""};
    s.no_load_speed_rpm = Quantity{x.n_0, "", ""};
    s.no_load_current_mA = Quantity{x.I_0 * 1e3, "", ""};
    s.coulomb_friction_mNm = Quantity{C_0, "", ""};
    s.coulomb_friction_mNm->last_digit = 0.01;
    s.viscous_friction_Nm_s = Quantity{C_V * 1e-3 * rpm, "", ""};
    s.viscous_friction_Nm_s->last_digit = 0.1e-4 * 1e-3 * rpm;
    const Relation r = relation(s, "no-load current");
    const double by_hand = (C_0 + C_V * x.n_0) / x.k_M * 1e3;
    EXPECT_NEAR(r.left, by_hand, 1e-12 * by_hand);
    EXPECT_EQ(r.verdict, RelationVerdict::holds) << r.deviation;
    EXPECT_LT(std::abs(r.deviation), 0.0025);
    EXPECT_LT(r.highest, 0.025);  // two digits in C_V, without further margin
    EXPECT_EQ(relation(s, "no-load speed").verdict, RelationVerdict::holds);
  }
}

TEST(SheetNoLoad, TheSpeedIsHeldWhicheverWayFrictionIsGiven) {
  const Motor m;
  using Member = std::optional<Quantity> Sheet::*;
  const std::vector<std::vector<Member>> silent = {
      {},
      {&Sheet::no_load_current_mA},
      {&Sheet::viscous_friction_Nm_s},
      {&Sheet::viscous_friction_Nm_s, &Sheet::coulomb_friction_mNm},
      {&Sheet::viscous_friction_Nm_s, &Sheet::coulomb_friction_mNm, &Sheet::no_load_current_mA},
      {&Sheet::viscous_friction_Nm_s, &Sheet::no_load_current_mA}};
  for (const std::vector<Member>& lines : silent) {
    Sheet s = sheet_of(m);
    for (const Member line : lines) (s.*line).reset();
    // The computed speed contains only the friction that the sheet prints.
    const double dry = s.coulomb_friction_mNm ? m.T_c : 0.0, viscous = s.viscous_friction_Nm_s ? m.B : 0.0;
    const double w = (m.U - m.R * dry / m.K) / (m.K + m.R * viscous / m.K);
    const double I = s.no_load_current_mA ? m.I() : (dry + viscous * w) / m.K;
    Relation r = relation(s, "no-load speed");
    EXPECT_NEAR(r.left, (m.U - m.R * I) / m.K * rpm, 1e-9);
    EXPECT_EQ(r.verdict, RelationVerdict::holds) << r.deviation << " " << lines.size();
    for (const double slip : {0.5, 0.7, 1.1, 2.0}) {
      s.no_load_speed_rpm->value = m.w() * rpm * slip;
      r = relation(s, "no-load speed");
      EXPECT_EQ(r.verdict, RelationVerdict::broken) << slip << " " << lines.size();
      EXPECT_NEAR(r.right, m.w() * rpm * slip, 1e-9);
      EXPECT_NEAR(r.deviation, r.left / r.right - 1.0, 1e-12);
    }
  }
}

TEST(SheetNoLoad, WhereAllFrictionIsPrintedTheSpeedIsHeldBothWays) {
  Sheet s = sheet_of({});
  s.no_load_current_mA.reset();
  Relation r = relation(s, "no-load speed");
  EXPECT_NEAR(r.deviation, 0.0, 1e-12);  // the point solves both equations
  EXPECT_LT(r.highest, 0.03);
  EXPECT_NE(r.remark.find("the friction lines"), std::string::npos) << r.remark;
  s.viscous_friction_Nm_s.reset();
  s.coulomb_friction_mNm.reset();
  r = relation(s, "no-load speed");
  EXPECT_NEAR(r.highest - -r.lowest, most_unknown_drop / (1.0 - most_unknown_drop), 1e-12);
}

TEST(SheetNoLoad, TheCurrentIsHeldAgainstTheFrictionByTheFormula) {
  const Motor m;
  const Sheet good = sheet_of(m);
  EXPECT_NEAR(relation(good, "no-load current").deviation, 0.0, 1e-12);
  for (const double slip : {0.8, 0.95, 1.05, 1.25, 10.0}) {
    Sheet s = good;
    s.no_load_current_mA->value *= slip;
    const Relation r = relation(s, "no-load current");
    EXPECT_NEAR(r.left, (m.T_c + m.B * m.w()) / m.K * 1e3, 1e-9);
    EXPECT_NEAR(r.right, m.I() * 1e3 * slip, 1e-9);
    EXPECT_NEAR(r.deviation, 1.0 / slip - 1.0, 1e-12);
    EXPECT_EQ(r.verdict, RelationVerdict::broken) << slip;
  }
  Sheet without_friction = good;  // a motor without printed friction that draws a no-load current
  without_friction.viscous_friction_Nm_s->value = 0.0;
  without_friction.coulomb_friction_mNm.reset();
  EXPECT_EQ(relation(without_friction, "no-load current").deviation, -1.0);
}

TEST(SheetNoLoad, TheIronsPartCountsInTheFriction) {
  const Motor m;
  Sheet s = sheet_of(m);
  s.iron_viscous_Nm_s = fine(0.25 * m.B);
  s.viscous_friction_Nm_s->value = 0.75 * m.B;
  s.iron_coulomb_mNm = fine(0.5e3 * m.T_c);
  s.coulomb_friction_mNm->value = 0.5e3 * m.T_c;
  EXPECT_NEAR(relation(s, "no-load current").deviation, 0.0, 1e-12);
}

TEST(SheetNoLoad, WithoutAPrintedSpeedTheCurrentIsHeldAtTheIdealLines) {
  const Motor m;
  Sheet s = sheet_of(m);
  s.no_load_speed_rpm.reset();
  EXPECT_NEAR(relation(s, "no-load current").deviation, 0.0, 1e-12);
  EXPECT_FALSE(found(s, "no-load speed"));
}

TEST(SheetNoLoad, FrictionThatWasReadFromThePointIsNotHeldAgainstIt) {
  Sheet s = sheet_of({});
  s.viscous_friction_Nm_s.reset();
  EXPECT_FALSE(found(s, "no-load current"));
  s.coulomb_friction_mNm.reset();
  EXPECT_FALSE(found(s, "no-load current"));
}

TEST(SheetNoLoad, ASecondPointIsHeldAsTheFirst) {
  const Motor m;
  Sheet s = sheet_of(m);
  const double U = 0.5 * m.U;
  s.second_no_load_voltage_V = fine(U);
  s.second_no_load_speed_rpm = fine(m.w(U) * rpm);
  s.second_no_load_current_mA = fine(m.I(U) * 1e3);
  EXPECT_NEAR(relation(s, "second no-load speed").deviation, 0.0, 1e-12);
  EXPECT_NEAR(relation(s, "second no-load current").deviation, 0.0, 1e-12);
  Sheet dry_given = s;  // B is computed from the first point, and the second point may contradict it
  dry_given.viscous_friction_Nm_s.reset();
  EXPECT_FALSE(found(dry_given, "no-load current"));
  EXPECT_NEAR(relation(dry_given, "second no-load current").deviation, 0.0, 1e-12);
  Sheet split = dry_given;  // both points determine the friction: no relation remains
  split.coulomb_friction_mNm.reset();
  EXPECT_FALSE(found(split, "second no-load current"));
  s.second_no_load_speed_rpm->value *= 1.05;
  EXPECT_EQ(relation(s, "second no-load speed").verdict, RelationVerdict::broken);
  dry_given.second_no_load_current_mA->value *= 1.1;
  EXPECT_EQ(relation(dry_given, "second no-load current").verdict, RelationVerdict::broken);
}

TEST(SheetNoLoad, ACurrentThatTakesAllOfTheVoltageIsToldOf) {
  const Motor m;
  Sheet s = sheet_of(m);
  s.no_load_current_mA->value = 1e3 * m.U / m.R * 1.01;
  EXPECT_EQ(relation(s, "no-load speed").deviation, -1.0);
  EXPECT_EQ(relation(s, "no-load speed").verdict, RelationVerdict::broken);
  s.no_load_current_mA.reset();
  s.coulomb_friction_mNm->value = 1.01e3 * m.K * m.U / m.R;  // more than the stall torque
  const Relation r = relation(s, "no-load speed");
  EXPECT_EQ(r.left, 0.0);
  EXPECT_EQ(r.remark, "R I_0 uses up the whole voltage: with this current the motor does not turn");
}

TEST(SheetNoLoad, AnotherMotorsFrictionIsAllowedToDiffer) {
  const Motor m;
  Sheet s = sheet_of(m);
  s.no_load_current_mA->value *= 1.25;
  EXPECT_EQ(relation(s, "no-load current").verdict, RelationVerdict::broken);
  s.viscous_friction_Nm_s->kind = Trust::measured;
  const Relation measured = relation(s, "no-load current");
  EXPECT_EQ(measured.verdict, RelationVerdict::holds);
  EXPECT_FALSE(measured.remark.empty());
  s.viscous_friction_Nm_s->kind = Trust::unstated;
  s.no_load_current_mA->range = base::Interval{m.I() * 1e3, 1.25e3 * m.I()};  // in the file, the sources
                                                                              // differ
  const Relation ranged = relation(s, "no-load current");
  EXPECT_EQ(ranged.verdict, RelationVerdict::holds);
  EXPECT_NEAR(ranged.lowest, -0.2, 1e-8);
}

TEST(SheetNoLoad, ALineThatIsNotUsedSaysTruly) {
  const auto why = [](const Sheet& s, const std::string& key) {
    for (const LineUse& line : checked(s).lines)
      if (line.key == key) return line.why;
    return std::string("no such line");
  };
  Sheet s = sheet_of({});
  EXPECT_EQ(why(s, "no_load_current_mA"), "friction is given by other lines");
  s.viscous_friction_Nm_s.reset();
  s.coulomb_friction_mNm.reset();
  EXPECT_EQ(why(s, "no_load_current_mA"), "");
  s.no_load_current_mA.reset();
  EXPECT_EQ(why(s, "no_load_speed_rpm"),
            "friction follows from a no-load current with its speed, or with its voltage, R and K_t");
}

}  // namespace SIXSTEP_TEST_FILE

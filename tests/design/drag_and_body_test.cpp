// SPDX-License-Identifier: Apache-2.0
// Tests the drag of the iron, which is separate from bearing friction, and the rotor's inertia that is
// computed from its dimensions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/sheet_override.hpp"
#include "tests/design/sheets.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;
using namespace sixstep::testing;
using base::Quantity;

TEST(IronDrag, IsPartOfTheSumThatTheModelTurnsWith) {
  Sheet s = printed_251601();
  s.viscous_friction_Nm_s = Quantity{3e-6, "", ""};
  s.coulomb_friction_mNm = Quantity{1.5, "", ""};
  s.iron_viscous_Nm_s = Quantity{2e-6, "", ""};
  s.iron_coulomb_mNm = Quantity{0.5, "", ""};
  const auto m = motor_model(s);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->shaft.B_Nm_s, 3e-6 + 2e-6);
  EXPECT_EQ(m->shaft.coulomb_Nm, 1.5e-3 + 0.5e-3);
  EXPECT_EQ(m->iron.B_Nm_s, 2e-6);
  EXPECT_EQ(m->iron.coulomb_Nm, 0.5e-3);
}

TEST(IronDrag, TheNoLoadCurrentPaysForBothTogether) {
  Sheet s = printed_251601();
  s.iron_viscous_Nm_s = Quantity{2e-6, "", ""};
  s.iron_coulomb_mNm = Quantity{0.5, "", ""};
  const double w_0 = 6710 * base::pi / 30, loss = 0.0335 * 0.185;
  const Friction f = sheet_constants(s).friction;
  EXPECT_NEAR(f.B_Nm_s * w_0 + f.coulomb_Nm, loss, 1e-17) << "K_t I_0 = B w_0 + T_c";
  EXPECT_EQ(f.coulomb_Nm, 0.5e-3);
  const Sheet standard = in_standard_keys(s);
  EXPECT_NEAR(standard.viscous_friction_Nm_s->value, f.B_Nm_s - 2e-6, 1e-20);
  EXPECT_EQ(motor_model(standard)->iron.B_Nm_s, 2e-6);
  EXPECT_NEAR(motor_model(standard)->shaft.B_Nm_s, f.B_Nm_s, 1e-20);
  s.iron_viscous_Nm_s->value = 2e-5;
  EXPECT_NE(told(s).find(
                "iron_viscous_Nm_s = 2e-05 exceeds the friction that the no-load points leave for the iron"),
            std::string::npos)
      << told(s);
}

Sheet with_body(double r_mm, double l_mm) {
  Sheet s = printed_251601();
  s.rotor_radius_mm = Quantity{r_mm, "", ""};
  s.rotor_length_mm = Quantity{l_mm, "", ""};
  return s;
}

TEST(RotorBody, MakesTheInertiaOfACylinderOrARing) {
  Sheet s = with_body(20, 15);
  s.inertia_gcm2.reset();
  const double m = 7850 * base::pi * 0.02 * 0.02 * 0.015;  // J = m r^2/2
  EXPECT_NEAR(motor_model(s)->shaft.J_kg_m2, m * 0.02 * 0.02 / 2, 1e-19);
  s.rotor = RotorPlace::outer;
  EXPECT_NE(told(s).find("needs rotor_inner_radius_mm"), std::string::npos) << told(s);
  s.rotor_inner_radius_mm = Quantity{18, "", ""};
  s.rotor_density_kg_m3 = Quantity{7500, "", ""};
  // A ring is the difference of two cylinders: J = m (r^2 + r_i^2)/2 (mass m, outer radius r, inner radius
  // r_i).
  const double ring = 7500 * base::pi * (0.02 * 0.02 - 0.018 * 0.018) * 0.015;
  EXPECT_NEAR(motor_model(s)->shaft.J_kg_m2, ring * (0.02 * 0.02 + 0.018 * 0.018) / 2, 1e-19);
  s.rotor_inner_radius_mm->value = 21;
  EXPECT_NE(told(s).find("must be below rotor_radius_mm = 20"), std::string::npos) << told(s);
}

TEST(RotorBody, IsHeldAgainstAPrintedInertiaWhichCounts) {
  const double r4 = 135e-7 / (base::pi / 2 * 7850 * 0.02), r_mm = 1e3 * std::sqrt(std::sqrt(r4));
  Sheet s = with_body(r_mm, 20);
  EXPECT_EQ(motor_model(s)->shaft.J_kg_m2, 135e-7);
  const auto relation = [](const Sheet& sheet) {
    const auto check = check_sheet(sheet);
    const auto& all = check->relations;
    return *std::find_if(all.begin(), all.end(), [](const Relation& r) { return r.name == "inertia"; });
  };
  EXPECT_NEAR(relation(s).left, 135.0, 1e-9);
  EXPECT_EQ(relation(s).verdict, RelationVerdict::holds);
  s.rotor_radius_mm->value = 2 * r_mm;
  EXPECT_EQ(relation(s).verdict, RelationVerdict::broken);
  EXPECT_EQ(
      relation(s).remark,
      "the dimensions give about 16 times the printed inertia: check whether rotor_radius_mm holds the diameter");
}

TEST(RotorBody, AnOverriddenMeasureDropsThePrintedInertia) {
  Sheet s = with_body(20, 15);
  drop_stale(s, [](std::string_view key) { return key == "rotor_length_mm"; });
  EXPECT_FALSE(s.inertia_gcm2);
  EXPECT_TRUE(s.rotor_radius_mm);
  s = with_body(20, 15);
  drop_stale(s, [](std::string_view key) { return key == "inertia_gcm2"; });
  EXPECT_TRUE(s.inertia_gcm2);
  EXPECT_FALSE(s.rotor_radius_mm);
}

}  // namespace SIXSTEP_TEST_FILE

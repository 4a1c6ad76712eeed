// SPDX-License-Identifier: Apache-2.0
// Saturation, warm copper and failing switches of the general kernel (model.md 7 and 8) are compared with
// closed forms. Where there is none, they are compared with runs that reach the same state in another way.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/plant/general/audit.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double digits = 1e-12;

GeneralSetup saturating(double electrical_deg, double I_sat) {
  GeneralSetup s;
  s.shaft.locked = true;
  s.machine.shape.harmonics = {{1, 1.0}};
  s.machine.L_d_H = 0.24e-3;
  s.machine.L_q_H = 0.34e-3;
  s.machine.saturation_A = I_sat;
  s.start.angle_rad = at_electrical_deg(electrical_deg);
  return s;
}

/// A pulse from a to b along the magnet's axis: i_d = (2/sqrt 3) i, and sqrt 3 lambda_d + 2 R (integral of i)
/// = U t (symbols of model.md). Therefore t(i) has a closed form. `sign` is 1 for a pulse in the magnet's
/// direction, and -1 for the opposite direction.
TEST(GeneralWinding, APulseAlongTheMagnetTellsNorthFromSouth) {
  const double R = 0.515, L = 0.24e-3, U = 24, I_sat = 40;
  const auto time_of = [&](double i, double sign) {
    const double a = sign * 2 / std::sqrt(3.0) / I_sat, log = std::log(1 - 2 * R * i / U);
    return 2 * L * (-log / (2 * R) + a * (i / (2 * R) + U * log / (4 * R * R)));
  };
  // For theta_e = 120 degrees, the magnet's direction theta_d = theta_e - 150 degrees is the axis of the
  // pair, -30 degrees.
  double reached[2] = {};
  for (const double sign : {1.0, -1.0}) {
    HeldGeneral held(saturating(sign > 0 ? 120 : 300, I_sat), a_to_b());
    for (const double t : {5e-5, 2e-4, 4e-4}) {
      ASSERT_EQ(run_to(held, t), sim::Stop::end);
      const double i = held.plant().state().i[0];
      EXPECT_NEAR(time_of(i, sign), t, digits * 1e-3) << sign;
    }
    reached[sign > 0] = held.plant().state().i[0];
    EXPECT_FALSE(held.plant().beyond_model());
  }
  EXPECT_GT(reached[1], 1.1 * reached[0]) << "the magnet's own direction saturates: the current rises faster";
}

TEST(GeneralWinding, TheModelOfSaturationSaysWhereItEnds) {
  HeldGeneral held(saturating(120, 20), a_to_b());
  run_to(held, 1e-3);
  EXPECT_TRUE(held.plant().beyond_model());
}

TEST(GeneralWinding, ASaturatingMachineKeepsTheBooksAsItTurns) {
  GeneralSetup s = saturating(0, 60);
  s.shaft.locked = false;
  Board board = Board::duty(0.5);
  auto rig = general_rig(s, board);
  general::Audit<double> audit;
  struct Watch {
    general::Audit<double>& audit;
    void segment(const GeneralRig& rig, double to) { audit.segment(rig.plant(), to); }
  } watch{audit};
  ASSERT_EQ(sim::run(rig, sim::to_instant(0.02), watch).stop, sim::Stop::end);
  EXPECT_GT(rig.plant().state().w, 50);
  EXPECT_LT(std::fabs(audit.energy().electrical_residual), 1e-12);
  EXPECT_LT(std::fabs(audit.energy().mechanical_residual), 1e-12);
}

TEST(GeneralWinding, CopperThatIsWarmerHasAnotherTimeConstant) {
  GeneralSetup s;
  s.shaft.locked = true;
  HeldGeneral held(s, a_to_b());
  ASSERT_EQ(run_to(held, 5e-4), sim::Stop::end);
  const double cold = 24 / 1.03 * (1 - std::exp(-5e-4 * 1.03 / 0.572e-3));
  held.plant().set_warmth(1.3, 0.9);
  ASSERT_EQ(run_to(held, 9e-4), sim::Stop::end);
  const double R = 1.3 * 1.03, end = 24 / R;
  EXPECT_NEAR(held.plant().state().i[0], end + (cold - end) * std::exp(-4e-4 * R / 0.572e-3), digits * 20);
}

TEST(GeneralWinding, AMagnetThatIsWarmerIsWeaker) {
  GeneralSetup s;
  s.shaft.B_Nm_s = 0;
  s.start.speed_rad_s = 100;
  HeldGeneral held(s);
  held.plant().set_warmth(1.0, 0.8);
  held.plant().set_warmth(1.1, 0.9);  // a factor of the cold value, not of the present one
  ASSERT_EQ(run_to(held, 1e-3), sim::Stop::end);
  EXPECT_NEAR(held.plant().at(0.0).emf[0], 0.9 * 0.01675 * 100, 1e-12);
}

TEST(GeneralWinding, ASwitchThatObeysNoMoreIsOffAndItsDiodeStays) {
  GeneralSetup s;
  s.shaft.locked = true;
  HeldGeneral failed(s, a_to_b()), opened(s, a_to_b());
  for (HeldGeneral* held : {&failed, &opened}) ASSERT_EQ(run_to(*held, 5e-4), sim::Stop::end);
  failed.plant().fail_switch(0, true, false);
  ASSERT_TRUE(failed.plant().set_gates(a_to_b()));
  ASSERT_TRUE(opened.plant().set_gates(gates({false, false, false}, {false, true, false})));
  for (HeldGeneral* held : {&failed, &opened}) ASSERT_EQ(run_to(*held, 6e-4), sim::Stop::end);
  EXPECT_EQ(failed.plant().state().i[0], opened.plant().state().i[0]);
  EXPECT_GT(failed.plant().state().i[0], 5);
  EXPECT_EQ(failed.plant().mode().legs[0], plant::Connection::low_diode);
}

TEST(GeneralWinding, AShortedSwitchIsOnForEverAndTheOtherGateIsToldBeforeItShoots) {
  HeldGeneral held(GeneralSetup{}, all_off());
  held.plant().fail_switch(0, true, true);
  ASSERT_TRUE(held.plant().set_gates(all_off()));
  ASSERT_EQ(run_to(held, 1e-4), sim::Stop::end);
  EXPECT_EQ(held.plant().mode().legs[0], plant::Connection::high_switch);
  ASSERT_TRUE(held.plant().set_gates(gates({false, false, false}, {false, true, false})));
  ASSERT_EQ(run_to(held, 2e-4), sim::Stop::end);
  EXPECT_GT(held.plant().state().i[0], 1);
  EXPECT_FALSE(held.plant().set_gates(gates({false, false, false}, {true, false, false})));
}

}  // namespace SIXSTEP_TEST_FILE

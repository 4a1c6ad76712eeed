// SPDX-License-Identifier: Apache-2.0
// The general kernel is compared with closed forms (model.md 7 to 9). The kernel uses none of these formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/plant/general/audit.hpp"
#include "sixstep/plant/terminals.hpp"
#include "tests/support/general.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;

constexpr double digits = 1e-12;

/// A rotor with all gates off, without friction and load.
GeneralSetup free_rotor(double speed_rad_s) {
  GeneralSetup s;
  s.shaft.B_Nm_s = 0;
  s.start.speed_rad_s = speed_rad_s;
  return s;
}

TEST(GeneralClosedForms, ADeltaWithoutHarmonicsIsTheStarOfAThirdAtItsTerminals) {
  Board board = Board::duty(0.5);
  board.machine.back_emf = plant::BackEmf::sine;
  GeneralSetup delta;
  const double K = std::sqrt(3.0) * 0.01675, L = 3 * 0.286e-3;
  delta.machine = {.winding = general::Winding::delta,
                   .R_ohm = {3 * 0.515, 3 * 0.515, 3 * 0.515},
                   .K_e_V_s = {K, K, K},
                   .L_H = 0.8 * L,
                   .M_H = -0.2 * L,
                   .pole_pairs = 8,
                   .shape = {.harmonics = {{1, 1.0}}}};
  auto star = board.rig();
  auto wound = general_rig(delta, board);
  for (int row = 1; row <= 100; ++row) {
    ASSERT_EQ(run_to(star, row * 0.5e-3), sim::Stop::end);
    ASSERT_EQ(run_to(wound, row * 0.5e-3), sim::Stop::end);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(wound.plant().state().i[k], star.plant().state().i[k], 1e-10);
    EXPECT_NEAR(wound.plant().state().w, star.plant().state().w, 1e-10);
  }
}

TEST(GeneralClosedForms, TheLoopCurrentOfADeltaIsAnRLCircuitOnTheThirdHarmonic) {
  GeneralSetup s = free_rotor(20);
  const double R = 1.5, L = 0.9e-3, M = -0.1e-3, K = 0.03, c3 = 0.2, w = 20;
  s.machine = {.winding = general::Winding::delta,
               .R_ohm = {R, R, R},
               .K_e_V_s = {K, K, K},
               .L_H = L,
               .M_H = M,
               .pole_pairs = 8,
               .shape = {.harmonics = {{1, 1.0}, {3, c3}}}};
  s.shaft.J_kg_m2 = 1e12;  // the speed is constant
  HeldGeneral held(s);
  // The sum S of the three currents starts at 0 and follows 0 = R S + (L + 2 M) dS/dt + 3 c3 K w cos(3 (theta
  // + 30 - 60 deg)). The last term is 3 c3 K w sin 3 theta.
  const double rate = 3 * 8 * w, X = (L + 2 * M) * rate, e = 3 * c3 * K * w, Z2 = R * R + X * X;
  for (const double t : {1e-4, 1e-3, 7e-3, 20e-3}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const double steady = -e / Z2 * (R * std::sin(rate * t) - X * std::cos(rate * t));
    const double start = -e / Z2 * X * std::exp(-R / (L + 2 * M) * t);
    EXPECT_NEAR(held.plant().more().loop.value, steady + start, digits);
  }
}

TEST(GeneralClosedForms, TwoMassesOnASpringSwingAtTheirResonance) {
  const double w0 = 3, J1 = 1.35e-5, J2 = 4e-5, k = 2, n = 2, own = J2 / (n * n);
  GeneralSetup s = free_rotor(w0);
  s.shaft.gear = n;
  s.shaft.load_J_kg_m2 = J2;
  s.shaft.stiffness_Nm = k;
  HeldGeneral held(s);
  const double resonance = std::sqrt(k / (n * n) * (1 / J1 + 1 / own)), mean = J1 * w0 / (J1 + own);
  for (const double t : {1e-4, 1e-3, 5e-3, 20e-3}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const double swing = w0 * std::cos(resonance * t);
    EXPECT_NEAR(held.plant().state().w, mean + own / (J1 + own) * swing, digits * w0 * 10);
    EXPECT_NEAR(held.plant().more().load_w.value * n, mean - J1 / (J1 + own) * swing, digits * w0 * 10);
  }
}

TEST(GeneralClosedForms, AGearReflectsWhatHangsOnIt) {
  Board lean = Board::duty(0.4);
  lean.shaft.J_kg_m2 += 9e-5 / 9;
  lean.shaft.B_Nm_s += 2e-5 / 9;
  lean.load(5'000'000'000, 0.06 / 3);
  GeneralSetup s;
  s.shaft.gear = 3;
  s.shaft.load_J_kg_m2 = 9e-5;
  s.shaft.load_B_Nm_s = 2e-5;
  Board board = Board::duty(0.4);
  board.load(5'000'000'000, 0.06);
  auto direct = lean.rig();
  auto geared = general_rig(s, board);
  for (int row = 1; row <= 60; ++row) {
    ASSERT_EQ(run_to(direct, row * 0.5e-3), sim::Stop::end);
    ASSERT_EQ(run_to(geared, row * 0.5e-3), sim::Stop::end);
    EXPECT_NEAR(geared.plant().state().w, direct.plant().state().w, 1e-10);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(geared.plant().state().i[k], direct.plant().state().i[k], 1e-10);
  }
}

TEST(GeneralClosedForms, AFanAloneSlowsTheRotorHyperbolically) {
  for (const double w0 : {30.0, -30.0}) {
    GeneralSetup s = free_rotor(w0);
    s.shaft.load.fan_Nm_s2 = 3e-6;
    HeldGeneral held(s);
    for (const double t : {0.01, 0.1, 1.0}) {
      ASSERT_EQ(run_to(held, t), sim::Stop::end);
      EXPECT_NEAR(held.plant().state().w, w0 / (1 + 3e-6 * std::fabs(w0) * t / 1.35e-5), digits * 30);
    }
  }
}

TEST(GeneralClosedForms, AWeightOnAnArmKeepsItsEnergy) {
  GeneralSetup s = free_rotor(0);
  s.shaft.load = {.gravity_Nm = 2e-4, .gravity_angle_rad = 0.4};
  HeldGeneral held(s);
  for (const double t : {0.05, 0.2, 0.7, 2.0}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const auto& q = held.plant().state();
    const double angle = (static_cast<double>(q.sector) * base::sector_rad + q.x) / 8;
    const double fallen = 2e-4 * (std::cos(angle - 0.4) - std::cos(0.4));
    EXPECT_NEAR(1.35e-5 * q.w * q.w / 2, fallen, 1e-16) << t;
    EXPECT_GT(std::fabs(q.w), 0.01);
  }
}

TEST(GeneralClosedForms, CoggingIsAWell) {
  GeneralSetup s = free_rotor(0);
  s.machine.cogging = {{48, 1e-4, 0.7}};
  HeldGeneral held(s);
  for (const double t : {0.01, 0.03, 0.11}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    const auto& q = held.plant().state();
    const double angle = (static_cast<double>(q.sector) * base::sector_rad + q.x) / 8;
    EXPECT_NEAR(1.35e-5 * q.w * q.w / 2, 1e-4 / 48 * (std::cos(0.7) - std::cos(48 * angle + 0.7)), 1e-17)
        << t;
  }
}

TEST(GeneralClosedForms, TwoPhasesOfALockedRotorThatStrayCarryWhatBothLeave) {
  GeneralSetup s;
  s.shaft.locked = true;
  s.machine.R_ohm = {0.6, 0.4, 0.515};
  s.devices = {.igbt = true, .R_on_ohm = 0.02, .V_ce_V = 0.9, .V_f_V = 0.8, .r_d_ohm = 0.015};
  HeldGeneral held(s, a_to_b());
  const double R = 1.0 + 0.04, L = 2 * 0.286e-3, U = 24 - 1.8;
  for (const double t : {1e-4, 5e-4, 2e-3}) {
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().i[0], U / R * (1 - std::exp(-t * R / L)), digits * 20);
    EXPECT_EQ(held.plant().state().i[2], 0);
  }
}

TEST(GeneralClosedForms, ASalientRotorShowsItsAxisInTheSlopeOfTheCurrent) {
  for (const double electrical_deg : {10.0, 77.0, 144.0, 301.0}) {
    GeneralSetup s;
    s.shaft.locked = true;
    s.machine.shape.harmonics = {{1, 1.0}};
    s.machine.L_d_H = 0.24e-3;
    s.machine.L_q_H = 0.34e-3;
    s.start.angle_rad = at_electrical_deg(electrical_deg);
    HeldGeneral held(s, a_to_b());
    // With i_a = -i_b, equation (7) gives lambda_a - lambda_b = 2 (L_S - L_D cos(2 theta_d - 120 deg)) i.
    const double turned = (2 * (electrical_deg - 150) - 120) * base::pi / 180;
    const double L = 2 * (0.29e-3 + 0.05e-3 * std::cos(turned)), R = 1.03, t = 3e-4;
    ASSERT_EQ(run_to(held, t), sim::Stop::end);
    EXPECT_NEAR(held.plant().state().i[0], 24 / R * (1 - std::exp(-t * R / L)), digits * 20)
        << electrical_deg;
  }
}

TEST(GeneralClosedForms, ABrakeResistorEmptiesTheBusUntilItIsOff) {
  GeneralSetup s;
  s.supply = {.V_0_V = 24,
              .R_b_ohm = 0.1,
              .C_F = 1e-3,
              .sinks = false,
              .brake_ohm = 2,
              .brake_on_V = 30,
              .brake_off_V = 28};
  s.start.bus_V = 31;
  HeldGeneral held(s);
  ASSERT_EQ(run_to(held, 0.1e-3), sim::Stop::end);  // R C ln(31/28) = 0.2036 ms
  EXPECT_NEAR(held.plant().state().bus, 31 * std::exp(-0.05), digits * 30);
  ASSERT_EQ(run_to(held, 1e-3), sim::Stop::end);
  EXPECT_NEAR(held.plant().state().bus, 28, digits * 30);
}

TEST(GeneralClosedForms, AWireThatBreaksWhileItCarriesCurrentOpensAtTheNextZero) {
  GeneralSetup s;
  s.shaft.locked = true;
  HeldGeneral held(s, a_to_b());
  ASSERT_EQ(run_to(held, 1e-3), sim::Stop::end);
  held.plant().break_wire(0);
  ASSERT_EQ(run_to(held, 1.1e-3), sim::Stop::end);
  EXPECT_GT(held.plant().state().i[0], 18.0) << "it never comes to zero by itself";
  held.plant().set_gates(all_off());
  ASSERT_EQ(run_to(held, 5e-3), sim::Stop::end);
  held.plant().set_gates(a_to_b());
  ASSERT_EQ(run_to(held, 6e-3), sim::Stop::end);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(held.plant().state().i[k], 0);
}

// A terminal with a broken wire is connected to no rail. The other two terminals are symmetric about the
// middle of their rails. The voltage of the third terminal then follows from the back-EMFs of the windings.
TEST(GeneralClosedForms, AStarBehindABrokenWireHangsMidwayBetweenTheOthersRails) {
  for (unsigned broken = 0; broken < 3; ++broken) {
    HeldGeneral held(free_rotor(300));
    held.plant().break_wire(static_cast<int>(broken));
    for (int n = 1; n <= 24; ++n) {  // over a turn of the field and more
      ASSERT_EQ(run_to(held, n * 0.15e-3), sim::Stop::end);
      auto& plant = held.plant();
      ASSERT_GE(plant.expand(1e-9), 0);
      const plant::Snapshot<double> now = plant.at(0);
      ASSERT_EQ(plant.dead(), 1U << broken);
      const std::size_t j = (broken + 1) % 3, k = (broken + 2) % 3;
      EXPECT_NEAR(now.pole[j] + now.pole[k], now.bus, 1e-12 * now.bus);
      EXPECT_NEAR(now.pole[broken] - now.pole[j], now.emf[broken] - now.emf[j], 1e-12 * now.bus);
      EXPECT_NEAR(plant::terminal_series(plant, 1e-9)[broken][0], now.pole[broken], 1e-12 * now.bus);
    }
  }
}

TEST(GeneralClosedForms, TheBooksCloseWithEverythingAtOnce) {
  GeneralSetup s;
  s.machine = {.winding = general::Winding::delta,
               .R_ohm = {1.545, 1.545, 1.545},
               .K_e_V_s = {0.0287, 0.0287, 0.0287},
               .L_H = 0.7e-3,
               .M_H = -0.1e-3,
               .pole_pairs = 8,
               .cogging = {{48, 0.004, 0.3}}};
  s.shaft = {.J_kg_m2 = 1.35e-5,
             .B_Nm_s = 7.3e-6,
             .coulomb_Nm = 0.003,
             .gear = 2,
             .load_J_kg_m2 = 5e-5,
             .load_B_Nm_s = 1e-5,
             .stiffness_Nm = 3,
             .damping_Nm_s = 1e-4,
             .load = {.torque_Nm = 0.02, .fan_Nm_s2 = 1e-6, .gravity_Nm = 0.01}};
  s.devices = {.igbt = true, .R_on_ohm = 0.02, .V_ce_V = 0.9, .V_f_V = 0.8, .r_d_ohm = 0.015};
  s.supply = {.V_0_V = 24, .R_b_ohm = 0.1, .L_b_H = 5e-6, .C_F = 470e-6, .sinks = false};
  auto rig = general_rig(s, Board::duty(0.6));
  struct Watch {
    general::Audit<double> audit;
    void segment(const GeneralRig& r, double to) { audit.segment(r.plant(), to); }
  } watch;
  ASSERT_EQ(run_to(rig, 0.1, watch), sim::Stop::end);
  const plant::EnergyBook book = watch.audit.energy();
  EXPECT_GT(book.supplied, 1.0);
  EXPECT_LT(std::fabs(book.electrical_residual), 1e-13);
  EXPECT_LT(std::fabs(book.mechanical_residual), 1e-13);
  EXPECT_LT(watch.audit.laws().reverse_diode_A, 1e-12);
  EXPECT_LT(watch.audit.laws().current_sum_A, 1e-12);
  EXPECT_EQ(watch.audit.laws().floating_current_A, 0);
}

}  // namespace SIXSTEP_TEST_FILE

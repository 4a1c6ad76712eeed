// SPDX-License-Identifier: Apache-2.0
// The matrices of the thesis are compared with the explicit equations of model.md 1, with each other, and
// with the energy balance. With the signs that the thesis prints (model.md 13), the energy does not balance.
#include "sixstep/design/thesis/thesis_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::design;

constexpr double eps = 0x1p-52;
constexpr std::uint32_t seed = 311;

struct State {
  plant::Machine machine{.R_ohm = 0.515, .L_H = 0.286e-3, .K_e_V_s = 0.01675, .pole_pairs = 8};
  plant::Shaft shaft{.J_kg_m2 = 1.35e-5, .B_Nm_s = 7.3e-6};
  double i_a = 0, i_b = 0, i_c = 0, w = 0, theta_m = 0, u_a = 0, u_b = 0, u_c = 0, T_load = 0;
  base::Abc<double> f;

  base::MechanicalAngle angle() const { return {theta_m}; }
  double K() const { return machine.K_e_V_s; }
};

/// A random state of a star with random terminal voltages. Every fourth machine has a sine shape, and every
/// third machine has another flat width.
State random_state(std::mt19937_64& random, int n) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  State s;
  if (n % 4 == 0) s.machine.back_emf = plant::BackEmf::sine;
  if (n % 3 == 0) s.machine.flat_deg = 90.0 + 80.0 * any(random);
  s.i_a = 30 * any(random);
  s.i_b = 30 * any(random);
  s.i_c = -s.i_a - s.i_b;
  s.w = 900 * any(random);
  s.theta_m = 100 * any(random);
  s.u_a = 24 * any(random);
  s.u_b = 24 * any(random);
  s.u_c = 24 * any(random);
  s.T_load = any(random);
  s.f = back_emf_shape(s.machine, base::PolePairs{8}.electrical(s.angle()));
  return s;
}

/// If all legs are connected, the star point's voltage is the mean of u_k - e_k (model.md (5)).
double star_voltage(const State& s) {
  return (s.u_a + s.u_b + s.u_c - s.K() * s.w * (s.f.a + s.f.b + s.f.c)) / 3.0;
}

TEST(ThesisModels, PhaseVoltageFormIsModelOne) {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 2000; ++n) {
    const State s = random_state(random, n);
    const auto& m = s.machine;
    const double u_n = star_voltage(s);
    const auto rate = phase_voltage_model(m, s.shaft, s.angle())
                          .derivative({s.i_a, s.i_b, s.i_c, s.w, s.theta_m},
                                      {s.u_a - u_n, s.u_b - u_n, s.u_c - u_n, s.T_load});
    const double scale = (48 + 31 * m.R_ohm + 900 * m.K_e_V_s) / m.L_H;  // scale of the summed terms
    EXPECT_NEAR(rate[0], (s.u_a - u_n - m.R_ohm * s.i_a - s.K() * s.w * s.f.a) / m.L_H, 8 * eps * scale);
    EXPECT_NEAR(rate[1], (s.u_b - u_n - m.R_ohm * s.i_b - s.K() * s.w * s.f.b) / m.L_H, 8 * eps * scale);
    EXPECT_NEAR(rate[2], (s.u_c - u_n - m.R_ohm * s.i_c - s.K() * s.w * s.f.c) / m.L_H, 8 * eps * scale);
    const double T_e = electromagnetic_torque(m, s.f, {s.i_a, s.i_b, s.i_c});
    EXPECT_NEAR(rate[3], (T_e - s.shaft.B_Nm_s * s.w - s.T_load) / s.shaft.J_kg_m2,
                16 * eps * 3.0 / s.shaft.J_kg_m2);
    EXPECT_EQ(rate[4], s.w);
    EXPECT_NEAR(rate[0] + rate[1] + rate[2], 0.0, 16 * eps * scale) << "seed " << seed << " state " << n;
  }
}

TEST(ThesisModels, TerminalVoltageFormIsTheSameMachine) {
  std::mt19937_64 random{seed};
  for (int n = 0; n < 2000; ++n) {
    const State s = random_state(random, n);
    const double u_n = star_voltage(s);
    const auto five = phase_voltage_model(s.machine, s.shaft, s.angle())
                          .derivative({s.i_a, s.i_b, s.i_c, s.w, s.theta_m},
                                      {s.u_a - u_n, s.u_b - u_n, s.u_c - u_n, s.T_load});
    const auto four =
        terminal_voltage_model(s.machine, s.shaft, s.angle())
            .derivative({s.i_a, s.i_b, s.w, s.theta_m}, {s.u_a - s.u_b, s.u_b - s.u_c, s.T_load});
    const double scale = 100.0 / s.machine.L_H;
    EXPECT_NEAR(four[0], five[0], 8 * eps * scale) << "seed " << seed << " state " << n;
    EXPECT_NEAR(four[1], five[1], 8 * eps * scale);
    EXPECT_NEAR(four[2], five[3], 16 * eps * 3.0 / s.shaft.J_kg_m2);
    EXPECT_EQ(four[3], five[4]);
  }
}

/// The rate of the stored energy, (L/2) sum i^2 + (J/2) w^2, plus the losses, minus the input power. The
/// result is zero for a physically possible machine.
double unbalanced_W(const StateSpace<5, 4>& model, const State& s) {
  const double u_n = star_voltage(s);
  const auto r = model.derivative({s.i_a, s.i_b, s.i_c, s.w, s.theta_m},
                                  {s.u_a - u_n, s.u_b - u_n, s.u_c - u_n, s.T_load});
  const double stored =
      s.machine.L_H * (s.i_a * r[0] + s.i_b * r[1] + s.i_c * r[2]) + s.shaft.J_kg_m2 * s.w * r[3];
  const double lost =
      s.machine.R_ohm * (s.i_a * s.i_a + s.i_b * s.i_b + s.i_c * s.i_c) + s.shaft.B_Nm_s * s.w * s.w;
  return stored + lost + s.T_load * s.w - (s.u_a * s.i_a + s.u_b * s.i_b + s.u_c * s.i_c);
}

TEST(ThesisModels, PowerBalancesAndThePrintedSignsDoNot) {
  std::mt19937_64 random{seed};
  double printed_sign = 0.0, printed_speed_row = 0.0, printed_factor = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const State s = random_state(random, n);
    // The power sum e_k i_k = T_e w leaves the circuit and accelerates the shaft.
    const double e_i =
        s.K() * s.w * s.f.a * s.i_a + s.K() * s.w * s.f.b * s.i_b + s.K() * s.w * s.f.c * s.i_c;
    EXPECT_NEAR(e_i, electromagnetic_torque(s.machine, s.f, {s.i_a, s.i_b, s.i_c}) * s.w, 16 * eps * 1500);
    const auto right = phase_voltage_model(s.machine, s.shaft, s.angle());
    EXPECT_NEAR(unbalanced_W(right, s), 0.0, 64 * eps * 6000) << "seed " << seed << " state " << n;
    auto wrong = right;  // 3.11 A: + K_t f/(L - M) in the current rows
    for (int k = 0; k < 3; ++k) wrong.A[k][3] = -wrong.A[k][3];
    printed_sign = std::max(printed_sign, std::abs(unbalanced_W(wrong, s)));
    wrong = right;  // 3.11 A: K_t f/(L - M) in the speed row
    for (int k = 0; k < 3; ++k) wrong.A[3][k] *= s.shaft.J_kg_m2 / s.machine.L_H;
    printed_speed_row = std::max(printed_speed_row, std::abs(unbalanced_W(wrong, s)));
    wrong = right;  // 3.4: e = w_e K_t/2, p times too large
    for (int k = 0; k < 3; ++k) wrong.A[k][3] *= s.machine.pole_pairs;
    printed_factor = std::max(printed_factor, std::abs(unbalanced_W(wrong, s)));
  }
  EXPECT_GT(printed_sign, 100.0);
  EXPECT_GT(printed_speed_row, 100.0);
  EXPECT_GT(printed_factor, 100.0);
}

TEST(ThesisModels, EigenvaluesAreTheTimeConstantsOfTheMachine) {
  // At a fixed angle, the eigenvalue is -R/L for every current pattern without torque. For the pattern f, the
  // eigenvalues are the roots of lambda^2 + (R/L + B/J) lambda + (R B + K_e^2 |f|^2)/(L J) = 0. Their
  // eigenvectors are (f, 0) with the speed w = -(L lambda + R)/K_e.
  const State s;
  const auto& m = s.machine;
  for (const double theta_m : {0.0, 0.02, 0.1, 0.3, 0.77}) {
    const auto f = back_emf_shape(m, base::PolePairs{8}.electrical({theta_m}));
    const double square = f.a * f.a + f.b * f.b + f.c * f.c;
    const double half = (m.R_ohm / m.L_H + s.shaft.B_Nm_s / s.shaft.J_kg_m2) / 2;
    const double product =
        (m.R_ohm * s.shaft.B_Nm_s + m.K_e_V_s * m.K_e_V_s * square) / (m.L_H * s.shaft.J_kg_m2);
    for (const double lambda :
         {-half - std::sqrt(half * half - product), -half + std::sqrt(half * half - product)}) {
      const double w = -(m.L_H * lambda + m.R_ohm) / m.K_e_V_s;
      const auto rate = phase_voltage_model(m, s.shaft, {theta_m}).derivative({f.a, f.b, f.c, w, 0.0}, {});
      EXPECT_NEAR(rate[0], lambda * f.a, 1e-11 * half);
      EXPECT_NEAR(rate[1], lambda * f.b, 1e-11 * half);
      EXPECT_NEAR(rate[2], lambda * f.c, 1e-11 * half);
      EXPECT_NEAR(rate[3], lambda * w, 1e-11 * half * std::abs(w) + 1e-9);
      EXPECT_LT(lambda, 0.0);
    }
    const auto idle = phase_voltage_model(m, s.shaft, {theta_m})
                          .derivative({f.b - f.c, f.c - f.a, f.a - f.b, 0.0, 0.0}, {});
    EXPECT_NEAR(idle[0], -m.R_ohm / m.L_H * (f.b - f.c), 1e-12 * half);
    EXPECT_NEAR(idle[3], 0.0, 16 * eps * m.K_e_V_s / s.shaft.J_kg_m2);
  }
}

TEST(Trapezoid, HasItsTopsRampsAndSymmetry) {
  const auto at = [](double deg, double flat) { return trapezoid({deg * base::pi / 180.0}, flat); };
  for (const double deg : {1.0, 30.0, 60.0, 119.0, 361.0, -300.0}) EXPECT_EQ(at(deg, 120.0), 1.0) << deg;
  for (const double deg : {181.0, 240.0, 299.0, -60.0, -120.0}) EXPECT_EQ(at(deg, 120.0), -1.0) << deg;
  EXPECT_NEAR(at(150.0, 120.0), 0.0, 1e-14);
  EXPECT_NEAR(at(135.0, 120.0), 0.5, 1e-14);
  EXPECT_NEAR(at(-30.0, 120.0), 0.0, 1e-14);
  EXPECT_NEAR(at(60.0 + 60.0, 60.0), 0.5, 1e-14);  // ramp of 120 degrees from 90 to 210
  for (double deg = -400.0; deg < 400.0; deg += 0.37)
    EXPECT_NEAR(at(deg, 100.0), -at(deg + 180.0, 100.0), 1e-13);
}

}  // namespace SIXSTEP_TEST_FILE

// SPDX-License-Identifier: Apache-2.0
// The thesis's two models of the machine (chapter 3, errata applied) as state spaces x' = A(theta) x + B u,
// without bridge and diodes. Textbooks integrate such models; tests compare the simulator's plant with them.
#pragma once
#include <array>
#include <cstddef>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/frame.hpp"
#include "sixstep/plant/machine.hpp"

namespace sixstep::design {

template <std::size_t Rows, std::size_t Columns>
using Matrix = std::array<std::array<double, Columns>, Rows>;

template <std::size_t States, std::size_t Inputs>
struct StateSpace {
  Matrix<States, States> A{};
  Matrix<States, Inputs> B{};

  /// x' = A x + B u
  std::array<double, States> derivative(const std::array<double, States>& x,
                                        const std::array<double, Inputs>& u) const {
    std::array<double, States> rate{};
    for (std::size_t row = 0; row < States; ++row) {
      for (std::size_t k = 0; k < States; ++k) rate[row] += A[row][k] * x[k];
      for (std::size_t k = 0; k < Inputs; ++k) rate[row] += B[row][k] * u[k];
    }
    return rate;
  }
};

/// Trapezoid of peak 1: +1 within flat/2 of theta_e = 60 degrees, -1 half a turn later, with straight ramps
/// between (model.md 1).
double trapezoid(base::ElectricalAngle theta_e, double flat_deg = 120.0);

/// Shapes f_a, f_b, f_c of the machine at this angle: the same shape, each phase 120 degrees later than the
/// phase before.
base::Abc<double> back_emf_shape(const plant::Machine& machine, base::ElectricalAngle theta_e);

/// Torque, N m: T_e = K_e sum f_k i_k (model.md (3)), defined at standstill too.
double electromagnetic_torque(const plant::Machine& machine, const base::Abc<double>& f,
                              const base::Abc<double>& i_A);

/// Thesis 3.11. States: i_a, i_b, i_c (A), w_m (rad/s), theta_m (rad). Inputs: u_an, u_bn, u_cn against the
/// star point (V), T_load (N m). i_a + i_b + i_c stays 0 only if the sum of the voltages equals the sum of
/// the back-EMFs, as at a real star point.
StateSpace<5, 4> phase_voltage_model(const plant::Machine& machine, const plant::Shaft& shaft,
                                     base::MechanicalAngle theta_m);

/// Thesis 3.16. States: i_a, i_b (A), w_m (rad/s), theta_m (rad). Inputs: u_ab, u_bc (V), T_load (N m).
StateSpace<4, 3> terminal_voltage_model(const plant::Machine& machine, const plant::Shaft& shaft,
                                        base::MechanicalAngle theta_m);

}  // namespace sixstep::design

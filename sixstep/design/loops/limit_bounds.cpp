// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/limit_bounds.hpp"

#include <cmath>

namespace sixstep::design {

double torque_per_A(const plant::Machine& machine) {
  return (machine.back_emf == plant::BackEmf::sine ? std::sqrt(3.0) : 2.0) * machine.K_e_V_s;
}

double most_current_A(const LimitSetting& s) {
  const double emf_V = torque_per_A(s.machine) * s.speed_rad_s;
  return 1.25 * s.current_A + 4.0 / 3 * (s.bus_V + emf_V) * s.period_s / (2 * s.machine.L_H);
}

double most_speed_rad_s(const LimitSetting& s, double limit_rad_s, double late_rad) {
  const double current = most_current_A(s), per_A = torque_per_A(s.machine) / s.J_kg_m2;
  const double reached = std::sqrt(limit_rad_s * limit_rad_s + 2 * per_A * current * late_rad);
  const double runs_out = 2 * s.machine.L_H * current * current / (2 * s.bus_V);
  return reached + per_A * (current * s.period_s + runs_out);
}

double most_bus_V(const LimitSetting& s, double limit_V, double capacitance_F) {
  const double current = most_current_A(s), emf_V = torque_per_A(s.machine) * s.speed_rad_s;
  const double above = limit_V + current * s.period_s / capacitance_F - emf_V;
  return emf_V + std::sqrt(above * above + 2 * s.machine.L_H * current * current / capacitance_F);
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/thesis/thesis_models.hpp"

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::design {
double trapezoid(base::ElectricalAngle theta_e, double flat_deg) {
  const double turns = theta_e.rad / base::turn_rad;
  const double deg = (turns - std::floor(turns)) * 360.0;
  // The trapezoid is symmetric about the middle of its positive top, and odd about the angle 90 degrees from
  // this middle.
  double from_top = std::abs(deg - 60.0);
  if (from_top > 180.0) from_top = 360.0 - from_top;
  const double ramp = 90.0 - flat_deg / 2.0;
  const double height = (90.0 - from_top) / ramp;
  return height > 1.0 ? 1.0 : (height < -1.0 ? -1.0 : height);
}

base::Abc<double> back_emf_shape(const plant::Machine& m, base::ElectricalAngle theta_e) {
  const double third = base::turn_rad / 3.0;
  if (m.back_emf == plant::BackEmf::sine) {
    const double top = base::turn_rad / 6.0;  // the sine of phase a is cos(theta - 60 degrees); phases b and
                                              // c follow by 120 and 240 degrees
    return {base::cos(theta_e.rad - top), base::cos(theta_e.rad - top - third),
            base::cos(theta_e.rad - top - 2.0 * third)};
  }
  return {trapezoid(theta_e, m.flat_deg), trapezoid({theta_e.rad - third}, m.flat_deg),
          trapezoid({theta_e.rad - 2.0 * third}, m.flat_deg)};
}

double electromagnetic_torque(const plant::Machine& m, const base::Abc<double>& f,
                              const base::Abc<double>& i) {
  return m.K_e_V_s * (f.a * i.a + f.b * i.b + f.c * i.c);
}

// Thesis 3.11, corrected. The back-EMF enters the current rows with a minus and K_t/2, because it opposes the
// current. The torque enters the speed row divided by J, and the load's factor -1/J is in the speed row. Each
// phase has the factor 1/(L - M). The thesis's last state is theta_e, whose derivative is p w; here it is
// theta_m, whose derivative is w.
//   L i_k' = u_kn - R i_k - K_e f_k w      J w' = K_e sum f_k i_k - B w - T_load      theta_m' = w
StateSpace<5, 4> phase_voltage_model(const plant::Machine& m, const plant::Shaft& s,
                                     base::MechanicalAngle theta_m) {
  const double R = m.R_ohm, L = m.L_H, K_e = m.K_e_V_s, J = s.J_kg_m2, B = s.B_Nm_s;
  const base::Abc<double> shape = back_emf_shape(m, base::PolePairs{m.pole_pairs}.electrical(theta_m));
  const std::array<double, 3> f{shape.a, shape.b, shape.c};
  StateSpace<5, 4> model;
  for (std::size_t k = 0; k < 3; ++k) {
    model.A[k][k] = -R / L;
    model.A[k][3] = -K_e * f[k] / L;
    model.A[3][k] = K_e * f[k] / J;
    model.B[k][k] = 1.0 / L;
  }
  model.A[3][3] = -B / J;
  model.A[4][3] = 1.0;
  model.B[3][3] = -1.0 / J;
  return model;
}

// Thesis 3.15 and 3.16, corrected: u_bc - e_bc = R (2 i_b + i_a) + L (2 i_b' + i_a') because i_c = -i_a -
// i_b. Solved for the derivatives,
//   i_a' = -R/L i_a + (2 (u_ab - e_ab) + (u_bc - e_bc))/(3 L)
//   i_b' = -R/L i_b + ((u_bc - e_bc) - (u_ab - e_ab))/(3 L)
// with e_ab = K_e (f_a - f_b) w, e_bc = K_e (f_b - f_c) w, and T_e = K_e ((f_a - f_c) i_a + (f_b - f_c) i_b).
StateSpace<4, 3> terminal_voltage_model(const plant::Machine& m, const plant::Shaft& s,
                                        base::MechanicalAngle theta_m) {
  const double R = m.R_ohm, L = m.L_H, K_e = m.K_e_V_s, J = s.J_kg_m2, B = s.B_Nm_s;
  const base::Abc<double> f = back_emf_shape(m, base::PolePairs{m.pole_pairs}.electrical(theta_m));
  const double K_ab = K_e * (f.a - f.b), K_bc = K_e * (f.b - f.c), K_ca = K_e * (f.c - f.a);
  StateSpace<4, 3> model;
  model.A = {{{-R / L, 0.0, -(2.0 * K_ab + K_bc) / (3.0 * L), 0.0},
              {0.0, -R / L, -(K_bc - K_ab) / (3.0 * L), 0.0},
              {-K_ca / J, K_bc / J, -B / J, 0.0},
              {0.0, 0.0, 1.0, 0.0}}};
  model.B = {{{2.0 / (3.0 * L), 1.0 / (3.0 * L), 0.0},
              {-1.0 / (3.0 * L), 1.0 / (3.0 * L), 0.0},
              {0.0, 0.0, -1.0 / J},
              {0.0, 0.0, 0.0}}};
  return model;
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
// What the general kernel is given (model.md 7 to 9): windings that are not alike, delta, saliency, back-EMF by
// harmonics or as a table, cogging, an elastic shaft with a load of its own, IGBTs, a supply with an inductance and a brake
// chopper. SI units. What has its default is not there.
#pragma once
#include <vector>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant::general {

/// c cos(n (theta - 60 deg)), n odd: a part of the back-EMF's shape.
struct Harmonic {
  int order = 1;
  double size = 1.0;
};

/// A point of a shape given as a table: piecewise linear between, periodic over one electrical turn.
struct ShapePoint {
  double angle_deg = 0.0;  ///< electrical, in [0, 360), rising
  double value = 0.0;
};

/// The shape f of the back-EMF over the electrical angle (model.md 7): one of trapezoid, harmonics, table.
struct Shape {
  double flat_deg = 120.0;            ///< of the trapezoid, where the two below are empty
  std::vector<Harmonic> harmonics{};  ///< a sine is {1, 1.0}
  std::vector<ShapePoint> table{};
};

/// C sin(order theta_m + phase), N m. order: per mechanical turn, a multiple of the pole pairs.
struct Cogging {
  int order = 0;
  double torque_Nm = 0.0;
  double phase_rad = 0.0;
};

enum class Winding : std::uint8_t { star, delta };

struct Machine {
  Winding winding = Winding::star;
  PerLeg<double> R_ohm{};           ///< per phase; delta: of the branches ab, bc, ca, all alike
  PerLeg<double> K_e_V_s{};         ///< peak EMF of a shape of peak 1 per mechanical rad/s, likewise
  double L_H = 0.0;                 ///< star: L_s = L - M; delta: L_x of a branch
  double M_H = 0.0;                 ///< delta: between branches
  double L_d_H = 0.0, L_q_H = 0.0;  ///< star, in place of L_H where both are given
  int pole_pairs = 1;
  Shape shape{};
  std::vector<Cogging> cogging{};

  bool salient() const { return L_d_H > 0.0 && L_q_H > 0.0 && L_d_H != L_q_H; }
};

/// At the load's side of gear and coupling.
struct Load {
  double torque_Nm = 0.0;
  double fan_Nm_s2 = 0.0;   ///< k w|w|
  double gravity_Nm = 0.0;  ///< k sin(theta - angle)
  double gravity_angle_rad = 0.0;
};

struct Shaft {
  double J_kg_m2 = 0.0, B_Nm_s = 0.0;  ///< the motor's side
  double coulomb_Nm = 0.0, static_Nm = 0.0;
  double gear = 1.0;  ///< motor turns per load turn
  double load_J_kg_m2 = 0.0, load_B_Nm_s = 0.0;
  double stiffness_Nm = 0.0;  ///< N m/rad at the load's side; 0: rigid
  double damping_Nm_s = 0.0;
  Load load{};
  bool locked = false;

  bool elastic() const { return stiffness_Nm > 0.0; }
};

/// Without a gate both are alike; an IGBT's transistor carries one direction only (model.md 2).
struct Devices {
  bool igbt = false;
  double R_on_ohm = 0.0;              ///< MOSFET's channel, IGBT's r_ce
  double V_ce_V = 0.0;                ///< IGBT
  double V_f_V = 0.0, r_d_ohm = 0.0;  ///< diodes
};

/// source -> R_b (+ L_b) -> C -> bridge; a stiff bus where C is 0.
struct Supply {
  double V_0_V = 0.0, R_b_ohm = 0.0, L_b_H = 0.0, C_F = 0.0;
  bool sinks = true;
  double brake_ohm = 0.0;  ///< across the bus from on_V until off_V; 0: none
  double brake_on_V = 0.0, brake_off_V = 0.0;
};

/// At rest currents are zero; the load's side begins without twist.
struct Start {
  double speed_rad_s = 0.0, angle_rad = 0.0, bus_V = 0.0, source_A = 0.0;
};

}  // namespace sixstep::plant::general

// SPDX-License-Identifier: Apache-2.0
// Parameters of the general kernel (model.md 7 to 9): windings with different phases, delta, saliency,
// saturation, back-EMF by harmonics or as a table, cogging, gear and elastic shaft with a load of its own,
// IGBTs, a battery, mains or a source with an inductance, a brake chopper. SI units. A member with its
// default value has no effect.
#pragma once
#include <vector>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant::general {

/// One harmonic of the back-EMF's shape: c cos(n (theta - 60 deg)), n odd.
struct Harmonic {
  int order = 1;
  double size = 1.0;
};

/// A point of a shape given as a table: piecewise linear between points, periodic over one electrical turn.
struct ShapePoint {
  double angle_deg = 0.0;  ///< electrical, in [0, 360), rising
  double value = 0.0;
};

/// Shape f of the back-EMF over the electrical angle (model.md 7): a trapezoid, harmonics or a table.
struct Shape {
  double flat_deg = 120.0;            ///< flat width of the trapezoid, used if both lists below are empty
  std::vector<Harmonic> harmonics{};  ///< a sine is {1, 1.0}
  std::vector<ShapePoint> table{};
};

/// Cogging torque C sin(order theta_m + phase), N m. `order` is per mechanical turn, a whole multiple of the
/// pole pairs.
struct Cogging {
  double order = 0;
  double torque_Nm = 0.0;
  double phase_rad = 0.0;
};

enum class Winding : std::uint8_t { star, delta };

struct Machine {
  Winding winding = Winding::star;
  PerLeg<double> R_ohm{};    ///< per phase; delta: of the branches ab, bc, ca, all equal
  PerLeg<double> K_e_V_s{};  ///< peak back-EMF per mechanical rad/s of a shape of peak 1, per phase or branch
  double L_H = 0.0;          ///< star: L_s = L - M; delta: L_x of a branch
  double M_H = 0.0;          ///< delta: mutual inductance between branches
  double L_d_H = 0.0, L_q_H = 0.0;  ///< star: both replace L_H if both are given
  double saturation_A = 0.0;        ///< I_sat: lambda_d = L_d i_d (1 - i_d/(2 I_sat)); 0: none
  double pole_pairs = 1;            ///< for a linear motor pi/tau, with the pole pitch tau in m
  Shape shape{};
  std::vector<Cogging> cogging{};

  /// True if the fluxes of the magnet's two axes have their own laws, by saliency or saturation.
  bool has_axes() const { return L_d_H > 0.0 && L_q_H > 0.0 && (L_d_H != L_q_H || saturation_A > 0.0); }
};

/// A point of a torque over the load's speed: piecewise linear between points, constant beyond the ends.
struct TorquePoint {
  double speed_rad_s = 0.0;  ///< rising
  double torque_Nm = 0.0;    ///< positive against forward motion
};

/// Load torques at the load's side of gear and coupling.
struct Load {
  double torque_Nm = 0.0;
  double fan_Nm_s2 = 0.0;   ///< k of the torque k w|w|
  double gravity_Nm = 0.0;  ///< k of the torque k sin(theta - angle)
  double gravity_angle_rad = 0.0;
  std::vector<TorquePoint> over_speed{};
};

struct Shaft {
  double J_kg_m2 = 0.0, B_Nm_s = 0.0;  ///< motor's side only
  double coulomb_Nm = 0.0, static_Nm = 0.0;
  double gear = 1.0;        ///< motor turns per load turn
  double efficiency = 1.0;  ///< gear, in (0, 1]: torque of the driven side divided by its torque without
                            ///< losses
  double load_J_kg_m2 = 0.0, load_B_Nm_s = 0.0;
  double stiffness_Nm = 0.0;  ///< N m/rad at the load's side; 0: rigid
  double damping_Nm_s = 0.0;
  Load load{};
  bool locked = false;
  bool dynamometer = false;  ///< true: set_speed() imposes the load's speed, and its torque is a result

  bool elastic() const { return stiffness_Nm > 0.0; }
};

/// Without a gate, MOSFET and IGBT conduct alike. An IGBT's transistor carries one direction only (model.md
/// 2).
struct Devices {
  bool igbt = false;
  double R_on_ohm = 0.0;              ///< resistance of a MOSFET's channel, or an IGBT's r_ce
  double V_ce_V = 0.0;                ///< constant drop of an IGBT's transistor
  double V_f_V = 0.0, r_d_ohm = 0.0;  ///< constant drop and resistance of the diodes
};

/// Law of the source's open-circuit voltage V_0 over time and charge (model.md 9).
enum class Source : std::uint8_t { steady, battery, single_phase, three_phase };

/// A point of the open-circuit voltage over the charge: piecewise linear between points; the outermost lines
/// continue beyond the ends.
struct ChargePoint {
  double charge = 0.0;  ///< relative to the whole charge, rising
  double voltage_V = 0.0;
};

struct Battery {
  std::vector<ChargePoint> open_circuit{};
  double capacity_C = 0.0;            ///< the whole charge, A s
  double R_1_ohm = 0.0, C_1_F = 0.0;  ///< slow recovery of the voltage, in series; 0: none
  double charge = 1.0;                ///< charge at the start, relative to the whole
};

/// Mains behind a bridge of diodes, which never takes current back.
struct Mains {
  double peak_V = 0.0;  ///< single phase: of the line; three phases: between lines
  double frequency_Hz = 50.0, diode_drop_V = 0.0;
};

/// source -> R_b (+ L_b) -> C (+ R_C) -> bridge; a stiff bus where C is 0.
struct Supply {
  double V_0_V = 0.0, R_b_ohm = 0.0, L_b_H = 0.0, C_F = 0.0, R_C_ohm = 0.0;
  bool sinks = true;
  double sink_A = 0.0;     ///< if `sinks` is false: the largest current that the source takes back
  double brake_ohm = 0.0;  ///< resistor across the bus: on above brake_on_V until the bus is below
                           ///< brake_off_V; 0: none
  double brake_on_V = 0.0, brake_off_V = 0.0;
  Source source = Source::steady;
  Battery battery{};
  Mains mains{};
};

/// Start of a run. Currents are zero, and an elastic shaft has no twist.
struct Start {
  double speed_rad_s = 0.0, angle_rad = 0.0, bus_V = 0.0;
};

}  // namespace sixstep::plant::general

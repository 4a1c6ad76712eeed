// SPDX-License-Identifier: Apache-2.0
// Parameters of the general kernel (model.md 7 to 9), in SI units. A member with its default value has no
// effect.
// - winding: unequal phases, delta, saliency, saturation
// - back-EMF by harmonics or as a table, cogging
// - gear, elastic shaft, load
// - IGBTs
// - supply: battery, mains, inductance of the source, brake chopper
#pragma once
#include <vector>

#include "sixstep/plant/circuit.hpp"

namespace sixstep::plant::general {

/// One harmonic of the back-EMF's shape: size cos(order (theta - 60 deg)), with an odd order.
struct Harmonic {
  int order = 1;
  double size = 1.0;
};

/// A point of a back-EMF's shape that is given as a table. The shape is linear between points and periodic
/// with one electrical turn.
struct ShapePoint {
  double angle_deg = 0.0;  ///< electrical, in [0, 360), increasing from point to point
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
  PerLeg<double> R_ohm{};    ///< of the phases; delta: of the branches ab, bc, ca, which are equal
  PerLeg<double> K_e_V_s{};  ///< peak back-EMF of each phase or branch per mechanical rad/s, for a shape of
                             ///< peak 1
  double L_H = 0.0;          ///< star: L - M of a phase; delta: inductance of a branch
  double M_H = 0.0;          ///< delta: mutual inductance between branches
  double L_d_H = 0.0, L_q_H = 0.0;  ///< star: both replace L_H if both are given
  double saturation_A = 0.0;        ///< I_sat: lambda_d = L_d i_d (1 - i_d/(2 I_sat)); 0: no saturation
  double pole_pairs = 1;            ///< for a linear motor pi/tau, with the pole pitch tau in m
  Shape shape{};
  std::vector<Cogging> cogging{};

  /// True if the fluxes along and across the magnet's axis differ in their formula, by saliency or
  /// saturation.
  bool has_axes() const { return L_d_H > 0.0 && L_q_H > 0.0 && (L_d_H != L_q_H || saturation_A > 0.0); }
};

/// A point of a load torque over the load's speed. The torque is linear between points, and constant beyond
/// the first and the last point.
struct TorquePoint {
  double speed_rad_s = 0.0;  ///< increasing from point to point
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
  double efficiency = 1.0;  ///< of the gear, in (0, 1]: torque at the driven side divided by the torque
                            ///< without losses
  double load_J_kg_m2 = 0.0, load_B_Nm_s = 0.0;
  double stiffness_Nm = 0.0;  ///< N m/rad at the load's side; 0: rigid
  double damping_Nm_s = 0.0;
  Load load{};
  bool locked = false;
  bool dynamometer = false;  ///< true: set_speed() imposes the load's speed, and the load's torque is a
                             ///< result

  bool elastic() const { return stiffness_Nm > 0.0; }
};

/// With the gate off, MOSFET and IGBT conduct alike. An IGBT's transistor conducts one direction only
/// (model.md 2).
struct Devices {
  bool igbt = false;
  double R_on_ohm = 0.0;              ///< resistance of a MOSFET's channel, or an IGBT's r_ce
  double V_ce_V = 0.0;                ///< constant drop of an IGBT's transistor
  double V_f_V = 0.0, r_d_ohm = 0.0;  ///< constant drop and resistance of the diodes
};

/// Kind of source: it determines the open-circuit voltage V_0 over time and charge (model.md 9).
enum class Source : std::uint8_t { steady, battery, single_phase, three_phase };

/// A point of the open-circuit voltage over the charge. The voltage is linear between points; the first and
/// the last line continue beyond the outermost points.
struct ChargePoint {
  double charge = 0.0;  ///< relative to the full charge, increasing from point to point
  double voltage_V = 0.0;
};

struct Battery {
  std::vector<ChargePoint> open_circuit{};
  double capacity_C = 0.0;            ///< full charge, A s
  double R_1_ohm = 0.0, C_1_F = 0.0;  ///< RC element in series, for the slow recovery of the voltage; 0: none
  double charge = 1.0;                ///< charge at the start, relative to the full charge
};

/// Mains with a diode rectifier, which never absorbs current from the bus.
struct Mains {
  double peak_V = 0.0;  ///< single phase: peak of the mains voltage; three phases: peak of the line-to-line
                        ///< voltage
  double frequency_Hz = 50.0, diode_drop_V = 0.0;
};

/// source -> R_b (+ L_b) -> C (+ R_C) -> bridge. With C = 0 the bus is stiff.
struct Supply {
  double V_0_V = 0.0, R_b_ohm = 0.0, L_b_H = 0.0, C_F = 0.0, R_C_ohm = 0.0;
  bool sinks = true;
  double sink_A = 0.0;     ///< if `sinks` is false: the largest current that the source absorbs
  double brake_ohm = 0.0;  ///< brake resistor: turned on above brake_on_V, turned off below brake_off_V; 0:
                           ///< none
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

// SPDX-License-Identifier: Apache-2.0
// Parameters of a machine in star connection, its shaft, devices and supply, as the equations use them
// (model.md 1): values per phase, SI units.
#pragma once
#include <cstdint>

namespace sixstep::plant {

enum class BackEmf : std::uint8_t { trapezoid, sine };

struct Machine {
  double R_ohm = 0.0;     ///< phase resistance R_s
  double L_H = 0.0;       ///< phase inductance L_s = L - M
  double K_e_V_s = 0.0;   ///< peak back-EMF of a phase per mechanical rad/s, V s; equals the torque per
                          ///< ampere of a phase, N m/A
  double pole_pairs = 1;  ///< for a linear motor pi/(pole pitch in m) (model.md 7)
  BackEmf back_emf = BackEmf::trapezoid;
  double flat_deg = 120.0;  ///< flat width of the trapezoid, electrical degrees, in (0, 180)
};

/// Parameters of the shaft's equation J dw/dt = T_e - B w - T_c(w) - T_load (model.md (4)).
struct Shaft {
  double J_kg_m2 = 0.0;
  double B_Nm_s = 0.0;      ///< viscous friction
  double coulomb_Nm = 0.0;  ///< Coulomb friction T_c while the shaft turns
  double static_Nm = 0.0;   ///< breakaway torque; effective only if larger than coulomb_Nm
  bool locked = false;      ///< true: the rotor is clamped
};

/// Friction B w + T_c sign(w) at a speed, N m, positive against a forward rotation. The equations of a run
/// use torques.hpp.
inline double friction_Nm(const Shaft& shaft, double speed_rad_s) {
  const double sign = speed_rad_s > 0 ? 1.0 : speed_rad_s < 0 ? -1.0 : 0.0;
  return shaft.B_Nm_s * speed_rad_s + sign * shaft.coulomb_Nm;
}

/// Switches and diodes (model.md 2). As in a MOSFET, a channel that is switched on conducts both directions,
/// and its diode conducts no current.
struct Devices {
  double R_on_ohm = 0.0;
  double V_f_V = 0.0;
  double r_d_ohm = 0.0;
};

/// Stiff supply (C_F = 0), or a source V_0 behind R_b that feeds the capacitor C_F (model.md 2).
struct Supply {
  double V_0_V = 0.0;
  double R_b_ohm = 0.0;
  double C_F = 0.0;
  bool sinks = true;  ///< false: the source is a rectifier, which cannot absorb current
};

}  // namespace sixstep::plant

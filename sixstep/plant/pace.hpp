// SPDX-License-Identifier: Apache-2.0
// These rates say how fast a motor, its bridge and its bus answer and how fast its field turns, and with that
// how many steps a simulated second takes. The bounds lie well above what is built: a number beyond them has
// slipped.
#pragma once
#include <algorithm>

#include "sixstep/plant/machine.hpp"

namespace sixstep::plant {

/// A time constant of 100 ns. Its segments of 50 ns are some 600 in a PWM period of 30 us, which has five of
/// its own.
inline constexpr double fastest_answer_1_s = 1e7;

/// Electrical; 160 000 turns a second. The fastest motors built turn their field 12 000 times.
inline constexpr double fastest_field_rad_s = 1e6;

/// From rest to there in 100 us. A drone's motor without its propeller takes a thousand times as long.
inline constexpr double fastest_field_rad_s2 = 1e10;

/// Of winding and switches, 1/s.
inline double winding_rate(const Machine& m, const Devices& d) {
  return (m.R_ohm + std::max(d.R_on_ohm, d.r_d_ohm)) / m.L_H;
}

/// Of the bus capacitor behind the source and against the windings, 1/s; 0 for a stiff bus.
inline double bus_rate(const Machine& m, const Supply& s) {
  return s.C_F > 0.0 ? (1.0 / s.R_b_ohm + 1.0 / m.R_ohm) / s.C_F : 0.0;
}

/// Of the speed where only viscous friction acts, 1/s.
inline double friction_rate(const Shaft& shaft) { return shaft.B_Nm_s / shaft.J_kg_m2; }

/// Where the back-EMF between two terminals is that voltage, electrical rad/s.
inline double field_at(const Machine& m, double voltage_V) {
  return m.pole_pairs * voltage_V / (2.0 * m.K_e_V_s);
}

}  // namespace sixstep::plant

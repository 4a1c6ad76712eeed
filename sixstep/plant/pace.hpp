// SPDX-License-Identifier: Apache-2.0
// Rates of winding, bus, friction and field. They determine the number of segments per simulated second. The
// bounds below are far above the rates of real drives, so that a larger value is an input error.
#pragma once
#include <algorithm>

#include "sixstep/plant/machine.hpp"

namespace sixstep::plant {

/// Bound of a rate, 1/s: a time constant of 100 ns. A PWM period of 30 us then has some 600 segments of 50
/// ns. In a usual drive it has five segments.
inline constexpr double fastest_answer_1_s = 1e7;

/// Bound of the electrical speed, rad/s: 160 000 turns per second. In the fastest motors the field makes 12
/// 000 turns per second.
inline constexpr double fastest_field_rad_s = 1e6;

/// Bound of the electrical acceleration: the field reaches `fastest_field_rad_s` from rest in 100 us. A
/// drone's motor without propeller needs a thousand times as long to its top speed.
inline constexpr double fastest_field_rad_s2 = 1e10;

/// Rate R/L of winding and switches, 1/s.
inline double winding_rate(const Machine& m, const Devices& d) {
  return (m.R_ohm + std::max(d.R_on_ohm, d.r_d_ohm)) / m.L_H;
}

/// Rate of the bus voltage: the capacitor with source and winding, 1/s; 0 for a stiff bus.
inline double bus_rate(const Machine& m, const Supply& s) {
  return s.C_F > 0.0 ? (1.0 / s.R_b_ohm + 1.0 / m.R_ohm) / s.C_F : 0.0;
}

/// Rate of the speed's decay when only viscous friction acts, 1/s.
inline double friction_rate(const Shaft& shaft) { return shaft.B_Nm_s / shaft.J_kg_m2; }

/// Electrical speed, rad/s, at which the back-EMF between two terminals is `voltage_V`.
inline double field_at(const Machine& m, double voltage_V) {
  return m.pole_pairs * voltage_V / (2.0 * m.K_e_V_s);
}

}  // namespace sixstep::plant

// SPDX-License-Identifier: Apache-2.0
// How far current, speed and bus may pass their limits (control/limits.hpp): what one control period can add.
// They hold for every chopping, sample instant, delay and arithmetic, for they ask one thing alone: that a
// sample beyond a limit turns all gates off at once.
//
//   current  |i| <= 5/4 i_lim + (4/3) (U + E) T/L
//   speed    |w| <= sqrt(w_lim^2 + 2 a theta) + (k/J) (I T + L I^2/(2 U))
//   bus      U   <= E + sqrt((U_1 - E)^2 + L I^2/C),   U_1 = U_lim + I T/C
//
// U: bus and two diodes; E: peak of the line-to-line back-EMF; L: at the terminals; I: the current's bound;
// k: largest torque per ampere; a = k I/J; theta: the angle in which Hall edges are late.
//
// Current: the largest of three currents that sum to zero has the other two against it. With all legs
// connected it sees at most two thirds of U + E on L/2 = L_s, else half of it. With all gates off, and E < U,
// its own leg is at the one rail, the others at the other or floating, and it falls.
// Speed: I drives for a period, then runs out against at least U. Speed taken over k edges is that of the
// rotor up to k + 1 sectors ago, and w^2 grows by 2 a per radian.
// Bus: I flows back for a period, then 1/2 L I^2 and what the EMF adds while it runs out. With q the charge,
// C U^2/2 grows by at most L I^2/2 + E q, and q = C (U - U_1).
//
// Nothing holds them where the load turns the rotor beyond U/k: there the diodes rectify. Nor does a limit of
// speed hold a load that drives.
#pragma once
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Largest N m per A, and V of the line-to-line peak per rad/s: the sine's peak is 4.7 % above its sector
/// mean.
double torque_per_A(const plant::Machine& machine);

/// What a control period can do to a drive.
struct LimitSetting {
  plant::Machine machine;
  double J_kg_m2 = 0.0;
  double period_s = 0.0;     ///< from sample to sample
  double bus_V = 0.0;        ///< highest, with two diode drops
  double speed_rad_s = 0.0;  ///< highest
  double current_A = 0.0;    ///< the limit
};

double most_current_A(const LimitSetting& setting);
/// `late_rad`: mechanical; 0 where the speed is known at once.
double most_speed_rad_s(const LimitSetting& setting, double limit_rad_s, double late_rad);
double most_bus_V(const LimitSetting& setting, double limit_V, double capacitance_F);

}  // namespace sixstep::design

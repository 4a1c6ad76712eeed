// SPDX-License-Identifier: Apache-2.0
// Bounds by which current, speed and bus voltage can exceed their limits (control/limits.hpp), from their
// change within one control period. They hold for every chopping, sample instant, delay and arithmetic. Their
// only assumption is that a sample beyond a limit turns all gates off at once.
//
//   current  |i| <= 5/4 i_lim + (4/3) (U + E) T/L
//   speed    |w| <= sqrt(w_lim^2 + 2 a theta) + (k/J) (I T + L I^2/(2 U))
//   bus      U   <= E + sqrt((U_1 - E)^2 + L I^2/C),   U_1 = U_lim + I T/C
//
// U: bus and two diode drops. E: peak of the line-to-line back-EMF. L: inductance between terminals. T:
// control period. I: the bound of the current. k: largest torque per ampere. a = k I/J. theta: angle by which
// Hall edges are late. C: bus capacitor.
//
// Current: the largest of three currents that sum to zero is opposed by the two others. With all legs
// connected at most two thirds of U + E drive it through L/2 = L_s, else half of U + E. With all gates off
// and E < U, the leg of the largest current is at one rail, and the other legs are at the other rail or
// floating: the current falls.
//
// Speed: I accelerates for a period and then decays against at least U. A speed measured over k edges is the
// rotor's speed up to k + 1 sectors ago, and w^2 grows by 2 a per radian.
//
// Bus: I flows back to the bus for a period. Then 1/2 L I^2 and the energy of the back-EMF flow back while I
// decays. With the charge q, C U^2/2 grows by at most L I^2/2 + E q, and q = C (U - U_1).
//
// The bounds do not hold if the load turns the rotor beyond U/k, because the diodes then rectify. A speed
// limit has no effect on a driving load either.
#pragma once
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// Largest torque per ampere, N m/A; it equals the peak of the line-to-line back-EMF, V per rad/s. For a sine
/// the peak is 4.7 % above the sector mean.
double torque_per_A(const plant::Machine& machine);

/// Data for the change within a control period.
struct LimitSetting {
  plant::Machine machine;
  double J_kg_m2 = 0.0;
  double period_s = 0.0;     ///< time from sample to sample
  double bus_V = 0.0;        ///< highest bus voltage, plus two diode drops
  double speed_rad_s = 0.0;  ///< highest speed
  double current_A = 0.0;    ///< the limit of the current
};

double most_current_A(const LimitSetting& setting);
/// `late_rad`: angle by which the measured speed is late, mechanical; 0 if it is not late.
double most_speed_rad_s(const LimitSetting& setting, double limit_rad_s, double late_rad);
double most_bus_V(const LimitSetting& setting, double limit_V, double capacitance_F);

}  // namespace sixstep::design

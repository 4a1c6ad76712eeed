// SPDX-License-Identifier: Apache-2.0
// Designs the current loops of a field-oriented drive (control/field/) from R, L, the control period T and a
// bandwidth w. With decoupling, an axis is a winding of R and L, sampled with zero-order hold as b0/(z + a0),
// as in six-step (pole_placement.hpp). The PI's zero cancels the winding's pole, d0 = a0 d1. n is the number
// of periods between a sample and the period of its output.
//
//   n = 0   L = b0 d1/(z - 1)          one pole     z_1 = exp(-w T),              b0 d1 = 1 - z_1
//   n = 1   L = b0 d1/(z (z - 1))      two poles    z_1 = exp(-w T), 1 - z_1,     b0 d1 = z_1 (1 - z_1)
//
// With a delay the second pole is slower if z_1 is below 1/2; w T is therefore at most ln 2. This holds for
// the decoupled axis at rest; with a turning rotor w_e L i also changes within a period.
//
// The field weakening computes i_d[n+1] = i_d[n] + K (m U/sqrt 3 - |v|). The current i_d changes the voltage
// v_q by w_e L_d per ampere. K is designed at the speed w_0 = U/(sqrt 3 p psi), at which the magnet's
// back-EMF equals the radius of the voltage circle. At w_0 the weakening is ten times slower than the current
// loops:
//
//   1 - K w_0 p L_d = exp(-w T/10)
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/design/loops/pole_placement.hpp"
#include "sixstep/design/sheet/parameters.hpp"

namespace sixstep::design {

/// The machine in the rotor's frame; values per phase.
struct FieldMachine {
  double R_ohm = 0.0;
  double L_d_H = 0.0, L_q_H = 0.0;
  double magnet_V_s = 0.0;  ///< p psi: peak of the back-EMF's fundamental per mechanical rad/s
  double pole_pairs = 1.0;
};

/// Reads the machine from a sheet. A trapezoid's fundamental is 1.21585 of its peak (shape_factors.hpp); a
/// salient rotor has L_d and L_q.
FieldMachine field_machine(const MotorModel& motor, const Sheet& sheet);

/// Torque T/i_q = 3/2 p psi, N m per A, for a round rotor.
inline double torque_per_q_A(const FieldMachine& machine) { return 1.5 * machine.magnet_V_s; }

struct FieldLoopSpec {
  double bandwidth_rad_s = 0.0;
  double period_s = 0.0;
  int delay_periods = 0;  ///< n, periods from a sample to its output, 0 or 1
};

/// Default bandwidth: a twentieth of the control frequency, w T = pi/10.
double usual_field_bandwidth_rad_s(double period_s);

struct FieldAxis {
  PiGains gains;
  double pole = 0.0;        ///< z_1, the designed pole
  double other_pole = 0.0;  ///< 1 - z_1, with a delay; else 0
  std::vector<DerivationStep> steps;
};

/// Designs the PI of an axis. Problems: a value that is not above 0; a bandwidth that the delay does not
/// allow.
base::Result<FieldAxis> field_axis(double R_ohm, double L_H, const FieldLoopSpec& spec);

/// Gain K of the weakening, A per V and sample.
double weakening_gain(const FieldMachine& machine, double bus_V, const FieldLoopSpec& spec);

/// Largest current that weakens the field, psi/L_d, A: a larger current against the magnet raises the voltage
/// again.
inline double most_weakening_A(const FieldMachine& machine) {
  return machine.magnet_V_s / (machine.pole_pairs * machine.L_d_H);
}

/// Fraction m of the voltage circle at which weakening begins; the rest is a reserve for changes of the
/// currents.
inline constexpr double usual_weakening_part = 0.95;

/// k_per_A of torque_per_ampere.hpp, (L_q - L_d)/(2 psi), 1/A; 0 for a round rotor.
double torque_per_ampere_gain(const FieldMachine& machine);

}  // namespace sixstep::design

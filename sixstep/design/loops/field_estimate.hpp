// SPDX-License-Identifier: Apache-2.0
// Computes the numbers of the estimator of a field-oriented drive without a rotor sensor
// (control/field/magnet_estimator.hpp), from the sheet, the board's period and the bus:
//
//   tracking       damping 1 (tracking_loop.hpp). The acceleration by the current, a = 3/2 p psi I/J, causes
//                  an error p a/w_n^2 of 5 degrees, which gives w_n. w_b is between a hundredth and a
//                  twentieth of the control frequency
//   injection      V is a quarter of U_s/sqrt 3, or less: h_d = V T/L_d is at most a fifth of the current
//   axis           followed for 30/w_n: in this time the loop leaves even an angle 0.001 degrees from the
//                  unstable angle
//   north          I_sat times a fraction: at most 1/5, and at most half of the fraction that would reverse
//                  the saliency, L_q/L_d - 1 or 1 - L_q/L_d
//   flux           at w_high the magnet's back-EMF is a tenth of U_s/sqrt 3; w_low is half of w_high, and w_g
//                  half of p w_high
//
// magnet_estimator.hpp and its parts define the symbols.
// Without injection a voltage R I along the assumed axis aligns the rotor. The rotor swings like a motor at a
// stiff voltage, and its back-EMF damps the swing:
//
//   tau = J R/(3/2 (p psi)^2),  tau' = psi/(R I):    the alignment lasts 10 (2 tau + tau')
//
// The axis then turns, and a loop controls the current I along it, even if R is wrong. A fraction x = 1/8 of
// the largest torque of I, T_I = 3/2 p psi I, accelerates the rotor: a = x T_I/J. This motion is not damped:
// at an angle delta behind the axis, the rotor swings like a pendulum. Against a load y T_I the rotor does
// not move at first; it is up to delta_0 ahead of the axis until sin delta = y. The rotor follows the axis if
// the difference of their speeds falls to zero before sin delta = x + y on the far side (equal areas),
//
//   cos delta_1 - cos delta_2 >= (x + y)(delta_2 - delta_1) + x (delta_1 + delta_0),   delta_0 = delta_1 = asin y, delta_2 = pi - asin(x + y)
//
// The limit is y = 0.659. The design guarantees 0.6; the rest is a reserve for the swing at the handover. The
// start has succeeded when the rotor has been followed for 10/w_g.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/control/field/magnet_estimator.hpp"
#include "sixstep/design/loops/field_current.hpp"

namespace sixstep::design {

struct FieldEstimateSpec {
  bool injects = false, observes = false;
  double period_s = 0.0;
  int delay_periods =
      0;  ///< periods from a sample to the period of its output; with in_middle one of these periods is half
          ///< a period
  bool in_middle = false;   ///< true: the sample is in the middle of a period
  double loop_rad_s = 0.0;  ///< bandwidth of the current loops
  double bus_V = 0.0;
  double current_A = 0.0;  ///< permissible amplitude of the phase current for motor and drive
  double J_kg_m2 = 0.0;
  std::optional<double> bandwidth_rad_s, injection_V, high_rad_s, start_A;
};

struct FieldEstimate {
  control::EstimatorConfig<double> config;
  std::vector<DerivationStep> steps;
};

/// Computes the estimator's numbers. saturation_A: I_sat of the sheet, 0 if it is not in the sheet. Problems:
/// a round rotor, iron that does not saturate, a tracking loop that cannot be sampled.
base::Result<FieldEstimate> field_estimate(const FieldMachine& machine, double saturation_A,
                                           const FieldEstimateSpec& spec);

}  // namespace sixstep::design

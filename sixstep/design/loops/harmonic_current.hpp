// SPDX-License-Identifier: Apache-2.0
// What control/field/harmonic_current.hpp is given: the shape vector of a machine's back-EMF, and when its current is there.
//
//   g(theta) = (2/3) K_e/(p psi) sum over k of f_k(theta) (cos(theta_d - 120 k), -sin(theta_d - 120 k)),   theta_d = theta - 150
//
// averaged over the six sectors: of phases or half waves that are not alike what they have in common. p psi is what the drive
// takes torque per ampere to be (field_current.hpp), so that it is 3/2 p psi of the current asked for whatever the shape; of a
// table, too, whose fundamental is not that of the sine with the same torque constant.
//
// A loop that is given no voltage ahead, with the integral gain K_i = d1 + d0 on a winding of R follows a reference by R/K_i samples late, whatever delay is in
// it: the samples of a step's error add up to that. The magnet turns by p w T R/K_i meanwhile.
#pragma once
#include "sixstep/control/field/harmonic_current.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/plant/general/machine.hpp"

namespace sixstep::design {

/// The shape alone: a current that is there at once.
control::HarmonicCurrentConfig<double> harmonic_shape(const plant::general::Machine& machine,
                                                      double magnet_V_s);

/// (0, 1) at every angle, to rounding: there is nothing to follow.
bool is_sine(const control::HarmonicCurrentConfig<double>& config);

/// R/K_i samples as an angle over the speed, electrical rad per mechanical rad/s; 0 of a loop that does not integrate.
double harmonic_lead_s(const FieldMachine& machine, const PiGains& across, double period_s);

/// What the shape costs: copper loss beside that of a constant i_q of the same mean torque; and how far that one's torque
/// swings, peak to peak over its mean.
struct HarmonicFigures {
  double copper = 1.0;
  double swing = 0.0;
};
HarmonicFigures harmonic_figures(const control::HarmonicCurrentConfig<double>& config);

}  // namespace sixstep::design

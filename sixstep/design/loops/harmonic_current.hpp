// SPDX-License-Identifier: Apache-2.0
// Computes the inputs of control/field/harmonic_current.hpp: the shape vector g of a machine's back-EMF, and
// the lead angle of the current.
//
//   g(theta) = (2/3) K_e/(p psi) sum over k of f_k(theta) (cos(theta_d - 120 k), -sin(theta_d - 120 k)),   theta_d = theta - 150
//
// averaged over the six sectors: for unequal phases or half waves g is their common part. f_k is the shape of
// phase k, K_e its peak back-EMF per speed. p psi is the value by which the drive computes its torque per
// ampere (field_current.hpp). The torque is therefore 3/2 p psi times the commanded current for any shape,
// also for a table, whose fundamental differs from the fundamental of a sine with the same torque constant.
//
// A loop without feed-forward voltage follows a reference R/K_i samples late, where K_i = d1 + d0 is its
// integral gain on a winding of R. This holds for any delay, because the sum of a step's error over all
// samples is R/K_i. In this time the magnet turns by p w T R/K_i.
#pragma once
#include "sixstep/control/field/harmonic_current.hpp"
#include "sixstep/design/loops/field_current.hpp"
#include "sixstep/plant/general/machine.hpp"

namespace sixstep::design {

/// The configuration with the shape only; the lead angle is 0.
control::HarmonicCurrentConfig<double> harmonic_shape(const plant::general::Machine& machine,
                                                      double magnet_V_s);

/// True if the shape is (0, 1) at every angle, within rounding: there is then no harmonic to follow.
bool is_sine(const control::HarmonicCurrentConfig<double>& config);

/// The lead of R/K_i samples as an angle per speed, electrical rad per mechanical rad/s; 0 for a loop without
/// integral.
double harmonic_lead_s(const FieldMachine& machine, const PiGains& across, double period_s);

/// Effect of the shape. copper: loss relative to a constant i_q with the same mean torque. swing: torque
/// ripple of this constant i_q, peak to peak, divided by its mean.
struct HarmonicFigures {
  double copper = 1.0;
  double swing = 0.0;
};
HarmonicFigures harmonic_figures(const control::HarmonicCurrentConfig<double>& config);

}  // namespace sixstep::design

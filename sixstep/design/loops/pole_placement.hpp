// SPDX-License-Identifier: Apache-2.0
// Designs a PI by pole placement on the ZOH plant, exactly as in the thesis's chapter 6 (model.md 13), with every
// intermediate value as data.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"

namespace sixstep::design {

/// First-order plant b/(s + a) sampled with zero-order hold: b0/(z + a0).
struct ZohPlant {
  double a0 = 0.0;
  double b0 = 0.0;
};

/// Discrete PI (d1 z + d0)/(z - 1): the proportional gain is K = d1, the integral gain K_i = d0 + d1 per
/// sample.
struct PiGains {
  double d1 = 0.0;
  double d0 = 0.0;
};

/// One line of a derivation: symbol, formula or meaning as text, value, unit.
struct DerivationStep {
  std::string symbol;
  std::string formula;
  double value = 0.0;
  std::string unit;
};

/// Default demands: the inputs of the thesis (chapter 6).
inline constexpr double usual_current_settle_s = 1e-3, usual_speed_settle_s = 10e-3, usual_damping = 0.9;

/// Number of time constants in which a deviation decays to 1 %: exp(-4.6).
inline constexpr double time_constants_to_settle = 4.6;

struct PolePlacement {
  double settle_s = 0.0, damping = 0.0, period_s = 0.0;
  double w0_rad_s = 0.0;          // 4.6/(xi T_reg)
  double s_re = 0.0, s_im = 0.0;  // -xi w0 +- j w0 sqrt(1 - xi^2)
  double z_re = 0.0, z_im = 0.0;  // exp(s T_s)
  ZohPlant plant{};
  PiGains gains{};
  std::vector<DerivationStep> steps{};  // the values above as a derivation for a reader
};

/// Plant of the current loop, 1/(L s + R), with terminal R and L: a0 = -exp(-R T/L), b0 = (1 - exp(-R
/// T/L))/R.
ZohPlant current_plant(double R_ohm, double L_H, double period_s);

/// Plant of the speed loop, T_max/(J s + B), from a fraction of T_max to rad/s. With B = 0 it is the
/// integrator T_max T/J.
ZohPlant speed_plant(double torque_max_Nm, double J_kg_m2, double B_Nm_s, double period_s);

/// The gains with which the closed loop has the pair z_re +- j z_im: z^2 + (b0 d1 + a0 - 1) z + (b0 d0 - a0)
/// = z^2 - 2 z_re z + z_re^2 + z_im^2.
PiGains gains_for_poles(const ZohPlant& plant, double z_re, double z_im);

/// Designs gains for a settling time and a damping: matches z^2 + (b0 d1 + a0 - 1) z + (b0 d0 - a0) with the
/// pole pair. Problems: settle_s, damping or period_s out of range. Damping is at most 1: above 1 the poles
/// are real, and the thesis's rule places a complex pair.
base::Result<PolePlacement> place_poles(const ZohPlant& plant, double settle_s, double damping,
                                        double period_s);

}  // namespace sixstep::design

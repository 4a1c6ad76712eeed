// SPDX-License-Identifier: Apache-2.0
// Rules for a PI's gains other than pole placement: pole-zero cancellation, the usual rule of drive
// firmwares, and the symmetrical optimum of speed loops. Each result has its derivation in numbers.
#pragma once
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/pole_placement.hpp"

namespace sixstep::design {

struct RuleGains {
  PiGains gains;
  std::vector<DerivationStep> steps;
};

/// Cancellation: the PI's zero cancels the plant's pole exactly in z, d0 = a0 d1, and the open loop is L = b0
/// d1/(z - 1) (symbols of pole_placement.hpp). With the bandwidth w, the closed loop has one pole at exp(-w
/// T_s), with d1 = (1 - exp(-w T_s))/b0. For T_s -> 0 these gains are the firmwares' Kp = L w and Ki = R w
/// (per second); the derivation contains both.
base::Result<RuleGains> cancel_pole(double R_ohm, double L_H, double bandwidth_rad_s, double period_s);

/// Symmetrical optimum: a speed PI around a current loop that is modelled as one lag T_sigma (Kessler;
/// Leonhard, Control of Electrical Drives). The crossover is at w_c = 1/(a T_sigma), the gain is K = J
/// w_c/T_max, and the integral time is T_i = a^2 T_sigma. The phase is then largest at the crossover, with a
/// margin of atan(a) - atan(1/a). a = 2 is the classic choice; with a = 1 + 2 xi the pole pair has the
/// damping xi. In samples d1 = K, K_i = K T_s/T_i.
base::Result<RuleGains> symmetrical_optimum(double J_kg_m2, double torque_max_Nm, double T_sigma_s, double a,
                                            double period_s);
double symmetrical_optimum_phase_rad(double a);

/// Lag of a closed PI loop T around b0/(z + a0) at low frequency, s. At low frequency, 1/T - 1 is s T_s (1 +
/// a0)/(b0 K_i). The lag includes half a period for the hold of the reference.
double lag_of_loop_s(const ZohPlant& plant, const PiGains& gains, double period_s);

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/gain_rules.hpp"

#include <cmath>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

void expect_above(base::Problems& found, const char* where, double value, double limit, const char* cure) {
  if (value > limit && value - value == 0.0) return;
  found.push_back({where, base::written(value), "must be above " + base::written(limit), cure});
}

}  // namespace

base::Result<RuleGains> cancel_pole(double R_ohm, double L_H, double bandwidth_rad_s, double period_s) {
  base::Problems found;
  expect_above(found, "bandwidth_rad_s", bandwidth_rad_s, 0.0, "give the closed loop's bandwidth in rad/s");
  expect_above(found, "period_s", period_s, 0.0, "give the control period in seconds");
  if (!found.empty()) return found;
  const ZohPlant plant = current_plant(R_ohm, L_H, period_s);
  const double pole = base::exp(-bandwidth_rad_s * period_s);
  RuleGains out;
  out.gains.d1 = (1.0 - pole) / plant.b0;
  out.gains.d0 = plant.a0 * out.gains.d1;
  const double K_i = out.gains.d1 + out.gains.d0;
  out.steps = {
      {"w", "bandwidth wanted", bandwidth_rad_s, "rad/s"},
      {"T_s", "control period", period_s, "s"},
      {"a0", "plant with zero-order hold b0 / (z + a0)", plant.a0, ""},
      {"b0", "plant with zero-order hold b0 / (z + a0)", plant.b0, ""},
      {"z", "exp(-w T_s), the remaining pole", pole, ""},
      {"d1", "(1 - z) / b0", out.gains.d1, ""},
      {"d0", "a0 d1: the zero on the plant's pole", out.gains.d0, ""},
      {"K", "d1", out.gains.d1, ""},
      {"K_i", "d0 + d1, per sample", K_i, ""},
      {"K fw", "L w, as in drive firmwares", L_H * bandwidth_rad_s, ""},
      {"K_i fw", "R w T_s, the same per sample", R_ohm * bandwidth_rad_s * period_s, ""},
  };
  return out;
}

base::Result<RuleGains> symmetrical_optimum(double J_kg_m2, double torque_max_Nm, double T_sigma_s, double a,
                                            double period_s) {
  base::Problems found;
  expect_above(found, "a", a, 1.0, "use a larger damping or a smaller bandwidth: a = 2 is the usual value");
  expect_above(found, "T_sigma_s", T_sigma_s, 0.0, "give the lag of the current loop in seconds");
  expect_above(found, "torque_max_Nm", torque_max_Nm, 0.0, "give the torque limit in N m");
  if (!found.empty()) return found;
  const double crossover = 1.0 / (a * T_sigma_s), K = J_kg_m2 * crossover / torque_max_Nm;
  const double T_i = a * a * T_sigma_s, K_i = K * period_s / T_i;
  return RuleGains{{K, K_i - K},
                   {
                       {"T_sig", "lag of the current loop and the hold", T_sigma_s, "s"},
                       {"a", "1 + 2 xi", a, ""},
                       {"w_c", "1 / (a T_sig), crossover", crossover, "rad/s"},
                       {"T_i", "a^2 T_sig", T_i, "s"},
                       {"phase", "atan(a) - atan(1/a), margin of the rule",
                        symmetrical_optimum_phase_rad(a) * 57.295779513082320877, "deg"},
                       {"K", "J w_c / T_max", K, ""},
                       {"K_i", "K T_s / T_i, per sample", K_i, ""},
                       {"d1", "K", K, ""},
                       {"d0", "K_i - K", K_i - K, ""},
                   }};
}

double symmetrical_optimum_phase_rad(double a) { return base::atan2(a, 1.0) - base::atan2(1.0, a); }

double lag_of_loop_s(const ZohPlant& plant, const PiGains& gains, double period_s) {
  return period_s * (1.0 + plant.a0) / (plant.b0 * (gains.d1 + gains.d0)) + period_s / 2.0;
}

}  // namespace sixstep::design

// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/pole_placement.hpp"

#include <cmath>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

using base::Problems;
using base::written;

bool positive(double x) { return x > 0.0 && x - x == 0.0; }

/// 1 - exp(-x) for x >= 0 without cancellation near 0: by its series up to x = 0.25, by exp above.
double one_minus_exp(double x) {
  if (x > 0.25) return 1.0 - base::exp(-x);
  double sum = 0.0;
  for (int n = 17; n >= 1; --n) sum = (1.0 - sum) * x / n;  // x - x^2/2! + x^3/3! - ... by Horner
  return sum;
}

Problems check(const ZohPlant& plant, double settle_s, double damping, double period_s) {
  Problems found;
  if (!positive(period_s))
    found.push_back({"period_s", written(period_s), "must be above 0", "give the control period in seconds"});
  if (!positive(settle_s))
    found.push_back({"settle_s", written(settle_s), "must be above 0", "give the settling time in seconds"});
  if (!(damping > 0.0 && damping <= 1.0))
    found.push_back({"damping", written(damping), "must be above 0 and at most 1",
                     "give a damping up to 1; the thesis uses 0.9"});
  if (!(plant.b0 != 0.0 && plant.b0 - plant.b0 == 0.0 && plant.a0 - plant.a0 == 0.0))
    found.push_back({"plant.b0", written(plant.b0), "must be finite and not 0",
                     "check resistance, inductance, inertia and torque of the motor"});
  return found;
}

/// The derivation for a reader, in the order of the thesis's chapter 6.
std::vector<DerivationStep> derivation(const PolePlacement& p, double z_sum, double z_product) {
  const auto [a0, b0] = p.plant;
  const auto [d1, d0] = p.gains;
  return {
      {"T_reg", "requested settling time to 1 %, of the poles without the zero", p.settle_s, "s"},
      {"xi", "damping wanted", p.damping, ""},
      {"T_s", "control period", p.period_s, "s"},
      {"w0", "4.6 / (xi T_reg)", p.w0_rad_s, "rad/s"},
      {"Re s", "-xi w0", p.s_re, "1/s"},
      {"Im s", "w0 sqrt(1 - xi^2), the pair is Re s +- j Im s", p.s_im, "rad/s"},
      {"Re z", "exp(Re s T_s) cos(Im s T_s)", p.z_re, ""},
      {"Im z", "exp(Re s T_s) sin(Im s T_s), the pair is Re z +- j Im z", p.z_im, ""},
      {"a0", "plant with zero-order hold b0 / (z + a0)", a0, ""},
      {"b0", "plant with zero-order hold b0 / (z + a0)", b0, ""},
      {"c1", "-2 Re z, requested polynomial z^2 + c1 z + c0", z_sum, ""},
      {"c0", "(Re z)^2 + (Im z)^2", z_product, ""},
      {"d1", "(c1 - a0 + 1) / b0, from c1 = b0 d1 + a0 - 1", d1, ""},
      {"d0", "(c0 + a0) / b0, from c0 = b0 d0 - a0", d0, ""},
      {"K", "d1", d1, ""},
      {"K_i", "d0 + d1, per sample", d0 + d1, ""},
  };
}

}  // namespace

// Thesis 6.6: b0/(z + a0) for the time constant L/R, with a0 = -exp(-R T_s/L), b0 = (1 - exp(-R T_s/L))/R.
ZohPlant current_plant(double R_ohm, double L_H, double period_s) {
  const double x = R_ohm * period_s / L_H;
  return {-base::exp(-x), one_minus_exp(x) / R_ohm};
}

// Thesis 6.18 (erratum: the exponent is T_s B/J): the plant T_max/(J s + B). For B -> 0, b0 is T_max T_s/J.
ZohPlant speed_plant(double torque_max_Nm, double J_kg_m2, double B_Nm_s, double period_s) {
  if (B_Nm_s == 0.0) return {-1.0, torque_max_Nm * period_s / J_kg_m2};
  const double x = period_s * B_Nm_s / J_kg_m2;
  return {-base::exp(-x), torque_max_Nm * one_minus_exp(x) / B_Nm_s};
}

PiGains gains_for_poles(const ZohPlant& plant, double z_re, double z_im) {
  const double c1 = -2.0 * z_re, c0 = z_re * z_re + z_im * z_im;
  return {(c1 - plant.a0 + 1.0) / plant.b0, (c0 + plant.a0) / plant.b0};
}

base::Result<PolePlacement> place_poles(const ZohPlant& plant, double settle_s, double damping,
                                        double period_s) {
  if (Problems found = check(plant, settle_s, damping, period_s); !found.empty()) return found;
  PolePlacement p{.settle_s = settle_s, .damping = damping, .period_s = period_s, .plant = plant};
  // Thesis 6.9 to 6.12: w0 = 4.6/(xi T_reg), s = -xi w0 +- j w0 sqrt(1 - xi^2), z = exp(s T_s).
  p.w0_rad_s = time_constants_to_settle / (damping * settle_s);
  p.s_re = -damping * p.w0_rad_s;
  p.s_im = p.w0_rad_s * std::sqrt((1.0 - damping) * (1.0 + damping));
  const double radius = base::exp(p.s_re * period_s);
  const base::SinCos turn = base::sin_cos(p.s_im * period_s);
  p.z_re = radius * turn.cos;
  p.z_im = radius * turn.sin;
  // Compares (z - z1)(z - z2) = z^2 + c1 z + c0 with z^2 + (b0 d1 + a0 - 1) z + (b0 d0 - a0).
  const double c1 = -2.0 * p.z_re, c0 = p.z_re * p.z_re + p.z_im * p.z_im;
  p.gains = gains_for_poles(plant, p.z_re, p.z_im);
  p.steps = derivation(p, c1, c0);
  return p;
}

}  // namespace sixstep::design

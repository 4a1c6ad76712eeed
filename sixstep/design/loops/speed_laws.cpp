// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/speed_laws.hpp"

#include <cmath>

#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::design {
namespace {

using base::Problems;
using base::written;

bool positive(double x) { return x > 0.0 && x - x == 0.0; }

Problems check(const SpeedLawSpec& s) {
  Problems found;
  const auto above_0 = [&](const char* where, double x, const char* cure) {
    if (!positive(x)) found.push_back({where, written(x), "must be above 0", cure});
  };
  above_0("period_s", s.period_s, "give the control period in seconds");
  above_0("settle_s", s.settle_s, "give the settling time in seconds");
  above_0("full_rad_s2", s.full_rad_s2, "check torque limit and inertia of the motor");
  above_0("limit", s.limit, "check torque limit and current limit");
  if (!(s.ratio >= 1.0))
    found.push_back({"observer_ratio", written(s.ratio), "must be at least 1", "5 is usual"});
  return found;
}

double pole_of(const SpeedLawSpec& s, double faster = 1.0) {
  return base::exp(-faster * time_constants_to_settle * s.period_s / s.settle_s);
}

/// Places both poles of the observer at z_o.
void place_observer(control::ObservedSpeedConfig<double>& c, double z_o) {
  c.L_w = 1.0 - z_o * z_o / c.a;
  c.L_l = (1.0 - z_o) * (1.0 - z_o) / c.b;
}

std::vector<DerivationStep> wanted(const SpeedLawSpec& s) {
  return {{"T_reg", "settling time wanted", s.settle_s, "s"},
          {"T_s", "control period", s.period_s, "s"},
          {"A", "acceleration by the full output", s.full_rad_s2, "rad/s^2"}};
}

void add_observer(const SpeedLawSpec& s, const SpeedLawDesign& d, std::vector<DerivationStep>& steps) {
  steps.push_back({"k", "ratio of the observer's bandwidth to the loop's", s.ratio, ""});
  steps.push_back({"z_o", "p^k, both poles of the observer", d.fast_pole, ""});
  steps.push_back({"L_w", "1 - z_o^2 / a", d.gains.observed.L_w, ""});
  steps.push_back({"L_l", "(1 - z_o)^2 / b", d.gains.observed.L_l, "s/rad"});
}

/// Distance of a pole from 1, (1 - z)^2/z.
double bend(double z) { return (1.0 - z) * (1.0 - z) / z; }

}  // namespace

base::Result<SpeedLawDesign> state_feedback(const SpeedLawSpec& s) {
  if (Problems found = check(s); !found.empty()) return found;
  SpeedLawDesign d;
  d.pole = pole_of(s);
  d.fast_pole = pole_of(s, s.ratio);
  const ZohPlant plant = speed_plant(s.full_rad_s2, 1.0, s.fades_1_s, s.period_s);
  control::ObservedSpeedConfig<double>& c = d.gains.observed;
  c.a = -plant.a0;
  c.b = plant.b0;
  c.c = s.lag_periods / (1.0 + s.lag_periods);
  if (!(d.pole < c.a))
    return base::Problem{
        "settle_s", written(s.settle_s),
        "is longer than the settling time that friction causes without a controller, " +
            base::rounded(time_constants_to_settle / s.fades_1_s, 4) + " s",
        "give a shorter settling time, or use disturbance-rejection, whose model has no friction"};
  if (!(c.c < c.a))
    return base::Problem{"lag_periods", written(s.lag_periods),
                         "samples of torque delay are more than the time constant of the speed itself",
                         "shorten the settling time of the current loop, or use disturbance-rejection"};
  c.g = c.b * c.c / (c.a - c.c);
  const double B = (c.b + c.g) * (1.0 - c.c), r = B * B / (c.a * (bend(d.pole) - bend(c.a)));
  const double half = B * B - r * (1.0 - c.a * c.a);
  const double P = (half + std::sqrt(half * half + 4.0 * B * B * r)) / (2.0 * B * B);
  c.K = (c.a - d.pole) / B;
  c.f = (1.0 - c.a) / c.b;
  d.K = c.K;
  place_observer(c, d.fast_pole);
  d.steps = wanted(s);
  const DerivationStep more[] = {
      {"a", "exp(-B T_s / J), fraction of the speed that friction leaves after one control period", c.a, ""},
      {"b", "A T_s (1 - a) / (-ln a), speed that the full output adds in one control period", c.b, "rad/s"},
      {"M", "samples of torque delay: R / K_i of the current loop less 1/2", s.lag_periods, ""},
      {"c", "M / (1 + M), the torque as a lag", c.c, ""},
      {"g", "b c / (a - c), speed that the torque not yet in effect adds", c.g, "rad/s"},
      {"p", "exp(-4.6 T_s / T_reg), the loop's pole", d.pole, ""},
      {"r", "B^2 / (a ((1 - p)^2/p - (1 - a)^2/a)), weight of the output; B = (b + g)(1 - c)", r, ""},
      {"P", "of the Riccati equation P = 1 + a^2 P r / (r + B^2 P)", P, ""},
      {"K", "a B P / (r + B^2 P) = (a - p) / B", c.K, "s/rad"},
      {"f", "(1 - a) / b, against friction", c.f, "s/rad"}};
  d.steps.insert(d.steps.end(), std::begin(more), std::end(more));
  add_observer(s, d, d.steps);
  return d;
}

base::Result<SpeedLawDesign> disturbance_rejection(const SpeedLawSpec& s) {
  if (Problems found = check(s); !found.empty()) return found;
  SpeedLawDesign d;
  d.pole = pole_of(s);
  d.fast_pole = pole_of(s, s.ratio);
  control::ObservedSpeedConfig<double>& c = d.gains.observed;
  c.a = 1.0;
  c.b = s.full_rad_s2 * s.period_s;
  c.K = d.K = (1.0 - d.pole) / c.b;
  place_observer(c, d.fast_pole);
  d.steps = wanted(s);
  const double w_c = time_constants_to_settle / s.settle_s;
  const DerivationStep more[] = {{"b_0", "A", s.full_rad_s2, "rad/s^2"},
                                 {"w_c", "4.6 / T_reg, bandwidth of the controller", w_c, "rad/s"},
                                 {"p", "exp(-w_c T_s), the loop's pole", d.pole, ""},
                                 {"a", "the model has no friction", c.a, ""},
                                 {"b", "b_0 T_s", c.b, "rad/s"},
                                 {"K", "(1 - p) / b", c.K, "s/rad"},
                                 {"w_o", "k w_c, bandwidth of the observer", s.ratio * w_c, "rad/s"}};
  d.steps.insert(d.steps.end(), std::begin(more), std::end(more));
  add_observer(s, d, d.steps);
  return d;
}

base::Result<SpeedLawDesign> sliding_mode(const SpeedLawSpec& s) {
  if (Problems found = check(s); !found.empty()) return found;
  SpeedLawDesign d;
  d.pole = pole_of(s);
  d.fast_pole = pole_of(s, s.ratio);
  control::SlidingSpeedConfig<double>& c = d.gains.sliding;
  const double b = s.full_rad_s2 * s.period_s;
  c.q = 1.0 - d.pole;
  c.f = c.q / b;
  c.reach = s.limit;
  c.layer = s.limit * b / (1.0 - d.fast_pole);
  d.K = c.f + c.reach / c.layer;
  d.steps = wanted(s);
  const DerivationStep more[] = {
      {"b", "A T_s, speed that the full output adds in one control period", b, "rad/s"},
      {"p", "exp(-4.6 T_s / T_reg), decay of an error on the surface", d.pole, ""},
      {"q", "1 - p", c.q, ""},
      {"R", "the limit: largest load, as a fraction of the full output", c.reach, ""},
      {"k", "ratio of settle_s to the time back to the surface", s.ratio, ""},
      {"P", "R b / (1 - p^k), width of the boundary layer", c.layer, "rad/s"},
      {"t_r", "1 rad/s / (R A), reaching the layer without a load, per rad/s",
       1.0 / (c.reach * s.full_rad_s2), "s"}};
  d.steps.insert(d.steps.end(), std::begin(more), std::end(more));
  return d;
}

double current_lag_periods(double R_ohm, double K_i_V_A) {
  const double samples = K_i_V_A > 0.0 ? R_ohm / K_i_V_A - 0.5 : 0.0;
  return samples > 0.0 ? samples : 0.0;
}

namespace {

Polynomial times(double factor, Polynomial p) {
  for (double& x : p) x *= factor;
  return p;
}

const Polynomial z_itself{1.0, 1.0};

}  // namespace

// With E = (z - z_o)^2 the observer's error is e = ((z - a)(z - c)(z - 1) y - b (1 - c) z (z - 1) u)/((z - c)
// E).
LinearLaw linear(const control::ObservedSpeedConfig<double>& k) {
  const Polynomial A{1.0 - k.a, 1.0}, C{1.0 - k.c, 1.0}, D{0.0, 1.0};
  const double ahead = 1.0 + k.K * k.g;
  const Polynomial E = sum(product(sum(A, {k.a * k.L_w}), D), times(k.b * k.L_l, z_itself));
  const Polynomial N = sum(times(k.K * (1.0 - k.L_w), D), times(-ahead * k.L_l, z_itself));
  LinearLaw law;
  law.r = times(k.f + k.K * (1.0 + k.g * k.f), product(C, E));
  law.y = product(C, sum(times(k.K, E), times(-1.0, product(N, A))));
  law.q = sum(product(sum(C, {k.K * k.g * (1.0 - k.c)}), E), times(k.b * (1.0 - k.c), product(N, z_itself)));
  law.q[0] = 0.0;  // exactly 0, because the load is integrated; the sum above has rounding errors
  law.y[0] = law.r[0];
  return law;
}

LinearLaw linear(const control::SlidingSpeedConfig<double>& c) {
  const double steepness = c.reach / c.layer;
  return {{steepness * c.q, c.f}, {steepness * c.q, c.f + steepness}, {0.0, 1.0}};
}

LinearLaw linear(const control::PiPositionalConfig<double>& pi, const control::DerivativeConfig<double>& d,
                 double weight_off) {
  const Polynomial filter{d.b, 1.0};
  return {product({pi.K_i, pi.K - weight_off}, filter), sum(product({pi.K_i, pi.K}, filter), {0.0, 0.0, d.g}),
          product({0.0, 1.0}, filter)};
}

}  // namespace sixstep::design

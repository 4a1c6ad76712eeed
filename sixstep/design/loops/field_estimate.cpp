// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/field_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"

namespace sixstep::design {

namespace {

constexpr double by_root_3 = 0.57735026918962576;
constexpr double turn_48 = 281474976710656.0;  // 2^48
/// Least current for finding north, relative to I_sat: with a smaller current no converter distinguishes the
/// saturation from noise.
constexpr double least_saturation = 0.01;

/// Ratio w_b/w_n for damping 1.
const double band_of_natural = std::sqrt(3 + std::sqrt(10.0));
constexpr double behind_rad = 5 * base::pi / 180;

/// x of field_estimate.hpp, and the guaranteed y: fractions of the start current's largest torque.
constexpr double start_acceleration_part = 0.125, start_load_part = 0.6;

double usual_bandwidth_rad_s(const FieldMachine& m, const FieldEstimateSpec& s) {
  const double rad_s2 = torque_per_q_A(m) * s.current_A / s.J_kg_m2;
  const double w_n = std::sqrt(m.pole_pairs * rad_s2 / behind_rad), control_rad_s = 2 * base::pi / s.period_s;
  return std::clamp(band_of_natural * w_n, control_rad_s / 100, control_rad_s / 20);
}

std::uint32_t ticks_of(double time_s, double period_s) {
  return static_cast<std::uint32_t>(std::ceil(std::min(time_s / period_s, 1e9)));
}

base::Problems injected(const FieldMachine& m, double saturation_A, const FieldEstimateSpec& s,
                        double natural_rad_s, FieldEstimate& out) {
  control::EstimatorConfig<double>& c = out.config;
  if (m.L_d_H == m.L_q_H)
    return {
        {"control.field.angle", "\"injection\"",
         "finds the magnet's axis by the difference of L_d and L_q, and both inductances are equal",
         "give d_axis_inductance_mH and q_axis_inductance_mH in the motor file, or set angle = \"observer\""}};
  const double turns = m.L_d_H < m.L_q_H ? m.L_q_H / m.L_d_H - 1 : 1 - m.L_q_H / m.L_d_H;
  const double part = saturation_A > 0 ? std::min({0.2, turns / 2, s.current_A / saturation_A}) : 0.0;
  if (part < least_saturation)
    return {{"control.field.angle", "\"injection\"",
             saturation_A > 0
                 ? "distinguishes north from south by a difference of less than 1 % of the current's response"
                 : "distinguishes north from south by saturation, and the sheet has no saturation_current_A",
             saturation_A > 0 ? "raise control.current.limit_A, or set angle = \"observer\""
                              : "give saturation_current_A in the motor file, or set angle = \"observer\""}};
  const double most_V = 0.25 * s.bus_V * by_root_3, gentle_V = 0.2 * s.current_A * m.L_d_H / s.period_s;
  const double V = s.injection_V.value_or(std::min(most_V, gentle_V));
  const double Y_D = (1 / m.L_d_H - 1 / m.L_q_H) / 2;
  c.injection = {V, 1 / (2 * V * s.period_s * Y_D)};
  c.axis_ticks = ticks_of(30 / natural_rad_s, s.period_s);
  const std::uint32_t settle = ticks_of(10 / s.loop_rad_s, s.period_s);
  c.north = {part * saturation_A, part / 3,
             static_cast<std::uint16_t>(std::min<std::uint32_t>(settle + 8, 10000)), 64};
  out.steps.insert(
      out.steps.end(),
      {{"V", "injected along the axis", V, "V"},
       {"V T/L_d", "change of the current by V", V * s.period_s / m.L_d_H, "A"},
       {"I_n", "current along the axis, first in one direction, then in the other, to find north",
        c.north.current_A, "A"},
       {"I_n/I_sat", "relative change of the response at this current", part, ""}});
  return {};
}

/// w_g of field_estimate.hpp, rad/s.
double pull_rad_s(const FieldMachine& m, const control::EstimatorConfig<double>& c) {
  return 0.5 * m.pole_pairs * c.high_rad_s;
}

void observed(const FieldMachine& m, const FieldEstimateSpec& s, FieldEstimate& out) {
  control::EstimatorConfig<double>& c = out.config;
  c.high_rad_s = s.high_rad_s.value_or(0.1 * s.bus_V * by_root_3 / m.magnet_V_s);
  c.low_rad_s = 0.5 * c.high_rad_s;
  c.flux = {s.period_s,
            m.R_ohm,
            m.L_q_H,
            m.L_d_H - m.L_q_H,
            m.magnet_V_s / m.pole_pairs,
            1 - base::exp(-pull_rad_s(m, c) * s.period_s)};
  out.steps.insert(out.steps.end(),
                   {{"w_high", "speed above which only the flux determines the angle", c.high_rad_s, "rad/s"},
                    {"w_g", "rate at which an integral's offset decays", pull_rad_s(m, c), "rad/s"}});
}

void turned(const FieldMachine& m, const FieldEstimateSpec& s, FieldEstimate& out) {
  control::EstimatorConfig<double>& c = out.config;
  const double I = s.start_A.value_or(s.current_A), R = m.R_ohm;
  const double tau_s = s.J_kg_m2 * R / (1.5 * m.magnet_V_s * m.magnet_V_s);
  const double pulls_s = m.magnet_V_s / (m.pole_pairs * R * I);
  const double align_s = 10 * (2 * tau_s + pulls_s);
  const double most_Nm = torque_per_q_A(m) * I, rad_s2 = start_acceleration_part * most_Nm / s.J_kg_m2;
  const double per_rad_s = m.pole_pairs * s.period_s / (2 * base::pi) * turn_48;  // 2^-48 turn per tick
  c.start = {I, ticks_of(align_s, s.period_s),
             std::max<std::int64_t>(1, static_cast<std::int64_t>(rad_s2 * s.period_s * per_rad_s)),
             static_cast<std::int64_t>(c.high_rad_s * per_rad_s),
             ticks_of(10 / pull_rad_s(m, c), s.period_s)};
  out.steps.insert(
      out.steps.end(),
      {{"I", "current that aligns the rotor and then turns the rotor", I, "A"},
       {"t_align", "time until the rotor is at rest", align_s, "s"},
       {"t_ramp", "time until the flux estimate follows", c.high_rad_s / rad_s2, "s"},
       {"T_start", "greatest load against which the drive starts", start_load_part * most_Nm, "N m"}});
}

}  // namespace

base::Result<FieldEstimate> field_estimate(const FieldMachine& m, double saturation_A,
                                           const FieldEstimateSpec& s) {
  const double w_b = s.bandwidth_rad_s.value_or(usual_bandwidth_rad_s(m, s));
  const auto tracking = tracking_loop({w_b, 1.0, s.period_s});
  if (!tracking) {
    base::Problems problems = tracking.problems();
    for (base::Problem& p : problems) p.where = "control.field.angle_bandwidth_Hz";
    return problems;
  }
  FieldEstimate out;
  out.config.on = true;
  out.config.tracking = tracking_config(*tracking);
  out.config.rad_s = tracking->speed_rad_s_unit / m.pole_pairs;
  out.config.late = static_cast<std::uint8_t>(s.in_middle ? s.delay_periods - 1 : s.delay_periods);
  out.config.in_middle = s.in_middle;
  out.steps = {{"w_b", "bandwidth of the angle's tracking loop", w_b, "rad/s"}};
  if (s.injects)
    if (base::Problems problems = injected(m, saturation_A, s, tracking->natural_rad_s, out);
        !problems.empty())
      return problems;
  if (s.observes) observed(m, s, out);
  if (!s.injects) turned(m, s, out);
  return out;
}

}  // namespace sixstep::design

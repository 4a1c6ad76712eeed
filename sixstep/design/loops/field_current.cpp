// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/field_current.hpp"

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/gain_rules.hpp"
#include "sixstep/design/sheet/shape_factors.hpp"

namespace sixstep::design {

namespace {

constexpr double ln_2 = 0.69314718055994531;

/// Bandwidth of the current loops, divided by the bandwidth of the field weakening.
constexpr double weakening_is_slower = 10.0;

}  // namespace

FieldMachine field_machine(const MotorModel& motor, const Sheet& sheet) {
  const plant::Machine& m = motor.machine;
  const bool sine = m.back_emf == plant::BackEmf::sine, salient = is_salient(sheet);
  const ShapeFactors shape = shape_factors(sine ? BackEmfShape::sine : BackEmfShape::trapezoid, m.flat_deg);
  return {.R_ohm = m.R_ohm,
          .L_d_H = salient ? 1e-3 * sheet.d_axis_inductance_mH->value : m.L_H,
          .L_q_H = salient ? 1e-3 * sheet.q_axis_inductance_mH->value : m.L_H,
          .magnet_V_s = m.K_e_V_s * shape.fundamental,
          .pole_pairs = m.pole_pairs};
}

double usual_field_bandwidth_rad_s(double period_s) { return base::pi / (10 * period_s); }

base::Result<FieldAxis> field_axis(double R_ohm, double L_H, const FieldLoopSpec& spec) {
  const base::Result<RuleGains> rule = cancel_pole(R_ohm, L_H, spec.bandwidth_rad_s, spec.period_s);
  if (!rule) return rule.problems();
  const double most = ln_2 / spec.period_s;
  if (spec.delay_periods > 0 && spec.bandwidth_rad_s > most)
    return base::Problem{
        "bandwidth_rad_s", base::written(spec.bandwidth_rad_s),
        "is more than a delay of one period allows, ln 2 / T_s = " + base::rounded(most, 5) + " rad/s",
        "lower this value, or shorten the control period"};
  FieldAxis axis{.gains = rule->gains,
                 .pole = base::exp(-spec.bandwidth_rad_s * spec.period_s),
                 .other_pole = 0.0,
                 .steps = rule->steps};
  if (spec.delay_periods == 0) return axis;
  const double z = axis.pole, b0 = current_plant(R_ohm, L_H, spec.period_s).b0;
  const double a0 = current_plant(R_ohm, L_H, spec.period_s).a0;
  axis.other_pole = 1 - z;
  axis.gains.d1 = z * (1 - z) / b0;
  axis.gains.d0 = a0 * axis.gains.d1;
  axis.steps = {{"w", "bandwidth wanted", spec.bandwidth_rad_s, "rad/s"},
                {"T_s", "control period", spec.period_s, "s"},
                {"a0", "plant with zero-order hold b0 / (z + a0)", a0, ""},
                {"b0", "plant with zero-order hold b0 / (z + a0)", b0, ""},
                {"z", "exp(-w T_s), the slower pole; 1 - z is the other", z, ""},
                {"d1", "z (1 - z) / b0", axis.gains.d1, ""},
                {"d0", "a0 d1: the zero on the plant's pole", axis.gains.d0, ""}};
  return axis;
}

double weakening_gain(const FieldMachine& machine, double bus_V, const FieldLoopSpec& spec) {
  const double w_0 = bus_V / (base::root_3 * machine.magnet_V_s);
  const double V_per_A = w_0 * machine.pole_pairs * machine.L_d_H;
  return (1 - base::exp(-spec.bandwidth_rad_s * spec.period_s / weakening_is_slower)) / V_per_A;
}

double torque_per_ampere_gain(const FieldMachine& machine) {
  return (machine.L_q_H - machine.L_d_H) * machine.pole_pairs / (2 * machine.magnet_V_s);
}

}  // namespace sixstep::design

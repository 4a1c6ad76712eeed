// SPDX-License-Identifier: Apache-2.0
// Designs a scenario's field-oriented drive around the loops that every drive has.
#include "sixstep/design/loops/field_current.hpp"

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/loops/speed_laws.hpp"
#include "sixstep/study/compile/field_parts.hpp"

namespace sixstep::study {

namespace {

/// Periods from a sample to the middle of the period in which the output computed from it acts. For a sample
/// in the middle of a period this is half a period more.
double periods_to_answer(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 1.0 : 0.5);
}

design::FieldLoopSpec loop_spec(const Scenario& s) {
  const double usual = design::usual_field_bandwidth_rad_s(s.pwm.period_s);
  const std::optional<double>& asked = s.control.field.bandwidth_Hz;
  return {asked ? 2 * base::pi * *asked : usual, s.pwm.period_s, waits_periods(s.pwm)};
}

struct AxisLoop {
  LoopGains gains;
  std::vector<design::DerivationStep> steps;
};

/// Returns the gains as given. Otherwise computes them by pole placement from settle_s and damping, or by
/// cancellation of the winding's pole.
base::Result<AxisLoop> axis_loop(const Scenario& s, const char* name, double R_ohm, double L_H) {
  const CurrentLoop& loop = s.control.current;
  AxisLoop out;
  out.gains.loop = name;
  const auto placed =
      design::place_poles(design::current_plant(R_ohm, L_H, s.pwm.period_s), current_settling_s(s),
                          loop.damping.value_or(design::usual_damping), s.pwm.period_s);
  const GivenGains given = given_gains(loop, s.pwm.period_s, "control.current");
  if (given.gains || loop.settle_s || loop.damping) {
    if (!placed && !given.gains) return placed.problems();
    if (placed) out.gains.derivation = *placed;
    out.gains.d1 = given.gains ? given.gains->d1 : placed->gains.d1;
    out.gains.d0 = given.gains ? given.gains->d0 : placed->gains.d0;
    out.gains.origin =
        given.gains ? given.origin : "pole placement from settle_s and damping, on a phase's R and L";
    return out;
  }
  auto axis = design::field_axis(R_ohm, L_H, loop_spec(s));
  if (!axis) {
    base::Problems problems = axis.problems();
    for (base::Problem& p : problems)
      if (p.where == "bandwidth_rad_s") p.where = "control.field.bandwidth_Hz";
    return problems;
  }
  out.gains.d1 = axis->gains.d1;
  out.gains.d0 = axis->gains.d0;
  out.gains.origin = "zero on the winding's pole; the loop's own pole at " + base::rounded(axis->pole, 6) +
                     (axis->other_pole > 0 ? " and " + base::rounded(axis->other_pole, 6) : "");
  out.steps = std::move(axis->steps);
  return out;
}

/// A round rotor has the same gains in both axes; they are listed once.
base::Problems add_axes(const Scenario& s, const design::FieldMachine& machine, FieldAround& out) {
  const bool round = machine.L_d_H == machine.L_q_H;
  auto d = axis_loop(s, round ? "current" : "current d", machine.R_ohm, machine.L_d_H);
  if (!d) return d.problems();
  auto q = axis_loop(s, "current q", machine.R_ohm, machine.L_q_H);
  if (!q) return q.problems();
  control::FieldCurrentConfig<double>& c = out.config.current;
  c.d.d1 = d->gains.d1;
  c.d.d0 = d->gains.d0;
  c.q.d1 = q->gains.d1;
  c.q.d0 = q->gains.d0;
  out.gains = {d->gains};
  out.steps = d->steps;
  if (round) return {};
  out.gains.push_back(q->gains);
  out.steps.insert(out.steps.end(), q->steps.begin(), q->steps.end());
  return {};
}

}  // namespace

double torque_per_A(const Scenario& s, const Basis& basis) {
  if (s.control.drive != FirmwareKind::field) return basis.motor.K_t_Nm_A;
  return design::torque_per_q_A(design::field_machine(basis.motor, basis.sheet));
}

double field_lag_periods(const Scenario& s, const Basis& basis) {
  if (s.control.field.law == FieldLaw::finite_set) return waits_periods(s.pwm) + 0.5;
  const design::FieldMachine machine = design::field_machine(basis.motor, basis.sheet);
  const auto axis = axis_loop(s, "current q", machine.R_ohm, machine.L_q_H);
  return axis ? design::current_lag_periods(machine.R_ohm, axis->gains.d1 + axis->gains.d0) : 0.0;
}

base::Result<FieldAround> field_around(const Scenario& s, const Basis& basis,
                                       const control::DriveConfig<double>& drive) {
  const Field& wanted = s.control.field;
  const design::FieldMachine machine = design::field_machine(basis.motor, basis.sheet);
  FieldAround out;
  out.config.drive = drive;
  if (drive.current_at_full_torque_A > 0)
    out.config.drive.extras.torque_fraction_per_A = 1 / drive.current_at_full_torque_A;
  if (wanted.law == FieldLaw::finite_set)
    add_finite_set(s, basis, out);
  else if (base::Problems problems = add_axes(s, machine, out); !problems.empty())
    return problems;
  control::FieldCurrentConfig<double>& c = out.config.current;
  c.limit = wanted.voltage_limit;
  c.d.limit = c.q.limit = basis.bus_V / 2;
  c.decouples = wanted.decoupling;
  c.d_V_s_A = machine.pole_pairs * machine.L_d_H;
  c.q_V_s_A = machine.pole_pairs * machine.L_q_H;
  c.magnet_V_s = machine.magnet_V_s;
  c.R_ohm = machine.R_ohm;
  if (const double most = design::most_weakening_A(machine); wanted.weakening_A.value_or(0.0) > most)
    return base::Problem{"control.field.weakening_A", base::written(*wanted.weakening_A),
                         "is more than psi/L_d = " + base::rounded(most, 4) +
                             " A; above this current, weakening needs more voltage instead of less",
                         "lower this value to psi/L_d or less"};
  if (wanted.weakening_A)
    out.config.weakening = {design::weakening_gain(machine, basis.bus_V, loop_spec(s)),
                            design::usual_weakening_part, *wanted.weakening_A};
  if (wanted.torque_per_ampere) out.config.per_ampere.k_per_A = design::torque_per_ampere_gain(machine);
  out.config.advance.rad_s =
      wanted.advance_periods.value_or(periods_to_answer(s.pwm)) * s.pwm.period_s * machine.pole_pairs;
  add_harmonic_current(s, basis, out);
  if (base::Problems problems = add_estimator(s, basis, machine, drive, loop_spec(s).bandwidth_rad_s, out);
      !problems.empty())
    return problems;
  return out;
}

}  // namespace sixstep::study

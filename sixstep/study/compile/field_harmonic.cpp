// SPDX-License-Identifier: Apache-2.0
// Designs the harmonic currents that a scenario requests to follow the back-EMF's shape.
#include "sixstep/design/loops/harmonic_current.hpp"
#include "sixstep/study/compile/field_parts.hpp"
#include "sixstep/study/compile/general_plant.hpp"

namespace sixstep::study {

void add_harmonic_current(const Scenario& s, const Basis& basis, FieldAround& out) {
  if (!s.control.field.harmonic_current) return;
  const design::Sheet& sheet = basis.sheet;
  const design::FieldMachine machine = design::field_machine(basis.motor, sheet);
  const auto shape = design::harmonic_shape(general_machine(sheet, basis.motor), machine.magnet_V_s);
  if (design::is_sine(shape)) return;
  control::HarmonicCurrentConfig<double>& c = out.config.harmonic;
  c = shape;
  if (s.control.field.law == FieldLaw::finite_set) {
    c.lead_rad_s = (1 + waits_periods(s.pwm)) * s.pwm.period_s * machine.pole_pairs;
    return;
  }
  if (!s.control.field.decoupling) {
    const control::PiConfig<double>& q = out.config.current.q;
    c.lead_rad_s = design::harmonic_lead_s(machine, {q.d1, q.d0}, s.pwm.period_s);
    return;
  }
  c.half_turn_s = s.pwm.period_s / 2 * machine.pole_pairs;
  c.slope_V_A = machine.L_q_H / s.pwm.period_s;
  c.R_ohm = machine.R_ohm;
}

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Designs a scenario's finite control set for three legs.
#include "sixstep/design/loops/finite_set.hpp"
#include "sixstep/study/compile/field_parts.hpp"

namespace sixstep::study {

void add_finite_set(const Scenario& s, const Basis& basis, FieldAround& out) {
  const Field& wanted = s.control.field;
  const design::FieldMachine machine = design::field_machine(basis.motor, basis.sheet);
  const design::FiniteSet designed = design::finite_set(machine, s.pwm.period_s, basis.bus_V);
  control::FiniteSetConfig<double>& c = out.config.finite_set;
  c = designed.config;
  c.foretells = wanted.delay_compensation && s.pwm.delay_periods > 0;
  c.switching_A = wanted.switching_weight_A;
  c.most_A = wanted.peak_A.value_or(0.0);
  out.steps = designed.steps;
}

}  // namespace sixstep::study

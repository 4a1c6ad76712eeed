// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/conclude.hpp"

#include "sixstep/study/run/remarks.hpp"

namespace sixstep::study {

Outcome outcome_of(const Compiled& compiled) {
  Outcome out;
  out.motor = compiled.motor;
  out.gains = compiled.gains;
  out.sensorless_steps = compiled.sensorless_steps;
  out.field_steps = compiled.field_steps;
  out.estimator_steps = compiled.estimator_steps;
  return out;
}

void conclude(const Scenario& scenario, const Compiled& compiled, const Observers& w, Outcome& out) {
  out.segments = w.segments;
  const auto note_books = [&out, &w](const auto& audit) {
    out.energy = audit.energy();
    if (w.iron) out.energy->iron = w.iron->energy_J();
    out.laws = audit.laws();
  };
  if (w.audit) compiled.general ? note_books(w.audit->general) : note_books(w.audit->lean);
  if (w.devices) out.devices = w.devices->losses();
  add_remarks(scenario, compiled, w.extremes, w.winding.finished(), out);
}

}  // namespace sixstep::study

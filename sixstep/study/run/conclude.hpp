// SPDX-License-Identifier: Apache-2.0
// What every kind of run leaves behind beside its trajectory: a whole one (run.hpp) and one in slices (session.hpp).
#pragma once
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/observers.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::study {

/// Motor, gains and how they came about, before anything ran.
Outcome outcome_of(const Compiled& compiled);

/// Adds what the observers of a run that has ended hold: energy, laws, losses of the switches, remarks. Figures are judged apart.
void conclude(const Scenario& scenario, const Compiled& compiled, const Observers& watchers,
              Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Creates the parts of an outcome that are common to both kinds of runs: run.hpp (whole) and session.hpp (in
// slices).
#pragma once
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/observers.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::study {

/// The outcome before the run: motor, gains and their derivation.
Outcome outcome_of(const Compiled& compiled);

/// Adds the observers' results after the run's end: energies, residuals of the laws that audit.hpp checks,
/// losses of the switches, remarks. Figures are judged separately.
void conclude(const Scenario& scenario, const Compiled& compiled, const Observers& watchers,
              Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// The parts of a field-oriented drive that have a file of their own.
#pragma once
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

/// What the controller is designed on: the motor at hand, or the nominal one of a series.
inline const design::Sheet& designed_sheet(const Scenario& s) {
  return s.designed_for ? s.designed_for->sheet : s.sheet;
}

/// Whole periods that the answer waits, as the winding's discrete model has them: half a one counts as a whole.
inline int waits_periods(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 1 : 0);
}

/// The choice among the legs' states, in place of current loops.
void add_finite_set(const Scenario& scenario, const Basis& basis, FieldAround& out);

/// Where the scenario asks for it; the gains of the current loops are known already.
void add_harmonic_current(const Scenario& scenario, const Basis& basis, FieldAround& out);

}  // namespace sixstep::study

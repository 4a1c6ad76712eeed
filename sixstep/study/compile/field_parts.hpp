// SPDX-License-Identifier: Apache-2.0
// The parts of a field-oriented drive that have a file of their own.
#pragma once
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

/// Delay in whole periods from a sample to the output computed from it, for the winding's discrete model.
/// Half a period counts as one period.
inline int waits_periods(const Pwm& pwm) {
  return pwm.delay_periods + (pwm.sample == SampleAt::middle ? 1 : 0);
}

/// Adds the finite control set (one of the bridge's states per period), which replaces the current loops.
void add_finite_set(const Scenario& scenario, const Basis& basis, FieldAround& out);

/// Adds the harmonic current if the scenario has it; the gains of the current loops must be set already.
void add_harmonic_current(const Scenario& scenario, const Basis& basis, FieldAround& out);

}  // namespace sixstep::study

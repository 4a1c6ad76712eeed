// SPDX-License-Identifier: Apache-2.0
// Words for what stopped a run, or a drive within a run.
#pragma once
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::study {

/// The run ended at t_s: nothing sensible comes behind a shoot-through, or behind a lean drive that lost its
/// rotor.
base::Problem stopped_by(rig::Fault fault, const rig::Diagnosis& found, double t_s);

/// The state holds numbers that no motor's has (run_away.hpp).
base::Problem ran_away(const plant::State<double>& state, double t_s);

/// Notes in the outcome the wires that were to break and did not, a bit for each of a, b, c.
void note_wires(unsigned still_closed, Outcome& out);

/// Notes in the outcome what the product drive has latched, if it has.
void note_trip(const rig::Diagnosis& found, Outcome& out);

}  // namespace sixstep::study

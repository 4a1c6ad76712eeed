// SPDX-License-Identifier: Apache-2.0
// Messages for the fault that stopped a run, or a drive within a run.
#pragma once
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::study {

/// The problem that ended the run at t_s. The run has no meaningful continuation after a shoot-through, or
/// after a lean drive has lost the rotor's position.
base::Problem stopped_by(rig::Fault fault, const rig::Diagnosis& found, double t_s);

/// The problem of a state that no motor can reach (run_away.hpp).
base::Problem ran_away(const plant::State<double>& state, double t_s);

/// Adds a note on the wires that [[at]] should have broken and that are still closed: one bit for each of a,
/// b, c.
void note_wires(unsigned still_closed, Outcome& out);

/// Writes the fault that the product drive has latched, if any, to the outcome.
void note_trip(const rig::Diagnosis& found, Outcome& out);

}  // namespace sixstep::study

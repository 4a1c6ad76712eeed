// SPDX-License-Identifier: Apache-2.0
// Writes remarks: facts about the drive that a run found and a user may not expect, one sentence each with
// its numbers.
#pragma once
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/measure/winding_watch.hpp"

namespace sixstep::study {

/// Adds to outcome.remarks:
///   - the reason why the scenario's design called it not usable,
///   - values of the reference that come after the end of the run,
///   - shunt samples that fell outside of the pulse, and control periods in which low-side shunts showed too little,
///   - a speed reference whose Hall edges come later than sensors.timeout_s,
///   - a current loop that is unstable with its gains,
///   - a negative gain from pole placement,
///   - an integral gain that looks like a gain per second, not per sample,
///   - a back-EMF above the bus,
///   - a winding or a junction above its limit, or a steady loss that the winding does not withstand,
///   - the sentences of passed_limits() (limit_remarks.hpp),
///   - fewer than five control periods in a commutation step of a six-step drive,
///   - a duty step or an overlap that does not act as expected (commutation_remarks.hpp).
/// `compiled`: the scenario's; its timeline is not read. `watch` and `winding`: of the whole run.
void add_remarks(const Scenario& scenario, const Compiled& compiled, const RunWatch& watch,
                 const WindingWatch& winding, Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Remarks: what a run knows of its drive and a user may not, a sentence each with its numbers.
#pragma once
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"

namespace sixstep::study {

/// Adds to outcome.remarks:
///   - what the design of the scenario found against it,
///   - values of the reference that the run is over before,
///   - samples of a shunt that fell outside of the pulse,
///   - a speed reference whose Hall edges come later than sensors.timeout_s,
///   - a current loop that is unstable with its gains, a placed gain that is negative, gains that look like another tool's,
///   - a back-EMF above the bus,
///   - a winding or a junction above its limit,
///   - what passed_limits() tells (limit_remarks.hpp),
///   - fewer than five control periods in a commutation step.
/// `compiled`: the scenario's, its timeline is not looked at. `watch`: of the whole run.
void add_remarks(const Scenario& scenario, const Compiled& compiled, const RunWatch& watch, Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Writes remarks: facts about the drive that a run found and a user may not expect, one sentence each with its
// numbers.
#pragma once
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"

namespace sixstep::study {

/// Adds to outcome.remarks:
/// - the reason why the scenario calls its design not usable,
/// - values of the reference that come after the end of the run,
/// - shunt samples that fell outside of the pulse,
/// - a speed reference whose Hall edges come later than sensors.timeout_s,
/// - a current loop that is unstable with its gains,
/// - a placed gain that is negative,
/// - gains that look like those of another tool,
/// - a back-EMF above the bus,
/// - a winding or a junction above its limit,
/// - the sentences of passed_limits() (limit_remarks.hpp),
/// - fewer than five control periods in a commutation step.
///
/// `compiled` is the compiled scenario; its timeline is not read. `watch` is that of the whole run.
void add_remarks(const Scenario& scenario, const Compiled& compiled, const RunWatch& watch, Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// The export gate keeps from a real bridge's chip what a run has not shown to hold, and what the run was
// spared and a board is not.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What a run of this scenario leaves unmeasured, each with its cure: sensors that the drive reads and no
/// board has, an answer that takes no time, a stall that is never seen, switches that need none, constants that the run changed on its way,
/// a run of which nothing is asked. What the drive does not read may stay ideal.
base::Problems never_measured(const Scenario& scenario);

/// What a run of it has shown against it: each requirement missed, and the fault that stopped it.
base::Problems not_held(const Outcome& outcome);

/// A scenario that was run to be taken to a chip, and what stands against that.
struct Clearance {
  Outcome outcome;
  base::Problems unmeasured, unheld;

  bool clear() const { return unmeasured.empty() && unheld.empty(); }
};

/// Runs it. Problems mean that it could not start: those nobody can override.
base::Result<Clearance> clear_for_export(const Scenario& scenario, const Listeners& listeners = {});

}  // namespace sixstep::study

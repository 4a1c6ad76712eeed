// SPDX-License-Identifier: Apache-2.0
// The export gate refuses to export a drive for a chip at a real bridge if the run did not show that the
// drive works, or if the run omitted an effect that a real board has.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Finds the effects that a run of this scenario omits, each with a cure. Sensors that the drive does not
/// read may stay ideal. The effects are:
/// - ideal sensors that the drive reads,
/// - a drive whose output takes effect at the sample instant, without delay,
/// - a stall that is never detected,
/// - a missing dead time,
/// - constants of the drive that an event changes during the run,
/// - a run without requirements.
base::Problems never_measured(const Scenario& scenario);

/// Finds results of a run that forbid an export: each missed requirement, and the fault that stopped the run.
base::Problems not_held(const Outcome& outcome);

/// The result of a run before export, and the reasons against the export.
struct Clearance {
  Outcome outcome;
  base::Problems unmeasured, unheld;
  std::vector<std::string> notes;  ///< conditions of the clearance, a sentence each (export_notes.hpp)
  bool needs_sink = false;  ///< true: the run has not shown that the drive works with a supply that cannot
                            ///< take current back

  bool clear() const { return unmeasured.empty() && unheld.empty(); }
};

/// Runs the scenario. Problems: the run could not start; no option of the export overrides these problems.
base::Result<Clearance> clear_for_export(const Scenario& scenario, const Listeners& listeners = {});

}  // namespace sixstep::study

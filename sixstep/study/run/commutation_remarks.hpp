// SPDX-License-Identifier: Apache-2.0
// Finds a duty step or an overlap (control/commutation_step.hpp) that never acts, or acts with an unsuitable pattern.
#pragma once
#include <string>

#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A sentence on a duty step that never acted: it names the least current from which the drive applies the
/// step, and a cure. Empty if the step acted. The drive omits a step that would come too late.
std::string on_idle_duty_step(const Scenario& scenario, const RunWatch& watch);
/// A sentence if the duty step acted with a chopping pattern that chops the staying leg at some edges.
std::string on_chopped_staying_leg(const Scenario& scenario, const RunWatch& watch);

}  // namespace sixstep::study

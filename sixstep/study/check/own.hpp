// SPDX-License-Identifier: Apache-2.0
// Checks a user's own controller and the scenario around it.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Returns the reasons why a loaded controller cannot run, judged by its description (sixstep_controller).
/// Called for a file, before any scenario exists.
base::Problems check_controller(const sixstep_controller& controller);

void check_own(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

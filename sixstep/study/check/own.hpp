// SPDX-License-Identifier: Apache-2.0
// What a controller of one's own asks of the scenario around it.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What of a loaded controller's own description keeps it from being run: told of a file, before any scenario is there.
base::Problems check_controller(const sixstep_controller& controller);

void check_own(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Keys that one law of the speed loop has and another has not.
void check_speed_law(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

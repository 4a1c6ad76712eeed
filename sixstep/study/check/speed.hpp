// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Refuses keys that the speed loop's law does not have.
void check_speed_law(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

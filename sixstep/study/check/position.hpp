// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What contradicts [control.position.profile], or has no room for it.
void check_position(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

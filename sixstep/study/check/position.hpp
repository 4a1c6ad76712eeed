// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Refuses keys that contradict [control.position.profile], and fixed-point arithmetics, which have too few
/// digits for the profile's increments.
void check_position(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

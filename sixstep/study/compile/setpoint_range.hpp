// SPDX-License-Identifier: Apache-2.0
// Range of the potentiometer that sets a chip's setpoint.
#pragma once
#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A little more than the largest setpoint magnitude of the run, rounded up to two digits; 1 for a duty.
double setpoint_range(const Scenario& scenario, const rig::Timeline& timeline);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// How far a potentiometer has to reach that gives a chip its setpoint.
#pragma once
#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A little more than the largest setpoint of the run either way, two digits; of a duty 1.
double setpoint_range(const Scenario& scenario, const rig::Timeline& timeline);

}  // namespace sixstep::study

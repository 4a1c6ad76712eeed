// SPDX-License-Identifier: Apache-2.0
// Finds thresholds of the product drive that check() accepts and that would protect nothing on a bridge. A run
// mentions them, and export refuses them.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Finds a stall threshold above the drive's largest requested current, a stall time longer than the winding
/// withstands that current, and an over-speed that neither bus nor motor approaches.
void look_at_protection(const Scenario& scenario, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Thresholds of the product drive that a check accepts and that would protect nothing on a bridge: a run tells of them, and export
// refuses them.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A stall threshold above the current that the drive asks for, a stall that lasts longer than the winding stands that current, an
/// over-speed that neither bus nor motor comes near.
void look_at_protection(const Scenario& scenario, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

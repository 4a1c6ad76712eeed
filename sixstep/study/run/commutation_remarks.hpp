// SPDX-License-Identifier: Apache-2.0
// Finds a duty step or an overlap (control/commutation_step.hpp) that never acts, or acts with an unsuitable
// pattern.
#pragma once
#include <string>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Returns a sentence with a cure if the duty step never acted: the drive omitted each step because it would
/// come too late, or the duty was 1 with and without the step.
std::string on_idle_duty_step(const Scenario& scenario, const RunWatch& watch);
/// A sentence if the duty step acted with a chopping pattern that chops the staying leg at some edges.
std::string on_chopped_staying_leg(const Scenario& scenario, const RunWatch& watch);

/// The speed, rad/s, above which an overlap at this current and bus voltage lasts longer than a sector, less
/// 2 % for the current's ripple. Negative: the overlap lasts longer than a sector at every speed.
double longest_overlap_rad_s(const design::MotorModel& motor, double current_A, double bus_V);
/// A sentence if an overlap of the run was longer than a sector: such an overlap lowers the torque.
std::string on_long_overlap(const Scenario& scenario, const design::MotorModel& motor, double bus_V,
                            const RunWatch& watch);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Finds a duty step or an overlap (control/commutation_step.hpp) that never acts, or acts with an unsuitable pattern.
#pragma once
#include <string>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Returns a sentence if the duty step never acted, and a cure: the drive omits a step that would come too late, or
/// the duty is 1 with it and without it.
std::string on_idle_duty_step(const Scenario& scenario, const RunWatch& watch);
/// A sentence if the duty step acted with a chopping pattern that chops the staying leg at some edges.
std::string on_chopped_staying_leg(const Scenario& scenario, const RunWatch& watch);

/// The speed, rad/s, above which an overlap at this current and bus lasts longer than a sector, less 3 % for a current
/// above its reference. Negative: at no speed does it end within one.
double longest_overlap_rad_s(const design::MotorModel& motor, double current_A, double bus_V);
/// A sentence if an overlap of the run was longer than a sector: it lowers the torque then.
std::string on_long_overlap(const Scenario& scenario, const design::MotorModel& motor, double bus_V,
                            const RunWatch& watch);

}  // namespace sixstep::study

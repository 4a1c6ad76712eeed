// SPDX-License-Identifier: Apache-2.0
// check_pace() refuses numbers that are each in range but together describe a drive so fast that its run
// would take too long.
#pragma once
#include <string>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The dead time after the timer's rounding to the nearest count of pwm.timer_Hz (model.md 3).
double dead_time_in_counts_s(double dead_time_s, const Pwm& pwm);
/// Refuses a dead time (key `where`) of half the period or more, and a dead time that the rounding to timer
/// counts shortens by more than a tenth.
void check_dead_time(const std::string& where, double dead_time_s, const Pwm& pwm, base::Problems& out);

void check_pace(const Scenario& s, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

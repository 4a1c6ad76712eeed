// SPDX-License-Identifier: Apache-2.0
// check_pace() refuses numbers each of which may be, and which together make a drive so fast that its run
// would crawl.
#pragma once
#include <string>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The dead time as the timer has it, rounded to the nearest count of pwm.timer_Hz (model.md 3).
double dead_time_in_counts_s(double dead_time_s, const Pwm& pwm);
/// A dead time, of the key `where`, that is as long as the period, or that the timer's counts shorten by more than a tenth.
void check_dead_time(const std::string& where, double dead_time_s, const Pwm& pwm, base::Problems& out);

void check_pace(const Scenario& s, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

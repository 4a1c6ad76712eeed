// SPDX-License-Identifier: Apache-2.0
// Limits that a run passed and that the model does not hold: what a battery has, what a rotor's mechanics stand, what lifts a bus, what
// a winding stands that does not warm up.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Three digits; of what is larger, whole numbers.
std::string few_digits(double x);

/// A sentence each, with the numbers and what helps. `outcome` holds the energy books where somebody kept them, and the motor.
std::vector<std::string> passed_limits(const Scenario& scenario, const RunWatch& watch,
                                       const Outcome& outcome);

}  // namespace sixstep::study

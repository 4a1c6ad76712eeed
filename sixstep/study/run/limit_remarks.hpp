// SPDX-License-Identifier: Apache-2.0
// Finds limits that a run passed and that the model does not enforce: a battery's charge, a rotor's maximum
// speed, a raised bus, the winding's heat in a run without temperatures.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Three digits; larger numbers as integers.
std::string few_digits(double x);

/// One sentence each, with numbers and a cure. `outcome` holds the motor, and the energy books if they were
/// kept.
std::vector<std::string> passed_limits(const Scenario& scenario, const RunWatch& watch,
                                       const Outcome& outcome);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Finds limits that a run exceeded and that the model does not enforce: a battery's charge, a rotor's maximum
// speed, a raised bus, a current. Temperatures: thermal_remarks.hpp.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/run_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A number with three digits; larger numbers as integers.
std::string few_digits(double x);

/// The exceeded limits, one sentence each, with numbers and a cure. `outcome` contains the motor, and the
/// energy books if they were kept.
std::vector<std::string> passed_limits(const Scenario& scenario, const RunWatch& watch,
                                       const Outcome& outcome);

/// Compares the highest phase current with the limit that a user's controller was given (0: none), and with
/// the converters' range.
std::vector<std::string> passed_currents(const Scenario& scenario, double given_limit_A,
                                         const RunWatch& watch);

}  // namespace sixstep::study

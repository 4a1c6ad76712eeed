// SPDX-License-Identifier: Apache-2.0
// check_references() finds problems of a scenario's references that the ranges of single values do not
// exclude.
#pragma once
#include <string>
#include <vector>

#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Checks times and values of steps: as many values as times, rising times, all within the run.
void check_steps(const std::vector<double>& times, const std::vector<double>& values,
                 const std::string& table, const char* value_key, double duration_s, base::Problems& out,
                 const char* times_key = "times_s");

/// Checks [reference] and the references of [[at]].
void check_references(const Scenario& scenario, base::Problems& out);

/// Checks all other keys of [[at]].
void check_events(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

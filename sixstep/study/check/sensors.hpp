// SPDX-License-Identifier: Apache-2.0
// check_sensors() finds what is wrong with a scenario's sensors beyond the range of single values.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_sensors(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Checks [believed]: values that contradict each other, that describe no motor, or that this motor does not
// have.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The motor itself must have no problems; they would otherwise appear twice.
void check_believed(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

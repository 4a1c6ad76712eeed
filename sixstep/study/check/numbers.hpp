// SPDX-License-Identifier: Apache-2.0
// Checks every number of a scenario against its key's range. The scenario can come from a file, a table of
// rows, a spread or a program.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The motor's sheet is checked against the same table where the motor's constants are derived.
base::Problems check_numbers(const Scenario& s);

}  // namespace sixstep::study

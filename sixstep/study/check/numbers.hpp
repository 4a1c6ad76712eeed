// SPDX-License-Identifier: Apache-2.0
// Every number of a scenario against its key's range, whoever wrote it: a file, a table of rows, a drive
// drawn from a spread, a program.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The motor's sheet is held to the same table where its constants are read off.
base::Problems check_numbers(const Scenario& s);

}  // namespace sixstep::study

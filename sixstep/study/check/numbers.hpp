// SPDX-License-Identifier: Apache-2.0
// Checks every number of a scenario against its key's range. The scenario can come from a file, a table of
// rows, a spread or a program.
#pragma once
#include <cstddef>

#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Does not check the first `known_events` events. Does not check the motor's sheet: the code that derives the
/// motor's constants checks it against the same table.
base::Problems check_numbers(const Scenario& s, std::size_t known_events = 0);

}  // namespace sixstep::study

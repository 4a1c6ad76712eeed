// SPDX-License-Identifier: Apache-2.0
// check() finds contradictions in a scenario before the run.
#pragma once
#include <cstddef>

#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Returns the problems of the scenario. If a number is out of its key's range, these are the numbers out of
/// range. Otherwise they are contradictions: contradictory gains, a motor sheet that lacks a needed quantity,
/// steps out of order, a bus capacitor without a source resistance. `where` is the key's path:
/// "control.current.d1".
///
/// `known_events`: number of first events of `at` whose numbers were checked before. A session adds single
/// events to a list that may have thousands.
base::Problems check(const Scenario& scenario, std::size_t known_events = 0);

/// Returns a problem for each named column that the mode does not have, because a file would contain no
/// number in this column. A program may record such columns.
base::Problems check_columns(const Scenario& scenario);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// check() finds contradictions in a scenario before the run.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Returns what is wrong with the scenario beyond the range of single values: contradictory gains, a motor
/// sheet that lacks a needed quantity, steps out of order, an RC bus without R. `where` is the key's path:
/// "control.current.d1".
base::Problems check(const Scenario& scenario);

/// Returns a problem for each named column that the mode does not have, because a file would hold no number
/// there. A program may record such columns.
base::Problems check_columns(const Scenario& scenario);

}  // namespace sixstep::study

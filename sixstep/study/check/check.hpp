// SPDX-License-Identifier: Apache-2.0
// check() says whether a scenario can be run, before it is.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What is wrong with the scenario beyond the range of single values: contradictory gains, a sheet that says
/// nothing of a needed quantity, steps out of order, an RC bus without R. `where` is the key's path:
/// "control.current.d1".
base::Problems check(const Scenario& scenario);

/// Columns asked for by name that the mode does not have: a file would hold no number there. A program that
/// records all columns may leave them so.
base::Problems check_columns(const Scenario& scenario);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What the field-oriented drive does not do, and what is its own.
void check_field(const Scenario& scenario, base::Problems& out);

/// What the choice among the legs' states does not do, and what is its own.
void check_finite_set(const Scenario& scenario, base::Problems& out);

/// Of a drive that answers three legs: what is taken of a pair that moves on.
void check_pair_figures(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

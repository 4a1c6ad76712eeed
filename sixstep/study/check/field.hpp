// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Checks the keys that the field-oriented drive does not support, and the keys that only this drive has.
void check_field(const Scenario& scenario, base::Problems& out);

/// Checks the keys that the finite control set does not support, and the keys that only the finite control
/// set has.
void check_finite_set(const Scenario& scenario, base::Problems& out);

/// Refuses figures of commutation: a drive that commands three legs has no driven pair.
void check_pair_figures(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

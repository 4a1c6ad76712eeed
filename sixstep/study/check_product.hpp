// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario.hpp"

namespace sixstep::study {

/// What [protection] and [sensors] lack for the product drive, and what of [protection] the lean one ignores.
void check_product(const Scenario& scenario, base::Problems& out);

/// Extras that contradict the loops they would be added to.
void check_extras(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What [protection] and [sensors] lack for the product drive, and what of its keys the lean one ignores.
/// `sector_rad`: a sector of the shaft's turn, (pi/3)/p; empty where the motor is not known.
void check_product(const Scenario& scenario, const std::optional<double>& sector_rad, base::Problems& out);

/// Extras that contradict the loops they would be added to.
void check_extras(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

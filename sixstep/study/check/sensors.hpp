// SPDX-License-Identifier: Apache-2.0
// check_sensors() finds problems of a scenario's sensors that the ranges of single values do not exclude.
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// `motor`: from the sheet; empty if the sheet lacks values.
void check_sensors(const Scenario& scenario, const std::optional<design::MotorModel>& motor,
                   base::Problems& out);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// check_shaft_sensor() checks an encoder or a resolver against the chip's clock and the motor.
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_shaft_sensor(const Scenario& scenario, const std::optional<design::MotorModel>& motor,
                        base::Problems& out);

}  // namespace sixstep::study

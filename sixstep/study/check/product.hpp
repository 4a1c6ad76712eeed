// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What [protection] and [sensors] lack for the product drive, and what of its keys the lean one ignores.
/// `motor`: empty where its sheet is wrong.
void check_product(const Scenario& scenario, const std::optional<design::MotorModel>& motor,
                   base::Problems& out);

/// The most that a speed loop asks of the current loop, in A: its full torque over K_t (of a field-oriented drive over the torque
/// of an ampere across the magnet), or control.current.limit_A if that is less. Empty where there is no such pair of loops, and of a salient
/// rotor in a field-oriented drive.
std::optional<double> current_limit_A(const Scenario& scenario, const design::MotorModel& motor);

/// Extras that contradict the loops they would be added to.
void check_extras(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

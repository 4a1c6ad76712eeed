// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Finds what [protection] and [sensors] lack for the product drive, or the keys of the product drive that the
/// lean drive ignores. `motor` is empty if its sheet is wrong.
void check_product(const Scenario& scenario, const std::optional<design::MotorModel>& motor,
                   base::Problems& out);

/// The largest current that a speed loop requests from the current loop, A: its full torque over K_t
/// (field-oriented drive: over the torque per ampere of q-axis current), or control.current.limit_A if that is
/// less. Empty without such a pair of loops, and for a salient rotor in a field-oriented drive, whose torque is
/// not proportional to its current.
std::optional<double> current_limit_A(const Scenario& scenario, const design::MotorModel& motor);

/// Refuses extras that contradict the loops to which they would be added.
void check_extras(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

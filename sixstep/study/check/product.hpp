// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// For the product drive: finds missing and wrong keys of [protection] and [sensors]. For all other drives:
/// finds keys that only the product drive reads. `motor` is empty if its sheet has problems.
void check_product(const Scenario& scenario, const std::optional<design::MotorModel>& motor,
                   base::Problems& out);

/// The largest current that a speed loop requests from the current loop, A: its full torque divided by the
/// K_t that the drive believes (field-oriented drive: by the torque per ampere of q-axis current).
/// control.current.limit_A replaces it if it is less. Empty without such a cascade. Empty also for a salient
/// rotor in a field-oriented drive, because its torque is not proportional to the current.
std::optional<double> current_limit_A(const Scenario& scenario);

/// Refuses options of the current loop, of its limits and of the chopping that contradict each other.
void check_extras(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study

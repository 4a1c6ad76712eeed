// SPDX-License-Identifier: Apache-2.0
// Finds thresholds of the product drive that check() accepts but that would not protect a bridge. A run
// mentions these thresholds in a remark, and export refuses them.
#pragma once
#include <optional>
#include <string>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The largest requested current, and the key that sets it.
struct MostCurrent {
  double ampere = 0.0;
  std::string by;
};

/// The largest requested current. Empty if nothing requests or limits a current.
std::optional<MostCurrent> most_current(const Scenario& scenario, const design::MotorModel& motor);

/// Finds unsuitable thresholds:
/// - a stall threshold above the drive's largest requested current,
/// - a stall time longer than the winding withstands that current,
/// - an over-speed threshold that neither bus nor motor approaches.
void look_at_protection(const Scenario& scenario, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

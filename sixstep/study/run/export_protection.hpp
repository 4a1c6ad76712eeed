// SPDX-License-Identifier: Apache-2.0
// Finds thresholds of the product drive that check() accepts but that would not protect a bridge. A run
// mentions these thresholds in a remark, and export refuses them.
#pragma once
#include <optional>
#include <string>

#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The largest requested current, and the key that sets it.
struct MostCurrent {
  double ampere = 0.0;
  std::string by;
};

/// The largest requested current. Empty if nothing requests or limits a current.
std::optional<MostCurrent> most_current(const Scenario& scenario, const design::MotorModel& motor);

/// How long the winding withstands the current `most` in two phases, as in six-step operation and at a
/// blocked rotor, from the scenario's start on.
base::Result<design::WithstandTimes> withstand_times_of(const Scenario& scenario,
                                                        const design::MotorModel& motor,
                                                        const MostCurrent& most);

/// Finds thresholds that do not protect:
/// - an over-current threshold at or below the drive's largest requested current,
/// - a stall threshold above this current,
/// - a stall time longer than the winding withstands this current, by the worse ends of the motor file's
///   thermal ranges,
/// - an accepted offset of the current converter that hides an over-current,
/// - an over-speed threshold that neither bus nor motor reaches.
void look_at_protection(const Scenario& scenario, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study

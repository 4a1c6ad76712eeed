// SPDX-License-Identifier: Apache-2.0
// Finds conditions under which a drive works in its run but perhaps not on a bench: a limit above the nominal
// current, a check for which the motor file has no values, a sheet that contradicts itself, a drive without
// protection, a supply that takes current back. The export lists these conditions as notes; they do not
// prevent it.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A sentence if a cascade's limit allows more than the nominal current. It contains the time for which the
/// winding withstands the limit, by the sheet's thermal values and by the worse ends of the thermal ranges.
/// Empty
/// - if the winding withstands the limit without end,
/// - if the sheet has neither a nominal current nor thermal values,
/// - for a field-oriented drive, whose nominal current refers to a sine.
std::string limit_above_nominal(const Scenario& scenario, const design::MotorModel& motor);

/// Checks of a product drive or a cascade that need values which the motor file does not have, a sentence
/// each.
std::vector<std::string> unchecked(const Scenario& scenario, const design::MotorModel& motor);

/// The relations between values of the motor file that do not hold. Empty if all relations hold or are known
/// deviations. [motor_override] is not judged: it changes values on purpose.
std::string sheet_contradiction(const Scenario& scenario);

/// The result of a second run with a supply that cannot take current back.
struct WithoutSink {
  bool matters = false;  ///< true: the scenario's supply takes current back
  bool holds = false;    ///< true: the requirements of run and stop also hold with a supply that cannot take
                         ///< current back
  std::string note;      ///< what fails with such a supply; empty if nothing fails
};
WithoutSink without_sink(const Scenario& scenario, const design::MotorModel& motor,
                         const Listeners& listeners);

/// A sentence if few switches can turn off within the dead time. Empty if the switch's gate charges are
/// given: never_measured() then compares the dead time with the turn-off time.
std::string short_dead_time(const Scenario& scenario);

/// A sentence if the drive has no [protection] and so never turns the bridge off at a fault, or if a product
/// drive has no stall thresholds and so detects no stall.
std::string without_protection(const Scenario& scenario);

/// The bound of a product drive's setpoint, which is the scenario's largest reference. Empty for other
/// drives.
std::string setpoint_bound(const Scenario& scenario);

}  // namespace sixstep::study

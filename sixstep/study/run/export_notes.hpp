// SPDX-License-Identifier: Apache-2.0
// Finds conditions under which a drive works in its run but perhaps not on a bench: a limit above the nominal
// current, a check that the motor file's lines do not allow, a sheet that contradicts itself, a drive without
// protection, a supply that takes current back. Export notes them; they are no reasons against it.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A cascade whose limit allows more than the nominal current, with the time for which the winding withstands
/// that limit by the sheet's thermal values, and by the worse ends of their ranges. Empty if it withstands the limit without end, without both
/// a printed nominal current and thermal values, and for a field-oriented drive, whose nominal current is a sine's.
std::string limit_above_nominal(const Scenario& scenario, const design::MotorModel& motor);

/// Checks of a product drive or a cascade that need lines which the motor file does not have, a sentence each.
std::vector<std::string> unchecked(const Scenario& scenario, const design::MotorModel& motor);

/// The relations of the motor's file that do not hold. Empty if all hold or are known deviations. [motor_override]
/// is not judged: it changes values on purpose.
std::string sheet_contradiction(const Scenario& scenario);

/// The result of a second run with a supply that cannot take current back.
struct WithoutSink {
  bool matters = false;  ///< the scenario's supply takes current back
  bool holds = false;    ///< with a supply that cannot take current back, the requirements of run and stop
                         ///< hold too
  std::string note;      ///< what happens with such a supply if it does not hold
};
WithoutSink without_sink(const Scenario& scenario, const design::MotorModel& motor,
                         const Listeners& listeners);

/// A dead time in which few switches turn off; not if the gate's charges are given, with which the gate compares it.
std::string short_dead_time(const Scenario& scenario);

/// A drive without [protection] turns the bridge off at no fault; a product drive without stall thresholds
/// detects no stall.
std::string without_protection(const Scenario& scenario);

/// The bound of a product drive's setpoint, which is the scenario's largest reference. Empty for other drives.
std::string setpoint_bound(const Scenario& scenario);

}  // namespace sixstep::study

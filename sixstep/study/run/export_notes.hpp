// SPDX-License-Identifier: Apache-2.0
// Finds conditions under which a drive works in its run but perhaps not on a bench. Export prints them as
// notes and does not refuse them:
// - a limit above the nominal current,
// - a sheet that contradicts itself,
// - a drive without protection,
// - a supply that takes current back.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A note on a cascade whose limit allows more than the nominal current. It says for how long the winding
/// withstands the limit by the sheet's thermal values. Empty in three cases: the winding withstands the limit
/// without end, the sheet has no nominal current, or the drive is field-oriented, where a nominal current is
/// that of a sine.
std::string limit_above_nominal(const Scenario& scenario, const design::MotorModel& motor);

/// The relations between values of the motor's file that do not hold. Empty if all hold or are known
/// deviations. [motor_override] is not judged, because it changes values on purpose.
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

/// A note on a drive without [protection], which never turns the bridge off at a fault. Empty for the product
/// drive.
std::string without_protection(const Scenario& scenario);

/// The bound of a product drive's setpoint, which is the scenario's largest reference. Empty for other drives.
std::string setpoint_bound(const Scenario& scenario);

}  // namespace sixstep::study

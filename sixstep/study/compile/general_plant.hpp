// SPDX-License-Identifier: Apache-2.0
// Decides which scenarios the general kernel simulates, and sets its parameters. The lean kernel simulates
// all other scenarios. needs_general_plant() lists the features that only the general kernel has, such as a
// delta winding, a gear or crossed wires.
#pragma once
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// True if a scenario needs a feature that the lean kernel lacks.
bool needs_general_plant(const Scenario& scenario);

/// The motor's windings as parameters of the general kernel.
plant::general::Machine general_machine(const design::Sheet& sheet, const design::MotorModel& motor);

/// Parameters of the general kernel. Empty if the lean kernel simulates the scenario. `compiled` already has
/// the motor's model, the lean shaft and the start.
std::optional<GeneralPlant> general_plant(const Scenario& scenario, const Compiled& compiled);

}  // namespace sixstep::study

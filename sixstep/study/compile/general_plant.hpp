// SPDX-License-Identifier: Apache-2.0
// Which scenarios the general kernel runs, and what it is given: a delta, harmonics, a salient rotor, phases that
// stray, cogging, a gear, an elastic shaft, a fan, a weight, IGBTs, an inductance before the bus, a brake chopper, a wire that
// breaks, wires that are crossed, Hall probes that are not where the sectors are. All others run on the lean one.
#pragma once
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// Whether a scenario asks for what the lean kernel lacks.
bool needs_general_plant(const Scenario& scenario);

/// The windings of a motor as the general kernel is given them.
plant::general::Machine general_machine(const design::Sheet& sheet, const design::MotorModel& motor);

/// Empty where the lean kernel runs it. `compiled` has the motor's model, the lean shaft and the start.
std::optional<GeneralPlant> general_plant(const Scenario& scenario, const Compiled& compiled);

}  // namespace sixstep::study

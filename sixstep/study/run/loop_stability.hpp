// SPDX-License-Identifier: Apache-2.0
// Computes the current loop with the gains of a run on any motor, and decides whether the loop is stable.
#pragma once
#include <optional>

#include "sixstep/base/result.hpp"
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/sheet/sheet.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// True if these gains belong to a PI current loop.
bool is_current_pi(const Scenario& scenario, const LoopGains& gains);

/// The current loop on R and L of the motor's driven pair, or of an axis of the field-oriented drive.
design::DriveLoops current_loop_on(const Scenario& scenario, const design::MotorModel& motor,
                                   const design::Sheet& sheet, const LoopGains& gains);

/// The problem of a PI current loop that is unstable on the motor's R and L, with the scenario's sampling and
/// delay. Empty for a stable loop, and for a loop that is not a PI current loop.
std::optional<base::Problem> unstable_current_loop(const Scenario& scenario, const design::MotorModel& motor,
                                                   const LoopGains& gains);

}  // namespace sixstep::study

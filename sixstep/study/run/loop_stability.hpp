// SPDX-License-Identifier: Apache-2.0
// Checks whether a current loop is stable with the gains of a run.
#pragma once
#include <optional>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// The problem of a PI current loop that is unstable on the motor's R and L, with the scenario's sampling and
/// delay. Empty for a stable loop, and for a loop that is not a PI current loop.
std::optional<base::Problem> unstable_current_loop(const Scenario& scenario, const design::MotorModel& motor,
                                                   const LoopGains& gains);

}  // namespace sixstep::study

// SPDX-License-Identifier: Apache-2.0
// Whether a current loop is stable with the gains that a run had.
#pragma once
#include <optional>

#include "sixstep/base/result.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What is wrong with a PI current loop that is unstable on the motor's R and L, sampled and answered as `scenario` has it. Empty
/// where it is stable, and of loops that are no current PI.
std::optional<base::Problem> unstable_current_loop(const Scenario& scenario, const design::MotorModel& motor,
                                                   const LoopGains& gains);

}  // namespace sixstep::study

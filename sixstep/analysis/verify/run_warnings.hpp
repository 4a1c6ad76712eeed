// SPDX-License-Identifier: Apache-2.0
// Warns of problems that only the runs of a design show, with the sheet's motor or within the tolerances. A
// grave warning makes a design not usable. The problems are:
// - a fault,
// - a loop that never settles or swings without end,
// - a position that does not rest,
// - a step whose setpoint bus and load do not allow.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// The figure of that name; null if the run has none.
const study::ComparisonResult* figure_of(const study::Outcome& outcome, const std::string& figure);

/// Whether the commutations alone change the speed by more than the band of its step. Its settling time is
/// then meaningless.
bool drowned(const DesignStudy& study);

/// Adds the warnings of the runs to those of the closed form, grave ones first. The study must have outcome,
/// robustness and swings. `asked_step`: the user gave the step, so that limits may act.
void add_run_warnings(DesignStudy& study, bool asked_step);

}  // namespace sixstep::analysis

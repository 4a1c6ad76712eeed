// SPDX-License-Identifier: Apache-2.0
// Warns of problems that only the runs of a design show, with the sheet's motor or within the tolerances. A
// design with a grave warning is not usable. The problems are:
// - a fault,
// - a loop that never settles or swings without end,
// - a position that does not come to rest,
// - a step that bus and load do not allow.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// The figure with this name; null if the run does not have it.
const study::ComparisonResult* figure_of(const study::Outcome& outcome, const std::string& figure);

/// True if the commutations change the speed by more than the band of the step. The settling time then has no
/// meaning.
bool drowned(const DesignStudy& study);

/// Adds the warnings of the runs to the warnings of the closed form, grave ones first. The study must have
/// outcome, robustness and swings. `asked_step`: the user set the step; limits may then act.
void add_run_warnings(DesignStudy& study, bool asked_step);

}  // namespace sixstep::analysis

// SPDX-License-Identifier: Apache-2.0
// What only the runs of a design can show, as warnings: a fault, a loop that never settles or swings without end, a position that does
// not rest, a step whose target bus and load do not allow, and the same within the tolerances. A grave one makes a design not usable.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Null where the run has no such figure.
const study::ComparisonResult* figure_of(const study::Outcome& outcome, const std::string& figure);

/// Whether the torque ripple of the commutations is wider than the band of the speed's step: its settling time then says nothing.
bool drowned(const DesignStudy& study);

/// Adds them to those of the closed form, grave ones first. Wants the study's outcome, robustness and swings. `asked_step`: the step
/// is somebody's, and not one at which no limit acts.
void add_run_warnings(DesignStudy& study, bool asked_step);

}  // namespace sixstep::analysis

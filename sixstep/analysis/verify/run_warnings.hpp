// SPDX-License-Identifier: Apache-2.0
// What only the runs of a design can show, as warnings: a fault, a loop that never settles or swings without end, a position that does
// not rest, and the same out of tolerance. A grave one makes a design not usable.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Null where the run has no such figure.
const study::ComparisonResult* figure_of(const study::Outcome& outcome, const std::string& figure);

/// Adds them to those of the closed form, grave ones first. Wants the study's outcome, robustness and swings.
void add_run_warnings(DesignStudy& study);

}  // namespace sixstep::analysis

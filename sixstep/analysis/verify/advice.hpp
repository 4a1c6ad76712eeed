// SPDX-License-Identifier: Apache-2.0
// Finds changes that improve a design. It designs, runs and judges the design again with one or several
// changes, and advises only changes that were better in such a run.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Least number of control periods of a study of this design, approximately.
double periods_of(const DesignOrder& order, design::DriveDesign design);

/// The study of the order with another specification. Empty if its design is unusable in closed form, or if
/// the budget is too small.
std::optional<DesignStudy> tried(const DesignOrder& order, const design::DesignSpec& spec,
                                 TrialBudget& budget);

/// Adds advice to the warnings of a study: changes that make an unusable design usable, or changes that
/// remove a warning of a usable design without a new warning.
void advise(const DesignOrder& order, DesignStudy& study);
/// Adds advice to the problems of a design in position mode without a gain.
void advise(const DesignOrder& order, base::Problems& problems);

}  // namespace sixstep::analysis

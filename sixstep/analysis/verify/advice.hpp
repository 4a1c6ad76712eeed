// SPDX-License-Identifier: Apache-2.0
// Finds changes that improve a design: it designs, runs and judges it again with one change, or several. It
// advises only changes that were tried and found better.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Least number of control periods of a study of this design, approximately.
double periods_of(const DesignOrder& order, design::DriveDesign design);

/// The study of another specification; empty where its closed form is unusable, or the budget is too small.
std::optional<DesignStudy> tried(const DesignOrder& order, const design::DesignSpec& spec,
                                 TrialBudget& budget);

/// Adds changes to the warnings of a study: those that make an unusable design usable, and those that remove
/// a warning of a usable one without another warning.
void advise(const DesignOrder& order, DesignStudy& study);
/// Adds changes for a position for which no gain was found.
void advise(const DesignOrder& order, base::Problems& problems);

}  // namespace sixstep::analysis

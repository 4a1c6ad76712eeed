// SPDX-License-Identifier: Apache-2.0
// What helps a design, found by designing, running and judging it again with one thing changed, or several. Nothing is advised that
// was not tried and found better.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Control periods that a study of this design takes at least, about.
double periods_of(const DesignOrder& order, design::DriveDesign design);

/// The study of another specification; none where closed form knows it to be unusable, or the budget does not last.
std::optional<DesignStudy> tried(const DesignOrder& order, const design::DesignSpec& spec,
                                 TrialBudget& budget);

/// Writes into the warnings of a study what makes it usable, or of a usable one what makes a warning go without another to come.
void advise(const DesignOrder& order, DesignStudy& study);
/// The same of a position that no gain was found for.
void advise(const DesignOrder& order, base::Problems& problems);

}  // namespace sixstep::analysis

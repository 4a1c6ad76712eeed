// SPDX-License-Identifier: Apache-2.0
// What helps a design, found by designing, running and judging it again with one thing changed, or several. Nothing is advised that
// was not tried and found better.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Specifications that may do better, each with one change: chopping, period, sensor, rule, how fast each loop is to be.
std::vector<design::DesignSpec> single_changes(const DesignOrder& order, const design::DriveDesign& design);

/// The same with several: both switches of a leg in turns, a period that keeps the ripple low, and slower by steps.
std::vector<design::DesignSpec> joint_changes(const DesignOrder& order, const design::DriveDesign& design);

/// "period_s = 1.1e-05 and chopping = complementary"
std::string words_of_change(const design::DesignSpec& before, const design::DesignSpec& after);

/// Control periods that may be simulated for finding it.
struct TrialBudget {
  double periods = 0.0;
};

/// Control periods that a study of this design takes, about.
double periods_of(const DesignOrder& order, design::DriveDesign design);

/// The study of another specification; none where closed form knows it to be unusable, or the budget does not last.
std::optional<DesignStudy> tried(const DesignOrder& order, const design::DesignSpec& spec,
                                 TrialBudget& budget);

/// Writes into the warnings of a study what makes it usable, or of a usable one what makes a warning go without another to come.
void advise(const DesignOrder& order, DesignStudy& study);
/// The same of a position that no gain was found for.
void advise(const DesignOrder& order, base::Problems& problems);

}  // namespace sixstep::analysis

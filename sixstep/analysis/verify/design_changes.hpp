// SPDX-License-Identifier: Apache-2.0
// Computes changes of a specification that may improve a design; advice.hpp tries them.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Control period in s for a heavy rotor on a slow winding.
inline constexpr double unhurried_period_s = 1e-4;
/// The specification with unhurried_period_s and a current loop that settles in forty such periods. With a
/// faster winding, the current loop settles in fewer periods, but in at least ten. A settling time that the
/// user chose does not change.
design::DesignSpec unhurried(design::DesignSpec spec, const design::MotorModel& motor);

/// Largest usable ripple as a fraction of the nominal current. Above it, a drive's current consists mainly of
/// ripple.
inline constexpr double usable_ripple = 0.5;

/// The longer of two periods: the longest period with a low ripple, and the longest period with 45 degrees of
/// phase margin. Empty unless both are shorter than the specified period.
std::optional<design::DesignSpec> longer_of_periods(const design::DesignSpec& spec,
                                                    const design::DriveDesign& design);

/// Specifications that may be better, each with one change: chopping, period, sensor, method, or the settling
/// time of a loop.
std::vector<design::DesignSpec> single_changes(const DesignOrder& order, const design::DriveDesign& design);

/// Combinations of several changes: complementary chopping, a period with a low ripple, and loops that are
/// slower by steps.
std::vector<design::DesignSpec> joint_changes(const DesignOrder& order, const design::DriveDesign& design);

/// A change as text: "period_s = 1.1e-05 and chopping = complementary".
std::string words_of_change(const design::DesignSpec& before, const design::DesignSpec& after);

/// The order's specification with an encoder, complementary chopping and this control period.
design::DesignSpec on_encoder(const DesignOrder& order, double period_s);
/// Changes for a drive with Hall probes: on_encoder() with the drive's own period, and with each shorter
/// period that the ripple requires, in falling order.
std::vector<design::DesignSpec> on_encoders(const DesignOrder& order, const design::DriveDesign& design);

}  // namespace sixstep::analysis

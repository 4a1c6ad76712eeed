// SPDX-License-Identifier: Apache-2.0
// Makes changes of a specification that may improve a design; advice.hpp tries them.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Control period for a heavy rotor on a slow winding, s.
inline constexpr double unhurried_period_s = 1e-4;
/// The specification with that period and with a current loop that settles in forty such periods; in fewer,
/// but at least ten, if the winding is faster. A current loop that the user chose stays.
design::DesignSpec unhurried(design::DesignSpec spec, const design::MotorModel& motor);

/// Usable ripple over the nominal current: above it a drive's current is mainly ripple.
inline constexpr double usable_ripple = 0.5;

/// Specifications that may be better, each with one change: chopping, period, sensor, method, settling time of
/// each loop.
/// The longer of the two periods that leave a low ripple, and 45 degrees of phase; empty unless both are shorter
/// than the specified one.
std::optional<design::DesignSpec> longer_of_periods(const design::DesignSpec& spec,
                                                    const design::DriveDesign& design);

std::vector<design::DesignSpec> single_changes(const DesignOrder& order, const design::DriveDesign& design);

/// Combinations of several changes: complementary chopping, a period that keeps the ripple low, and loops
/// slower by steps.
std::vector<design::DesignSpec> joint_changes(const DesignOrder& order, const design::DriveDesign& design);

/// "period_s = 1.1e-05 and chopping = complementary"
std::string words_of_change(const design::DesignSpec& before, const design::DesignSpec& after);

/// The order's specification with an encoder, complementary chopping and this control period.
design::DesignSpec on_encoder(const DesignOrder& order, double period_s);
/// Changes for a drive on Hall probes: on_encoder() with its own period, and with each shorter one that the
/// ripple requires, the longest first.
std::vector<design::DesignSpec> on_encoders(const DesignOrder& order, const design::DriveDesign& design);

}  // namespace sixstep::analysis

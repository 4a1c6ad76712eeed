// SPDX-License-Identifier: Apache-2.0
// Changes of a specification that may make a design better: what advice.hpp tries.
#pragma once
#include <string>
#include <vector>

#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// A heavy rotor on a winding that lets it wait.
inline constexpr double unhurried_period_s = 1e-4;
/// With that period, and a current loop of forty such where the winding is slow enough, at least of ten; one that somebody chose stays.
design::DesignSpec unhurried(design::DesignSpec spec, const design::MotorModel& motor);

/// Of the nominal current: above it a drive's current is hardly more than ripple.
inline constexpr double usable_ripple = 0.5;

/// Specifications that may do better, each with one change: chopping, period, sensor, rule, how fast each loop is to be.
std::vector<design::DesignSpec> single_changes(const DesignOrder& order, const design::DriveDesign& design);

/// The same with several: both switches of a leg in turns, a period that keeps the ripple low, and slower by steps.
std::vector<design::DesignSpec> joint_changes(const DesignOrder& order, const design::DriveDesign& design);

/// "period_s = 1.1e-05 and chopping = complementary"
std::string words_of_change(const design::DesignSpec& before, const design::DesignSpec& after);

/// The order's on an encoder, both switches of a leg in turns, with this control period.
design::DesignSpec on_encoder(const DesignOrder& order, double period_s);
/// Of a drive on Hall probes: at its own period, and at each shorter one that the ripple asks for, the longest first.
std::vector<design::DesignSpec> on_encoders(const DesignOrder& order, const design::DriveDesign& design);

}  // namespace sixstep::analysis

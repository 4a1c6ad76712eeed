// SPDX-License-Identifier: Apache-2.0
// Rewrites the design of a linear motor in metres and newtons. The design is computed for a rotary motor
// (base/linear.hpp).
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Rewrites the texts of a design scenario: title, sources of its figures, names of its columns.
void say_in_metres(study::Scenario& scenario);

/// Rewrites derivation steps, warnings and tolerances of a design in the terms, symbols and units of a linear
/// motor. All other numbers stay the rotary motor's numbers; design::motion_of() returns the units for
/// showing them. The study of a rotary motor does not change.
void tell_in_metres(DesignStudy& study);

/// Replaces the rotary motor's terms and units in each Problem by the terms and units of the linear motor.
base::Problems told_in_metres(base::Problems problems);

}  // namespace sixstep::analysis

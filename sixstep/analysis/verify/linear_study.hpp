// SPDX-License-Identifier: Apache-2.0
// Rewrites the design of a linear motor in metres and newtons. The design itself is computed as that of a
// rotary motor (base/linear.hpp).
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Rewrites the words of a design scenario: title, sources of its figures, names of its columns.
void say_in_metres(study::Scenario& scenario);

/// Rewrites derivation steps, warnings and tolerances of a design in the words, symbols and units of a linear
/// motor. All other numbers stay those of the rotary motor; design::motion_of() gives the unit in which to
/// show them. A rotary motor's study stays as it is.
void tell_in_metres(DesignStudy& study);

/// Replaces the rotary motor's words and units in each Problem by the linear motor's.
base::Problems told_in_metres(base::Problems problems);

}  // namespace sixstep::analysis
